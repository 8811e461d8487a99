// Messages about a phase that fails: which point or node, which quantity, what to try.
#pragma once

#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
PlaceInBody MaterialPointPhase<B, K>::of_point(std::size_t number) const {
  PlaceInBody at;
  for_points([&](std::size_t k, std::size_t p, std::size_t n) {
    if (n == number) at = account().place(k, p);
  });
  return at;
}

// The place of an unknown, beside the point at which the function's |N| is largest.
template <AxisBasis B, Kinematics K>
PlaceInBody MaterialPointPhase<B, K>::of_unknown(std::size_t unknown) const {
  const int function = dofs_->free[unknown] / Dim;
  PlaceInBody at{.what = "the node"};
  for (int d = 0; d < Dim; ++d) at.position.push_back(B::centre(grid_.axes[d], Basis::index_along(grid_, function, d)));
  double largest = -1;
  for_points([&](std::size_t k, std::size_t p, std::size_t) {
    const auto N = weights_.N(k, p);
    for (int a = 0; a < per_cell; ++a) {
      if (weights_.function(k, a) != function || !(std::abs(N[a]) > largest)) continue;
      largest = std::abs(N[a]);
      const PlaceInBody point = account().place(k, p);
      at.material_point = point.what;
      at.cell = point.cell;
    }
  });
  return at;
}

template <AxisBasis B, Kinematics K>
std::string MaterialPointPhase<B, K>::refusal(TrialState& any) const {
  Trial& trial = own(any);
  if (!trial.too_far) return refusal_at_points(trial);
  std::vector<double> u(size());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = trial.arrays->u[static_cast<std::size_t>(dofs_->free[k])];
  return refusal_of_motion(u);
}

template <AxisBasis B, Kinematics K>
std::string MaterialPointPhase<B, K>::refusal_of_motion(ConstVec u) const {
  std::size_t furthest = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (!(std::abs(u[k]) <= std::abs(u[furthest]))) furthest = k;
  }
  return fmt::format(
      "{} would move by {:.3g} m within one step, further than a phase may go; expected a smaller "
      "integrator.step_fraction, loads that grow more slowly, or a larger phase.max_motion",
      to_string(of_unknown(furthest)), u[furthest]);
}

/// The name of a component of P: "P.xy".
template <Kinematics K>
std::string name_of_stress(int component) {
  constexpr int dim = dimensions(K);
  constexpr const char* axes = K == Kinematics::axisymmetric ? "rz" : "xyz";
  if (component == dim * dim) return "P.tt";
  return std::string("P.") + axes[component / dim] + axes[component % dim];
}

// The message about the point with the smallest det f among those without a finite stress; of several the first by
// number.
template <AxisBasis B, Kinematics K>
std::string MaterialPointPhase<B, K>::refusal_at_points(Trial& trial) const {
  struct Bad {
    double det_f = 0, stress = 0;
    int component = 0;
    std::size_t p = 0;
    int number = 0;
  };
  std::vector<Bad> all;
  const double dt = trial.t - committed_t_;
  const auto look = [&](std::size_t m, Block& block) {
    double* history = history_dependent_ ? trial.arrays->history[m].data() : nullptr;
    std::array<double, Block::size> det;  // det f of the displacement itself, not of a mean
    for (std::size_t q = 0; q < block.count; ++q) det[q] = determinant<K>(plus_identity<K>(block.H_at(q)));
    stress<true>(m, block, history_dependent_ ? dt : 0, history, nullptr);
    for (std::size_t q = 0; q < block.count; ++q) {
      for (int c = 0; c < components; ++c) {
        if (std::isfinite(block.VP[c][q])) continue;
        const double det_f = det[q];
        const std::size_t p = block.first + q;
#pragma omp critical(stillpoint_diagnosis)
        all.push_back({det_f, block.VP[c][q], c, p, body_.points.number[p]});
        break;
      }
    }
    return 0.0;
  };
  std::vector<double> R(size()), reactions(dofs_->prescribed.size());
  take_means(trial.arrays->u.data());
  nodal_force_.template evaluate<true>(trial.arrays->u.data(), committed_u_.data(), std::cref(look), *dofs_, R,
                                       reactions);
  if (all.empty()) return "a stress that is not finite";
  const auto& points = body_.points;
  const Bad worst = *std::ranges::min_element(
      all, [](const Bad& a, const Bad& b) { return std::pair(a.det_f, a.number) < std::pair(b.det_f, b.number); });
  std::size_t k = 0;
  while (points.end(k) <= worst.p) ++k;
  const std::string at = to_string(account().place(k, worst.p));
  const std::string others = all.size() > 1 ? fmt::format(" (and at {} other points)", all.size() - 1) : "";
  if (!std::isfinite(worst.det_f)) return "the displacement is not finite at " + at + others;
  if (worst.det_f <= 0) {
    return fmt::format(
        "det f = {:.3g} <= 0 at {}{}: the material is turned inside out; expected loads that are smaller or grow more "
        "slowly, a smaller integrator.step_fraction{}",
        worst.det_f, at, others, updated_lagrangian() ? "" : ", or phases that end (phase.max_motion = 0.1)");
  }
  return fmt::format(
      "the stress {} of the law is not finite ({}) at {}{}, where det f = {:.3g}; expected smaller loads, a smaller "
      "integrator.step_fraction, or other parameters of material.{}",
      name_of_stress<K>(worst.component), worst.stress, at, others, worst.det_f,
      body_.material_names[static_cast<std::size_t>(points.material_of_cell(k))]);
}

}  // namespace stillpoint
