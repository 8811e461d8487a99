// A user-defined body force, b(x, t) for all points at once.
#pragma once

#include <memory>
#include <vector>

#include "base/work_pool.hpp"
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
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto at = points.position(p);
      for (std::size_t d = 0; d < dim; ++d) x_[dim * p + d] = at[d];
    }
    if (varies()) return;
    steady_ = *ask(phase.held.start());
    add_point_loads(phase, at_points(steady_), F);
  }
  std::string_view kind() const override { return "own_load"; }
  bool varies() const override { return own_->about.settles_at > 0; }
  void add_load(const Parts& phase, double t, Vec F) const override {
    if (!varies()) return;
    add_point_loads(phase, at_points(*ask(t)), F);
  }
  void add_load_on_supports(const Parts& phase, double t, const double*, Vec F_s) const override {
    if (!varies()) return add_point_loads_on_supports(phase, at_points(steady_), F_s);
    add_point_loads_on_supports(phase, at_points(*ask(t)), F_s);
  }

 private:
  // The values at t, (points × dim) [m/s²].
  WorkPool<std::vector<double>>::Loan ask(double t) const {
    auto b = values_.borrow();
    b->resize(x_.size());
    own_->b(t, Dim, x_, *b);
    return b;
  }
  static auto at_points(const std::vector<double>& b) {
    return [&b](std::size_t p, int i) { return b[dim * p + static_cast<std::size_t>(i)]; };
  }

  std::shared_ptr<const OwnLoadRow> own_;
  std::vector<double> x_;       // positions when the phase began, (points × dim) [m]
  std::vector<double> steady_;  // values that do not depend on t, (points × dim) [m/s²]
  WorkPool<std::vector<double>> values_;
};

}  // namespace stillpoint
