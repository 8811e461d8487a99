// What holds or loads a body, as a scene says it.
#pragma once

#include <stillpoint/choice.hpp>
#include <stillpoint/expression.hpp>
#include <stillpoint/scene_options.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stillpoint {

struct SupportSpec {                  // [[support]]: u = motion(X, t) at a position, or on a face of the grid
  std::string name{};                 // for its reaction in history.csv and summary.json; empty: not reported
  std::vector<double> at{};           // [m]; empty: on the face
  std::optional<Face> face{};         // of the grid
  std::vector<double> from{}, to{};   // the part of the face that is held, along its axes [m]; empty: to its ends
  bool roller = false;                // on a face: only `component` is held, otherwise the others too (at 0)
  Choice<int> component{};            // that moves; on a face its normal, unless another is asked for, and held alone
  Expression motion{};                // of the position before the motion and of t [m]; 0: fixed
  std::optional<double> stiffness{};  // of a spring that holds: at a position [N/m], on a face per area [N/m³]

  bool on_part() const { return !from.empty() || !to.empty(); }
  bool holds_one_component() const { return face && (roller || component.is_asked()); }
};

struct WallSpec {  // [[wall]]: a rigid wall along a face of the grid, that pushes and never pulls
  std::string name;
  Face face = Face::right;
  Expression motion;    // of t [m], along the face's coordinate
  double friction = 0;  // Coulomb's coefficient: |T| ≤ friction · N; infinite: rough
};

struct PointForceSpec {           // [[force]]
  std::vector<double> at;         // [m]
  std::vector<Expression> value;  // of t [N]
};

struct TractionSpec {                          // [[traction]]: a load on the border of a body
  std::optional<Face> face;                    // of the one body, a box
  std::vector<double> from = {}, to = {};      // in space the part of the face, along its axes [m]; empty: to its ends
  std::vector<std::vector<double>> line = {};  // or on a straight side that holds both ends, (2 × 2) [m]
  std::optional<BodySurface> surface = {};     // or of the one body in space, if that is no box
  // Of the position before the motion and of t:
  std::vector<Expression> value;       // per undeformed area [Pa]; it keeps its direction
  std::optional<Expression> pressure;  // per deformed area [Pa], instead of value: it follows the face's normal

  /// The components of value, or the pressure alone.
  std::span<const Expression> formulas() const { return pressure ? std::span(&*pressure, 1) : std::span(value); }
};

struct LoadSpec {               // [load]: loads in one proportion, driven by a displacement
  Expression displacement;      // of t: their mean displacement, Σ F·u/Σ |F| [m]
  std::vector<std::string> of;  // "traction[0]", "force[1]", "body_force"; empty: all
};

struct BoundarySpecs {
  std::vector<SupportSpec> supports;
  std::vector<WallSpec> walls;
  std::vector<PointForceSpec> forces;
  std::vector<TractionSpec> tractions;
  std::vector<Expression> body_force;  // of x, y, z, t; per mass [m/s²]; empty: none
  std::string own_load;                // the name of a body force that the program adds to it (own_load.hpp); or empty
  std::optional<LoadSpec> load;        // of these forces, tractions and body forces

  bool has_body_force() const { return !body_force.empty() || !own_load.empty(); }

  /// visit(key, formula) for each formula of these.
  template <class Visit>
  void for_each_formula(const Visit& visit) const {
    const auto key = [](const char* table, std::size_t k, const char* name) {
      return table + ("[" + std::to_string(k) + "].") + name;
    };
    for (std::size_t k = 0; k < supports.size(); ++k) visit(key("support", k, "u"), supports[k].motion);
    for (std::size_t k = 0; k < walls.size(); ++k) visit(key("wall", k, "motion"), walls[k].motion);
    for (std::size_t k = 0; k < forces.size(); ++k)
      for (const Expression& component : forces[k].value) visit(key("force", k, "value"), component);
    for (std::size_t k = 0; k < tractions.size(); ++k) {
      for (const Expression& component : tractions[k].value) visit(key("traction", k, "value"), component);
      if (tractions[k].pressure) visit(key("traction", k, "pressure"), *tractions[k].pressure);
    }
    for (const Expression& component : body_force) visit("body_force.value", component);
    if (load) visit("load.displacement", load->displacement);
  }
};

}  // namespace stillpoint
