// The specifications of supports, walls, rigid bodies, contact and loads, as a scene gives them.
#pragma once

#include <stillpoint/choice.hpp>
#include <stillpoint/contact_spec.hpp>
#include <stillpoint/expression.hpp>
#include <stillpoint/rigid_spec.hpp>
#include <stillpoint/scene_options.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stillpoint {

struct SupportSpec {                  // [[support]]: u = motion(X, t) at a position, or on a face of the grid
  std::string name{};                 // reports the support's reaction in history.csv and summary.json under this name;
                                      // empty: not reported
  std::vector<double> at{};           // position of a point support [m]; empty: the support is on `face`
  std::optional<Face> face{};         // the face of the grid that is held
  std::vector<double> from{}, to{};   // the ends of the held part of the face, along its axes [m]; empty: to the face's
                                      // ends
  bool roller = false;                // on a face: only `component` is held, otherwise the other components too (at 0)
  Choice<int> component{};            // component that `motion` drives; on a face its normal by default; one asked for
                                      // there is held alone
  Expression motion{};                // prescribed displacement, a formula of the undeformed position and t [m]; 0:
                                      // fixed
  std::optional<double> stiffness{};  // stiffness of an elastic support: at a position [N/m], on a face per area [N/m³]
  std::size_t number = 0;             // which support of the problem it is, in all its stages

  bool on_part() const { return !from.empty() || !to.empty(); }
  bool holds_one_component() const { return face && (roller || component.is_asked()); }
};

struct WallSpec {  // [[wall]]: a rigid wall along a face of the grid, which pushes and never pulls
  std::string name;
  Face face = Face::right;
  Expression motion;    // displacement along the face's coordinate, a formula of t [m]
  double friction = 0;  // Coulomb's coefficient: |T| ≤ friction · N; infinite: rough
};

struct PointForceSpec {           // [[force]]
  std::string name{};             // by which stages begin and end it; empty: it is there all the time
  std::vector<double> at;         // point of application [m]
  std::vector<Expression> value;  // components of the force, formulas of t [N]
  std::size_t number = 0;         // which force of the problem it is, in all its stages
};

struct TractionSpec {                          // [[traction]]: a load on the border of a body
  std::string name{};                          // by which stages begin and end it; empty: it is there all the time
  std::optional<Face> face;                    // the loaded face of the only body, which is a box
  std::vector<double> from = {}, to = {};      // in space, the loaded part of the face, along its axes [m]; empty: to
                                               // its ends
  std::vector<std::vector<double>> line = {};  // or a straight side given by its two ends, (2 × 2) [m]
  std::optional<BodySurface> surface = {};     // or a surface of the only body in space, if that is not a box
  // The load, formulas of the undeformed position and t:
  std::vector<Expression> value;       // traction per undeformed area [Pa]; it keeps its direction
  std::optional<Expression> pressure;  // pressure per deformed area [Pa], instead of value: it follows the face's
                                       // normal
  std::size_t number = 0;              // which traction of the problem it is, in all its stages

  /// The components of value, or the pressure alone.
  std::span<const Expression> formulas() const { return pressure ? std::span(&*pressure, 1) : std::span(value); }
};

struct LoadSpec {               // [load]: proportional loads, scaled so as to reach a prescribed displacement
  Expression displacement;      // mean displacement of the loads, Σ F·u/Σ |F| [m], a formula of t
  std::vector<std::string> of;  // the loads scaled: "traction[0]", "force[1]", "body_force", by their
                                // numbers in all stages; empty: all
  double at = 0;                // when the stage begins with which they do; before, they do not act [s]
};

struct BoundarySpecs {
  std::vector<SupportSpec> supports;
  std::vector<WallSpec> walls;
  std::vector<RigidSpec> rigid;
  std::vector<ContactSpec> contacts;
  std::vector<PointForceSpec> forces;
  std::vector<TractionSpec> tractions;
  std::vector<Expression> body_force;  // formulas of x, y, z, t; per mass [m/s²]; empty: none
  std::string own_load;                // name of a body force that the program adds to body_force (own_load.hpp); or
                                       // empty
  std::optional<LoadSpec> load;        // scaling of these forces, tractions and body forces

  /// Whether the border of a body may be touched, and whether that remembers how it slid.
  bool may_touch() const { return !rigid.empty() || !contacts.empty(); }
  bool rubs() const {
    const auto any = [](const auto& one) { return one.shear.acts(); };
    return std::ranges::any_of(rigid, any) || std::ranges::any_of(contacts, any);
  }
  bool has_body_force() const { return !body_force.empty() || !own_load.empty(); }

  /// Calls visit(key, formula) for each formula of the specifications.
  template <class Visit>
  void for_each_formula(const Visit& visit) const {
    const auto key = [](const char* table, std::size_t k, const char* name) {
      return table + ("[" + std::to_string(k) + "].") + name;
    };
    for (std::size_t k = 0; k < supports.size(); ++k) visit(key("support", k, "u"), supports[k].motion);
    for (std::size_t k = 0; k < walls.size(); ++k) visit(key("wall", k, "motion"), walls[k].motion);
    for (std::size_t k = 0; k < rigid.size(); ++k) {
      for (const Expression& component : rigid[k].motion) visit(key("rigid", k, "motion"), component);
      for (const Expression& component : rigid[k].rotation) visit(key("rigid", k, "rotation"), component);
      for (const Expression& component : rigid[k].force) visit(key("rigid", k, "force"), component);
    }
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
