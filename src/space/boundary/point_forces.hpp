// Forces at points of the body, which move with it: F_i = w_i P(t), see carried_point.hpp.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/contact_bodies.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/boundary_condition.hpp"
#include "space/boundary/carried_point.hpp"
#include "space/boundary/loads_before.hpp"

namespace stillpoint {

template <int Dim>
class PointForces final : public BoundaryCondition<Dim> {
  using typename BoundaryCondition<Dim>::Parts;

 public:
  explicit PointForces(const Problem& problem) : problem_(problem) {
    for (const PointForceSpec& force : problem.forces) std::copy_n(force.at.begin(), Dim, at_.emplace_back().x.begin());
  }

  void begin_phase(const Parts& phase, Vec F) override {
    find(phase);
    varying_.clear();
    for (std::size_t f = 0; f < at_.size(); ++f) {
      for (int i = 0; i < Dim; ++i) {
        const Expression& value = problem_.forces[f].value[static_cast<std::size_t>(i)];
        Varying load{&value, weights_of(at_[f], i, phase.dofs)};
        if (value.uses('t')) {
          varying_.push_back(std::move(load));
        } else {
          add(load, 0, F);
        }
      }
    }
  }
  std::string_view kind() const override { return "forces"; }
  bool varies() const override { return !varying_.empty(); }
  void add_load(const Parts&, double t, Vec F) const override {
    for (const Varying& load : varying_) add(load, t, F);
  }
  void add_load_on_supports(const Parts& phase, double t, const double*, Vec F_s) const override {
    for (std::size_t f = 0; f < at_.size(); ++f) {
      at_[f].for_prescribed(phase.dofs, [&](const auto& entry, int i, std::size_t s, double share) {
        F_s[s] += entry.w * share * problem_.forces[f].value[static_cast<std::size_t>(i)]({}, t);
      });
    }
  }
  void archive(const StateArchive& state) override {
    state.each(
        "force_positions", at_, [](auto& at) -> auto& { return at.x; });
    if (problem_.phase.at_stages) LoadsBefore::archive_numbers(state, numbers_of_forces());
  }
  // Forces that have ended are left out, and those that begin act where the scene says.
  void take_over(const StateArchive& state) override {
    const LoadsBefore before(state, numbers_of_forces());
    std::vector<double> x;
    state("force_positions", x);
    for (std::size_t f = 0; f < at_.size(); ++f)
      if (const auto place = before.place_of(f)) before.copy_to(at_[f].x, x, *place);
  }
  void end_phase(const double* u) override {
    for (auto& at : at_) at.move(u);
  }

 private:
  struct Varying {
    const Expression* value;
    std::vector<std::pair<int, double>> weights;  // (free degree of freedom, w_i)
  };

  static void add(const Varying& load, double t, Vec F) {
    const double force = (*load.value)({}, t);
    for (const auto& [dof, weight] : load.weights) F[static_cast<std::size_t>(dof)] += weight * force;
  }

  std::vector<std::size_t> numbers_of_forces() const {
    std::vector<std::size_t> numbers;
    for (const PointForceSpec& force : problem_.forces) numbers.push_back(force.number);
    return numbers;
  }

  void find(const Parts& phase) {
    for (std::size_t f = 0; f < at_.size() && !has_begun_; ++f) {
      if (phase.functions.fields() > 1) choose_field(f, phase);
      at_[f].freeze(cell_with_functions_at<Dim>(phase.functions, at_[f].x), phase);
      for (const auto& entry : at_[f].entries) {
        if (entry.function < 0 && std::abs(entry.w) > 1e-12)
          throw_scene_error(fmt::format("force[{}].at", f), "there is no material at this place");
      }
    }
    if (problem_.phase.ends()) {
      freeze_carried(
          at_, [](CarriedPoint<Dim> & at) -> auto& { return at; }, !has_begun_, phase);
    }
    has_begun_ = true;
  }

  // That of the body in which it lies: near another one the nearest point may be of that.
  void choose_field(std::size_t f, const Parts& phase) {
    const std::vector<std::size_t> bodies = bodies_at(problem_, problem_.forces[f].at);
    if (!bodies.empty()) at_[f].field = phase.points.field_of(bodies.front());
  }

  static std::vector<std::pair<int, double>> weights_of(const CarriedPoint<Dim>& at, int component,
                                                        const DegreesOfFreedom& dofs) {
    std::vector<std::pair<int, double>> weights;
    at.for_free(dofs, [&](const auto& entry, int i, int dof, double share) {
      if (i == component && entry.w != 0) weights.emplace_back(dof, entry.w * share);
    });
    return weights;
  }

  const Problem& problem_;
  std::vector<CarriedPoint<Dim>> at_;  // position of each force
  bool has_begun_ = false;             // whether the first phase has begun
  std::vector<Varying> varying_;       // the forces that depend on t, in the present phase
};

}  // namespace stillpoint
