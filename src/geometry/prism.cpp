#include "geometry/prism.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/gauss_rule.hpp"
#include "geometry/polygon_rule.hpp"

namespace stillpoint {

Prism::Prism(Polygon polygon, std::size_t axis, double from, double to)
    : polygon_(std::move(polygon)), axis_(axis), across_(across(axis)), bounds_{} {
  bounds_.low[axis] = from;
  bounds_.high[axis] = to;
  for (std::size_t d = 0; d < 2; ++d) {
    const auto [low, high] = std::ranges::minmax_element(polygon_, {}, [d](const PlanePoint& x) { return x[d]; });
    bounds_.low[across_[d]] = (*low)[d];
    bounds_.high[across_[d]] = (*high)[d];
  }
}

bool Prism::contains(const SpacePoint& x) const {
  return x[axis_] >= bounds_.low[axis_] && x[axis_] <= bounds_.high[axis_] &&
         stillpoint::contains(polygon_, {x[across_[0]], x[across_[1]]});
}

Solid::Part Prism::part_of(const SpaceBox& box) const {
  for (std::size_t d = 0; d < 3; ++d)
    if (box.low[d] >= bounds_.high[d] || box.high[d] <= bounds_.low[d]) return Part::none;
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const PlanePoint &a = polygon_[k], &b = polygon_[(k + 1) % polygon_.size()];
    bool meets = true;
    for (std::size_t d = 0; d < 2; ++d)
      meets = meets && std::max(a[d], b[d]) >= box.low[across_[d]] && std::min(a[d], b[d]) <= box.high[across_[d]];
    if (meets) return Part::some;
  }
  const SpacePoint middle = box.middle();
  if (!stillpoint::contains(polygon_, {middle[across_[0]], middle[across_[1]]})) return Part::none;
  return box.low[axis_] >= bounds_.low[axis_] && box.high[axis_] <= bounds_.high[axis_] ? Part::all : Part::some;
}

SpaceRule Prism::rule(const SpaceBox& box, int degree) const {
  SpaceRule rule;
  const SpaceBox part = in_common(box, bounds_);
  const double length = part.high[axis_] - part.low[axis_];
  std::array<double, 2> side{};
  for (std::size_t d = 0; d < 2; ++d) side[d] = box.high[across_[d]] - box.low[across_[d]];
  Polygon local;  // in coordinates in which the box is the unit square
  for (const PlanePoint& corner : polygon_)
    local.push_back({(corner[0] - box.low[across_[0]]) / side[0], (corner[1] - box.low[across_[1]]) / side[1]});
  const Polygon inside = clipped_to_unit_square(local);
  const double area = inside.size() < 3 ? 0 : std::abs(signed_area(inside));
  if (!(area > 0) || !(length > 0)) return rule;
  const PlaneRule plane = polygon_rule(inside, degree);
  const UnitRule along(degree);
  for (std::size_t k = 0; k < along.at.size(); ++k) {
    for (std::size_t q = 0; q < plane.x.size(); ++q) {
      SpacePoint x{};
      x[axis_] = part.low[axis_] + along.at[k] * length;
      for (std::size_t d = 0; d < 2; ++d) x[across_[d]] = box.low[across_[d]] + plane.x[q][d] * side[d];
      rule.x.push_back(x);
      rule.weight.push_back(plane.share[q] * area * side[0] * side[1] * along.weight[k] * length);
    }
  }
  return rule;
}

}  // namespace stillpoint
