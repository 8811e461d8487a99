// A material point with a history on a path of strain.
#pragma once

#include <stillpoint/material.hpp>

#include <cstddef>

namespace stillpoint::test {

/// Around a sample in a test of a laboratory [Pa].
constexpr double cell_pressure = -1e5;

/// Each step is a trial from the committed history, then committed.
template <class Law, class Parameters>
struct HistoryPath {
  static constexpr StressState state = Law::state;
  static constexpr std::size_t stresses = stress_components(state);
  Law law;
  typename Law::History now{};
  Gradient<state> H{};

  explicit HistoryPath(const Parameters& m, const Stress<state>& stress = {}) : law(m) {
    now = law.initial_history(stress);
  }
  Gradient<state> step(const Gradient<state>& to, double dt = 0) {
    Gradient<state> dH;
    for (std::size_t a = 0; a < H.size(); ++a) dH[a] = to[a] - H[a];
    H = to;
    return law.first_piola(H, dH, dt, now);
  }
  /// The stress that such a step would lead to.
  Stress<state> stress_after(const Gradient<state>& to) const {
    HistoryPath trial = *this;
    trial.step(to);
    return trial.stress();
  }
  /// Straight to H in equal increments.
  void go(const Gradient<state>& to, int steps, double dt = 0) {
    const Gradient<state> from = H;
    for (int k = 1; k <= steps; ++k) {
      Gradient<state> next;
      for (std::size_t a = 0; a < H.size(); ++a) next[a] = from[a] + (to[a] - from[a]) * k / steps;
      step(next, dt);
    }
  }
  Stress<state> stress() const { return law.cauchy(now); }
  double gap() const { return now[stresses]; }
  double plastic_strain() const { return now[stresses + 1]; }
};

}  // namespace stillpoint::test
