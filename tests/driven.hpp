// A scene stepped as a run steps it, to be looked at on the way.
#pragma once

#include <stillpoint/simulation.hpp>

#include <functional>
#include <stdexcept>
#include <vector>

#include "simulation/model.hpp"

namespace driven {

class Motion {
 public:
  explicit Motion(const stillpoint::Scene& scene) : simulation_(scene, {.records = false, .stops = false}) {}

  /// Steps until `end`; look() after every step.
  void run_to(double end, const std::function<void()>& look = {}) {
    while (t() < end) {
      if (simulation_.step(end) != stillpoint::RunStatus::running) throw std::runtime_error(simulation_.reason());
      if (look) look();
    }
  }

  double t() const { return simulation_.t(); }
  const stillpoint::Model& model() const { return simulation_.model(); }
  stillpoint::LagrangianPhase& phase() { return simulation_.phase(); }
  stillpoint::RelaxationSystem& relaxation() { return simulation_.system(); }
  stillpoint::ConstVec u() const { return simulation_.u(); }
  stillpoint::ConstVec v() const { return simulation_.v(); }
  stillpoint::WallReaction wall(std::size_t number = 0) { return phase().wall_reactions(t()).at(number); }

  /// Mean over the points, which are of equal mass in these scenes.
  double mean_velocity(std::size_t component) {
    const stillpoint::ConstVec v_p = simulation_.field("v");
    double sum = 0;
    for (std::size_t p = component; p < v_p.size(); p += 2) sum += v_p[p];
    return sum / static_cast<double>(simulation_.points());
  }

 private:
  stillpoint::Simulation simulation_;
};

}  // namespace driven
