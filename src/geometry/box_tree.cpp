#include "geometry/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace stillpoint {

SpaceBox box_around(std::span<const SpacePoint> points) {
  SpaceBox box{points.front(), points.front()};
  for (const SpacePoint& x : points) {
    for (std::size_t d = 0; d < 3; ++d) {
      box.low[d] = std::min(box.low[d], x[d]);
      box.high[d] = std::max(box.high[d], x[d]);
    }
  }
  return box;
}

BoxTree::BoxTree(const std::vector<SpaceBox>& boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  divide(boxes, 0, boxes.size());
}

void BoxTree::divide(const std::vector<SpaceBox>& boxes, std::size_t first, std::size_t count) {
  constexpr std::size_t in_leaf = 4;
  const std::size_t number = nodes_.size();
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = begin + static_cast<std::ptrdiff_t>(count), middle = begin + static_cast<std::ptrdiff_t>(count / 2);
  std::vector<SpacePoint> ends;
  for (auto k = begin; k != end; ++k) ends.insert(ends.end(), {boxes[*k].low, boxes[*k].high});
  const SpaceBox around = box_around(ends);
  nodes_.push_back({around, first, count <= in_leaf ? count : 0});
  if (count <= in_leaf) return;
  std::size_t longest = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (around.high[d] - around.low[d] > around.high[longest] - around.low[longest]) longest = d;
  std::nth_element(begin, middle, end, [&](std::size_t a, std::size_t b) {
    return boxes[a].middle()[longest] < boxes[b].middle()[longest];
  });
  divide(boxes, first, count / 2);
  nodes_[number].other = nodes_.size();
  divide(boxes, first + count / 2, count - count / 2);
}

double BoxTree::squared_distance_of(const SpaceBox& box, const SpacePoint& x) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double beyond = std::max({box.low[d] - x[d], x[d] - box.high[d], 0.0});
    sum += beyond * beyond;
  }
  return sum;
}

}  // namespace stillpoint
