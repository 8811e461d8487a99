// A user-defined body force, b(x, t) for all points at once.
#pragma once

#include <memory>
#include <vector>

#include "scene/own_loads.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/boundary_condition.hpp"
#include "space/boundary/point_loads.hpp"

namespace stillpoint {

template <int Dim>
class OwnBodyForceCondition final : public BoundaryCondition<Dim> {
  static constexpr std::size_t dim = Dim;
  using typename BoundaryCondition<Dim>::Parts;

 public:
  explicit OwnBodyForceCondition(const Problem& problem) : own_(own_load(problem.own_load)) {
    if (!own_) throw_scene_error("body_force.own", unknown_own_load(problem.own_load));
  }

  void begin_phase(const Parts& phase, Vec F) override {
    const auto& points = phase.points;
    x_.resize(dim * points.size());
    b_.resize(x_.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto at = points.position(p);
      for (std::size_t d = 0; d < dim; ++d) x_[dim * p + d] = at[d];
    }
    if (varies()) return;
    ask(phase.held.start());
    add_point_loads(phase, at_points(), F);
  }
  bool varies() const override { return own_->about.settles_at > 0; }
  void add_load(const Parts& phase, double t, Vec F) const override {
    if (!varies()) return;
    ask(t);
    add_point_loads(phase, at_points(), F);
  }
  void add_load_on_supports(const Parts& phase, double t, const double*, Vec F_s) const override {
    if (varies()) ask(t);
    add_point_loads_on_supports(phase, at_points(), F_s);
  }

 private:
  void ask(double t) const { own_->b(t, Dim, x_, b_); }
  auto at_points() const {
    return [this](std::size_t p, int i) { return b_[dim * p + static_cast<std::size_t>(i)]; };
  }

  std::shared_ptr<const OwnLoadRow> own_;
  std::vector<double> x_;          // positions when the phase began, (points × dim) [m]
  mutable std::vector<double> b_;  // value of the last evaluation, (points × dim) [m/s²]
};

}  // namespace stillpoint
