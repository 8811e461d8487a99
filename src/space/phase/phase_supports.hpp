// What the conditions of a phase bear and how they move.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "space/phase/body_neighbours.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/phase_assembly.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class PhaseSupportsOf final : public PhaseSupports {
 public:
  /// all: must outlive this object.
  explicit PhaseSupportsOf(const PhaseAssembly<B, K>& all) : all_(all) {}

  std::vector<WallReaction> wall_reactions(double t) const override { return all_.conditions.wall_reactions(t); }
  std::vector<double> support_displacements(double t) const override {
    return all_.conditions.support_displacements(all_.frame.held(), t);
  }
  std::vector<SupportReaction> support_reactions(double t, ConstVec u, ConstVec reactions) const override {
    if (!all_.conditions.name_supports()) return {};
    const auto work = spread(t, u);
    return all_.conditions.support_reactions(all_.inertia.parts(), t, work->u.data(), reactions);
  }
  std::vector<WeakSupport> weak_supports(double t, ConstVec u) const override {
    if (!all_.conditions.hold_by_springs()) return {};
    return all_.conditions.weak_supports(t, spread(t, u)->u.data());
  }
  std::vector<ContactReport> contacts(double t, ConstVec u) const override {
    if (!all_.conditions.may_touch()) return {};
    return all_.conditions.contacts(t, spread(t, u)->u.data());
  }
  bool are_touched(double t, ConstVec u) const override {
    return all_.conditions.may_touch() && all_.conditions.are_touched(t, spread(t, u)->u.data());
  }
  double friction_work() const override { return all_.conditions.friction_work(); }
  ContactState contact_state(double t, ConstVec u) const override {
    if (!all_.conditions.may_touch()) return {};
    return all_.conditions.contact_state(all_.inertia.parts(), t, spread(t, u)->u.data());
  }
  std::vector<Intrusion> intrusions(double t, ConstVec u) const override {
    if (!all_.conditions.may_touch()) return {};
    return all_.conditions.intrusions(all_.inertia.parts(), t, spread(t, u)->u.data());
  }
  std::vector<Intrusion> passages(double before, double t, ConstVec u) const override {
    if (!all_.conditions.rigid_bodies_jump(before, t)) return {};  // as in all steps but few
    return all_.conditions.passages(all_.inertia.parts(), before, t, spread(t, u)->u.data());
  }
  double way_of_rigid_bodies(double before, double t) const override {
    return all_.conditions.way_of_rigid_bodies(before, t);
  }
  bool is_rigid_body_ahead(std::size_t body, ConstVec direction, double t, ConstVec u) const override {
    if (!all_.conditions.may_touch()) return false;
    Point<dimensions(K)> along;
    std::copy_n(direction.begin(), along.size(), along.begin());
    return all_.conditions.is_ahead(body, along, t, spread(t, u)->u.data());
  }
  std::optional<LoadState> load_state(double t, ConstVec u) const override {
    if (!all_.conditions.are_driven()) return std::nullopt;
    return all_.conditions.load_state(t, spread(t, u)->u.data());
  }
  std::vector<HeldAxes> held_bodies() const override {
    constexpr int dim = dimensions(K);
    const PhaseFrame<B, K>& frame = all_.frame;
    std::vector<HeldAxes> held(frame.problem.bodies.size(), HeldAxes{});
    const std::vector<char> is_sprung = all_.conditions.are_sprung(dim * frame.functions_of_grid());
    const auto bodies = BodyNeighbours<dim>(frame.problem, frame.functions, frame.body.points, frame.weights,
                                            frame.body.first_number, frame.ranks)
                            .bodies_of_functions();
    for (std::size_t f = 0; f < bodies.size(); ++f) {
      for (std::size_t axis = 0; axis < dim; ++axis) {
        const auto unknown = static_cast<int>(dim * f + axis);
        if (!frame.held().is_prescribed(unknown) && !frame.held().is_guided(unknown) && !is_sprung[dim * f + axis])
          continue;
        for (const std::size_t body : bodies[f]) held[body][axis] = true;
      }
    }
    return held;
  }

 private:
  auto spread(double t, ConstVec u) const {
    auto work = all_.force.borrow();
    all_.frame.unknowns.spread(t, u, work->u);
    return work;
  }

  const PhaseAssembly<B, K>& all_;
};

}  // namespace stillpoint
