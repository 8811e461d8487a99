#include "space/points/weight_above.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/gauss_rule.hpp"
#include "scene/grid_lines.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/points/value_by_place.hpp"

namespace stillpoint {

WeightAbove::WeightAbove(const Problem& problem, const std::vector<const BodySpec*>& bodies,
                         std::optional<double> surface)
    : b_y_(problem.body_force.at(1)({}, 0)),
      surface_(surface),
      highest_(surface.value_or(problem.grid.max[1])),
      step_(touching * smallest_cell(problem.grid, 1)),
      lines_(grid_lines(problem.grid, 1)) {
  for (const BodySpec* body : bodies) {
    depths_.emplace_back(*body);
    materials_.push_back(&problem.materials.at(body->material));
  }
  if (!surface || bodies.empty()) return;
  const double first = materials_.front()->parameters.at("rho");
  by_depth_ = std::ranges::all_of(materials_,
                                  [&](const MaterialSpec* one) {
                                    return !one->by_place.contains("rho") && one->parameters.at("rho") == first;
                                  }) ||
              std::ranges::any_of(depths_, [](const BodyDepth& depth) { return !depth.is_known(); });
}

double WeightAbove::operator()(std::vector<double> X, const MaterialSpec& of) const {
  const MaterialSpec* last = &of;
  double weight = 0, from = X[1];
  for (std::optional<std::size_t> k = by_depth_ ? std::nullopt : body_at(X); k && X[1] < highest_; k = body_at(X)) {
    const double rest = highest_ - X[1], up = std::clamp(depths_[*k].along(X, 1, true, rest).value_or(rest), 0.0, rest);
    const double to = X[1] + up;
    last = materials_[*k];
    weight += column(*last, X, from, to);
    from = to;
    X[1] = to + step_;
  }
  return surface_ ? weight + column(*last, X, from, *surface_) : weight;
}

std::optional<std::size_t> WeightAbove::body_at(const std::vector<double>& X) const {
  for (std::size_t k = 0; k < depths_.size(); ++k)
    if (depths_[k].contains(X)) return k;
  return std::nullopt;
}

// ∫ ρ b_y dy of a material along the vertical through X. A formula is integrated from one line of the grid to the next,
// where layers end, by a rule that is exact for polynomials up to the fifth degree.
double WeightAbove::column(const MaterialSpec& material, std::vector<double> X, double from, double top) const {
  if (!material.by_place.contains("rho")) return material.parameters.at("rho") * b_y_ * std::max(0.0, top - from);
  double weight = 0;
  while (from < top) {
    const auto next = std::ranges::upper_bound(lines_, from);
    const double to = next == lines_.end() ? top : std::min(*next, top);
    const GaussRule rule(from, to, 3);
    for (std::size_t i = 0; i < rule.at.size(); ++i) {
      X[1] = rule.at[i];
      weight += rule.weight[i] * b_y_ * value_by_place(material, "rho", X);
    }
    from = to;
  }
  return weight;
}

std::array<double, 3> stress_at_rest(const Expression& K0, double sigma_yy, const std::vector<double>& X,
                                     const std::string& key) {
  const double ratio = K0(X, 0);
  if (!(ratio > 0) || !std::isfinite(ratio))
    throw_scene_error(key, fmt::format("must be > 0 everywhere, not {} at ({:.6g})", ratio, fmt::join(X, ", ")));
  return {ratio * sigma_yy, sigma_yy, ratio * sigma_yy};
}

}  // namespace stillpoint
