// A scene of one phase, driven step by step as a run drives it, to be looked at on the way.
#pragma once

#include <stillpoint/model.hpp>
#include <stillpoint/relaxation.hpp>

#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

namespace driven {

class Motion {
 public:
  explicit Motion(const stillpoint::Scene& scene)
      : model_(stillpoint::make_model(scene)),
        relaxation_(*model_.phase, *model_.damping, vectors_),
        y_(vectors_.make(2 * model_.phase->size())),
        integrator_(stillpoint::make_integrator(model_.integrator, relaxation_)) {
    std::copy(model_.u.begin(), model_.u.end(), y_.span().begin());
    std::copy(model_.v.begin(), model_.v.end(), y_.span().begin() + static_cast<std::ptrdiff_t>(model_.u.size()));
    integrator_->start(0, y_);
    if (relaxation_.accept(0, y_.span(), integrator_->force_is_current())) integrator_->velocity_changed();
  }

  /// Steps until `end`; look() after every step.
  void run_to(double end, const std::function<void()>& look = {}) {
    while (t_ < end) {
      const stillpoint::StepReport step = integrator_->step(end);
      if (step.status != stillpoint::StepReport::Status::ok) throw std::runtime_error(step.message);
      t_ = step.t;
      if (relaxation_.accept(t_, y_.span(), integrator_->force_is_current())) integrator_->velocity_changed();
      if (look) look();
    }
  }

  double t() const { return t_; }
  const stillpoint::Model& model() const { return model_; }
  stillpoint::LagrangianPhase& phase() { return *model_.phase; }
  stillpoint::RelaxationSystem& relaxation() { return relaxation_; }
  stillpoint::ConstVec u() const { return stillpoint::first_half(y_.span()); }
  stillpoint::ConstVec v() const { return stillpoint::second_half(y_.span()); }
  stillpoint::WallReaction wall(std::size_t number = 0) const { return model_.phase->wall_reactions(t_).at(number); }

  /// Mean over the points, which are of equal mass in these scenes.
  double mean_velocity(std::size_t component) const {
    std::vector<double> v_p(2 * model_.phase->points());
    model_.phase->point_velocity(t_, v(), v_p);
    double sum = 0;
    for (std::size_t p = component; p < v_p.size(); p += 2) sum += v_p[p];
    return sum / static_cast<double>(model_.phase->points());
  }

 private:
  stillpoint::VectorSpace vectors_;
  stillpoint::Model model_;
  stillpoint::RelaxationSystem relaxation_;
  stillpoint::Vector y_;
  std::unique_ptr<stillpoint::Integrator> integrator_;
  double t_ = 0;
};

}  // namespace driven
