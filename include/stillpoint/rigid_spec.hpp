// The specification of a rigid body that bodies touch, as a scene gives it.
#pragma once

#include <stillpoint/expression.hpp>
#include <stillpoint/shear_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace stillpoint {

class TriangleSolid;

struct StlSolid {                              // contents of an STL file
  std::filesystem::path file;                  // the file
  std::shared_ptr<const TriangleSolid> solid;  // the solid, shared by all bodies and copies of the scene
};

struct RigidSpec {  // [[rigid]]: a rigid body of one shape, which pushes and never holds back; it moves by formulas or,
                    // if it is free, to where its weight and its force are in balance with what it touches
  std::string name;
  // The shape, one of these. In the half plane (r, z) of an axisymmetric scene it is turned about the axis.
  std::vector<std::vector<double>> half_plane;  // a position of its border, and the direction out of it [m]
  std::vector<double> min, max;                 // corners of a box [m]
  std::vector<std::vector<double>> polygon;     // corners in order, in the plane [m]
  std::vector<double> disc;                     // centre, in the plane [m]
  std::vector<std::vector<double>> wedge;       // the tip, and the direction in which it widens, in the plane [m]
  std::vector<double> sphere;                   // centre, in space [m]
  std::vector<std::vector<double>> cylinder;    // centres of the ends, in space [m]
  std::vector<std::vector<double>> cone;        // the tip, and the direction in which it widens, in space [m]
  std::filesystem::path stl;                    // file of a closed surface of triangles, in space
  double radius = 0;    // of a disc, a sphere or a cylinder; of the shaft that ends a wedge or a cone, 0: none [m]
  double angle = 0;     // of a wedge or a cone, from flank to flank [degrees]
  double rounding = 0;  // radius of the edges and corners [m]

  std::vector<Expression> motion;    // displacement, a formula of t for each coordinate [m]; empty: 0
  std::vector<Expression> rotation;  // in the plane the angle, counter-clockwise, in space the components of the
                                     // rotation vector: formulas of t [rad]; empty: 0
  std::vector<double> about;         // position about which it turns, which moves with it [m]; empty: the origin

  bool free = false;              // whether it is free to move along the axes, not to turn
  double mass = 0;                // of a free one, for its weight by the scene's body force [kg]
  std::vector<Expression> force;  // on a free one, a formula of t for each coordinate [N]; empty: 0

  ShearLimit shear;                 // what it bears along the border
  std::vector<std::string> bodies;  // names of the bodies that it touches; empty: all

  StlSolid from_stl{};     // contents of `stl`; resolve() reads them, once
  std::size_t number = 0;  // which rigid body of the problem it is, in all its stages

  /// Whether it touches a body of this name; bodies without a name have an empty one.
  bool touches(const std::string& body) const { return bodies.empty() || std::ranges::count(bodies, body) > 0; }
};

}  // namespace stillpoint
