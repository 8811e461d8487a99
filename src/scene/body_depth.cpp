#include "scene/body_depth.hpp"

#include <algorithm>
#include <vector>

#include "scene/body_solid.hpp"

namespace stillpoint {

BodyDepth::BodyDepth(const BodySpec& body) : body_(body) {
  if (!body.has_shape()) return;
  if (is_solid(body)) {
    solid_ = solid_of(body);
  } else {
    outline_ = outline_of(body);
  }
}

bool BodyDepth::contains(std::span<const double> X) const {
  for (std::size_t d = 0; d < X.size(); ++d)
    if (X[d] < body_.min[d] || X[d] > body_.max[d]) return false;
  if (solid_) return solid_->contains({X[0], X[1], X[2]});
  return outline_.empty() || stillpoint::contains(outline_, {X[0], X[1]});
}

// In a shape other than a box, the first position outside is searched for in steps, and then between two of them.
std::optional<double> BodyDepth::along(std::span<const double> X, std::size_t axis, bool upwards, double most) const {
  if (!is_known()) return std::nullopt;
  const double to_box = upwards ? body_.max[axis] - X[axis] : X[axis] - body_.min[axis];
  if (body_.is_box()) return std::min(to_box, most);
  constexpr int steps = 64, halvings = 50;
  std::vector<double> at(X.begin(), X.end());
  const auto is_inside = [&](double depth) {
    at[axis] = X[axis] + (upwards ? depth : -depth);
    return contains(at);
  };
  double inside = 0, outside = most;
  for (int step = 1; step <= steps; ++step) {
    outside = most * step / steps;
    if (!is_inside(outside)) break;
    inside = outside;
  }
  if (inside == most) return most;
  for (int halving = 0; halving < halvings; ++halving) {
    const double middle = (inside + outside) / 2;
    (is_inside(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace stillpoint
