// A scene stepped as a run steps it, to be looked at on the way.
#pragma once

#include <stillpoint/simulation.hpp>

#include <functional>
#include <stdexcept>
#include <vector>

#include "simulation/parts.hpp"
#include "simulation/setup/model.hpp"

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
  const stillpoint::Model& model() const { return simulation_.parts().model; }
  stillpoint::LagrangianPhase& phase() { return simulation_.parts().phase; }
  stillpoint::RelaxationSystem& relaxation() { return simulation_.system(); }
  stillpoint::ConstVec u() const { return simulation_.u(); }
  stillpoint::ConstVec v() const { return simulation_.v(); }
  stillpoint::WallReaction wall(std::size_t number = 0) { return phase().supports().wall_reactions(t()).at(number); }

  /// Mean over the points, which are of equal mass in these scenes.
  std::vector<double> mean_velocity() {
    const auto dim = static_cast<std::size_t>(phase().dim());
    const stillpoint::ConstVec v_p = simulation_.field("v");
    std::vector<double> mean(dim, 0);
    for (std::size_t k = 0; k < v_p.size(); ++k) mean[k % dim] += v_p[k] / static_cast<double>(simulation_.points());
    return mean;
  }
  double mean_velocity(std::size_t component) { return mean_velocity()[component]; }

 private:
  stillpoint::Simulation simulation_;
};

}  // namespace driven
