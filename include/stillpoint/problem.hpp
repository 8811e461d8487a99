// A problem: the plain values of all that a run is told. A scene file gives one (scene.hpp), or a program.
//
// Values that may be left open are Choices; resolve() makes those that nobody asked for. A program changes what it
// likes and resolves the problem again. SI units unless a problem is dimensionless. Vectors have dim entries. Comments
// name the table of a scene file that gives each part, and the members follow its keys.
#pragma once

#include <stillpoint/boundary_specs.hpp>
#include <stillpoint/choice.hpp>
#include <stillpoint/expression.hpp>
#include <stillpoint/scene_error.hpp>
#include <stillpoint/scene_options.hpp>

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

struct GridSpec {                // [grid]
  std::vector<double> min, max;  // [m]
  std::vector<int> cells;
  BasisKind basis = BasisKind::linear;
  std::string follow;  // the [[wall]] whose face of the grid moves with it; empty: the grid stays where it is

  /// Of the grid at the start, along an axis [m].
  double cell_length(std::size_t axis) const { return (max[axis] - min[axis]) / cells[axis]; }
};

struct PointOutline {                                     // of points in the plane
  std::vector<std::vector<std::array<double, 2>>> loops;  // closed, what they enclose on the left [m]
  double spacing = 0;                                     // of the points, the widest [m]
};

class TriangleSolid;

struct StlSolid {                              // what was read of an STL file
  std::filesystem::path file;                  // it
  std::shared_ptr<const TriangleSolid> solid;  // all bodies and copies of the scene have the same
};

struct BodySpec {                        // [body], or several [[body]]: material points in a shape or from a file
  Choice<std::vector<double>> min, max;  // the box [m], inside the grid; of another shape what of it is in there
  // Another shape:
  std::vector<std::vector<double>> polygon;   // corners in order, (corners × 2) [m]; in space a prism:
  int axis = 2;                               // along which it is drawn out, from min to max
  std::vector<double> sphere;                 // its centre [m]
  std::vector<std::vector<double>> cylinder;  // the centres of its ends, (2 × 3) [m]
  double radius = 0, inner_radius = 0;        // of these two [m]; inner: 0 if it is solid
  std::filesystem::path stl;                  // a closed surface of triangles
  std::filesystem::path file;                 // CSV of points: x, y, volume (with thickness); empty: filled with points
  PointOutline outline;                       // of these points, if a load acts on it
  std::string material;                       // a [material.<name>]
  std::optional<StressState> state;           // as written; Scene::state holds for all bodies
  double area = 1;                            // cross-section in one dimension [m²], thickness in two [m]
  Placement placement = Placement::uniform;
  std::vector<int> points_per_cell = {2};  // along each coordinate
  double jitter = 0;                       // each point is moved by up to this share of half its spacing, seeded
  Choice<VolumeRule> volumes = Choice<VolumeRule>::open(VolumeRule::consistent);
  unsigned long seed = 1;  // of placement = "random" and of jitter

  StlSolid from_stl{};  // of stl; resolve() reads it, once

  BodyShape shape() const {
    if (!polygon.empty()) return BodyShape::polygon;
    if (!sphere.empty()) return BodyShape::sphere;
    if (!cylinder.empty()) return BodyShape::cylinder;
    if (!stl.empty()) return BodyShape::triangles;
    return file.empty() ? BodyShape::box : BodyShape::points;
  }
  bool is_box() const { return shape() == BodyShape::box; }
  /// Another shape than a box, that is filled with points.
  bool has_shape() const { return !is_box() && shape() != BodyShape::points; }
};

struct MaterialSpec {  // [material.<name>]
  std::string name, law;
  std::map<std::string, double> parameters;    // complete: defaults filled in
  std::map<std::string, std::string> choices;  // likewise, those that are words (cone = "mean")
};

struct ExactSpec {                   // [exact]: the exact solution, if it is known
  std::vector<Expression> u{};       // of x, y, z, t [m]; empty: not known by formulas
  std::vector<Expression> stress{};  // Cauchy's, likewise, (stress components) [Pa]
  std::string solution{};            // or the name of one that the program knows; its material is that of the bodies
  std::map<std::string, double> parameters{};    // of that: complete
  std::map<std::string, std::string> choices{};  // likewise

  bool known() const { return !u.empty() || !solution.empty(); }
};

struct SolveSpec {                    // [solve]
  std::string method = "relaxation";  // or a static solver: "newton", "newton-cg", "cg", "lbfgs"
  int load_steps = 1;                 // of a static solver: equal shares of the load, each remembered at its end
  bool is_static() const { return method != "relaxation"; }
};

struct DampingSpec {  // [damping]
  std::string strategy = "viscous";
  std::optional<double> c;  // empty: "critical", 2 ω₁
  Choice<double> alpha = Choice<double>::open(0.7);
  Peak peak = Peak::half_step;           // of kinetic
  Quotient quotient = Quotient::global;  // of adaptive
};

struct IntegratorSpec {  // [integrator]
  std::string method = "leapfrog";
  DampingTreatment treatment = DampingTreatment::automatic;
  std::optional<double> step;            // [s]
  double step_fraction = 0.9;            // of the critical step, if step is not given; the cap of an adaptive step
  std::optional<double> rtol;            // if given, the step is adaptive
  std::optional<double> atol_u, atol_v;  // [m], [m/s]; default: rtol times the scene's own scale
  std::string unstable_reason;           // why a step past the critical one is wanted
};

struct StopSpec {          // [stop]: a test set to 0 is off
  double residual = 1e-6;  // ‖F − R‖/‖F‖
  /// ‖u − u*‖_V/‖u‖_V (ErrorBound), certified; open: see Model::distance_goal.
  Choice<double> distance = Choice<double>::open(0);
  double kinetic_energy = 1e-6;  // share of the largest kinetic energy so far; goes with these two
  double dwell = 1;              // both held for this many periods 2π/ω₁
  double load_growth = 0;        // (q − q₀)/(λ − λ₀) dλ/dq of driven loads at their limit (LimitLoad)
  double time = 0;               // end time [s]
  long steps = 10'000'000;
  double wall_time = 0;  // [s]

  bool wants_equilibrium() const { return residual > 0 || distance > 0; }
};

struct OutputSpec {               // [output]
  double every = 0;               // time between rows of the history [s]; 0: chosen
  std::vector<double> snapshots;  // times at which the fields of all points are written [s]
  double fields_every = 0;        // or the time between them [s]; 0: at the stages only
};

struct CheckpointSpec {  // [checkpoint]: when the state is saved, so that the run can be resumed
  double every = 0;      // time on the clock [s]; 0: not by it
  long every_steps = 0;  // 0: not by them

  bool wanted() const { return every > 0 || every_steps > 0; }
};

struct PhaseSpec {  // [phase]: when the points move on and the grid starts again
  /// Of max_motion, "none".
  static constexpr double never = std::numeric_limits<double>::infinity();
  /// A phase ends once some point has moved by this share of a cell; 0: after every step (classical MPM).
  Choice<double> max_motion = Choice<double>::open(never);
  std::optional<double> max_strain;  // or once some component of ∂u/∂x exceeds this; empty: not asked
  Choice<Transfer> transfer = Choice<Transfer>::open(Transfer::flip);
  Choice<double> flip_share = Choice<double>::open(1);  // of "flip": 1 takes increments of the nodal velocity, 0 itself
  int xpic_order = 5;                                   // of "xpic": m
  Choice<DeformationRule> deformation = Choice<DeformationRule>::open(DeformationRule::positions);
  Choice<Quadrature> quadrature = Choice<Quadrature>::open(Quadrature::points);
  Dilatation dilatation = Dilatation::points;

  bool ends_by_motion() const { return max_motion < never; }
  /// Whether a phase ends at all, so that bodies move on.
  bool ends() const { return ends_by_motion() || max_strain; }
};

struct MassSpec {  // [mass]
  Choice<MassKind> kind = Choice<MassKind>::open(MassKind::consistent);
  Choice<MassScaling> scaling = Choice<MassScaling>::open(MassScaling::uniform);
  Choice<double> factor = Choice<double>::open(1);  // of the inertia, not of the weight; the key is scaling too

  bool scaling_is_asked() const { return scaling.is_asked() || factor.is_asked(); }
};

struct GeostaticSpec {  // [initial.geostatic]: stress under a level surface
  double K0 = 0;        // σ_yy = −ρ b_y (surface − y) with the body force b, σ_xx = σ_zz = K0 σ_yy
  double surface = 0;   // [m]
};

/// What a place belongs to: the material, with which it moves, or space, where it stays.
enum class ProbeFrame { material, space };
enum class ProbeKind { point, slope_angle, mean, body };

struct ProbeSpec {  // [[probe]]
  std::string name;
  ProbeKind kind = ProbeKind::point;
  // of a point:
  std::optional<int> point;  // 1-based number of a material point, in order of position
  std::vector<double> at;    // or a place, at the start [m]
  ProbeFrame frame = ProbeFrame::material;
  // of a mean:
  std::vector<double> min, max;  // the box in which its material points are at the start [m]
  // of all but the angle of the slope:
  std::vector<std::string> fields;  // of probe_fields(dim); of the body of body_fields(dim)
};
/// The fields that a probe of a point may name, or a mean: "u", "v", "strain", "stress" in one dimension, their
/// components in two.
std::vector<std::string> probe_fields(int dim);
/// What a probe of the whole body may name: "volume", "momentum" with its components, "angular_momentum".
std::vector<std::string> body_fields(int dim);

struct Problem : BoundarySpecs {
  std::string name;   // of a scene the file's stem
  std::string title;  // empty: the name stands for it
  int dim = 1;
  Constants constants;  // that formulas were read with
  GridSpec grid;
  StressState state = StressState::uniaxial_stress;  // of all bodies; resolve() sets it
  std::vector<BodySpec> bodies;
  std::map<std::string, MaterialSpec> materials;
  MassSpec mass;
  PhaseSpec phase;
  std::vector<Expression> initial_u, initial_v;  // of x, y, z [m], [m/s]; empty: 0
  std::optional<GeostaticSpec> geostatic;
  ExactSpec exact;
  SolveSpec solve;
  DampingSpec damping;
  IntegratorSpec integrator;
  StopSpec stop;
  OutputSpec output;
  CheckpointSpec checkpoint;
  std::vector<ProbeSpec> probes;
};

/// Whether a load, a support or a wall depends on t.
bool loads_vary(const Problem& problem);

/// The problem with every open choice made and every position that misses a grid line by a sliver on it, checked as a
/// whole. Choices that were made before are made again. Throws SceneError, whose problems name the keys that a scene
/// file would have.
Problem resolve(Problem problem);

}  // namespace stillpoint
