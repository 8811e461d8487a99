// How stiff a body is for the functions at a position of it, by the bounds G_a ≥ Σ_b |K_ab| of these functions.
#pragma once

#include <functional>
#include <vector>

namespace stillpoint {

/// The stiffness_bound() of a phase, G, computed only on demand, (functions) [N/m].
using StiffnessBound = std::function<std::vector<double>()>;

/// Sums over the functions a at a position, with weights w_a.
struct StiffnessAt {
  double ww = 0, compliance = 0;  // Σ w_a², Σ w_a²/G_a

  void add(double w, double G) {
    ww += w * w;
    compliance += w * w / G;
  }
};

}  // namespace stillpoint
