// A scene of one phase, driven step by step as a run drives it, to be looked at on the way.
#pragma once

#include <functional>
#include <stdexcept>
#include <vector>

#include "simulation/model.hpp"
#include "simulation/motion.hpp"

namespace driven {

class Motion {
 public:
  explicit Motion(const stillpoint::Scene& scene)
      : model_(stillpoint::make_model(scene)), motion_(model_, vectors_, 0, model_.u, model_.v) {
    motion_.accept(0);
  }

  /// Steps until `end`; look() after every step.
  void run_to(double end, const std::function<void()>& look = {}) {
    while (t_ < end) {
      const stillpoint::StepReport step = motion_.integrator->step(end);
      if (step.status != stillpoint::StepReport::Status::ok) throw std::runtime_error(step.message);
      t_ = step.t;
      motion_.accept(t_);
      if (look) look();
    }
  }

  double t() const { return t_; }
  const stillpoint::Model& model() const { return model_; }
  stillpoint::LagrangianPhase& phase() { return *model_.phase; }
  stillpoint::RelaxationSystem& relaxation() { return motion_.relaxation; }
  stillpoint::ConstVec u() const { return motion_.u(); }
  stillpoint::ConstVec v() const { return motion_.v(); }
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
  stillpoint::Motion motion_;
  double t_ = 0;
};

}  // namespace driven
