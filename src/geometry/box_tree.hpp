// A tree of bounding boxes, by which the nearest of many things is found without looking at most of them.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "geometry/solid.hpp"

namespace stillpoint {

/// The smallest box with all of these points, of which there is one at least.
SpaceBox box_around(std::span<const SpacePoint> points);

class BoxTree {
 public:
  /// boxes: a box around each thing, of which there is one at least. The boxes are halved at the median of their
  /// middles along the longest side, until a few are left.
  explicit BoxTree(const std::vector<SpaceBox>& boxes);

  /// The number of the thing that is nearest to x. squared_distance(k): that of thing k; called in the order of the
  /// boxes' distances as long as these are less than the least so far. If x is not a number, it is some thing.
  template <class SquaredDistance>
  std::size_t nearest(const SpacePoint& x, const SquaredDistance& squared_distance) const {
    Search search;
    descend(0, x, squared_distance, search);
    return search.nearest;
  }

 private:
  struct Node {
    SpaceBox box;
    std::size_t first, count;  // in order_; count is 0 for a node with children
    std::size_t other = 0;     // the second child; the first is the next node
  };
  struct Search {
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
  };

  void divide(const std::vector<SpaceBox>& boxes, std::size_t first, std::size_t count);
  static double squared_distance_of(const SpaceBox& box, const SpacePoint& x);

  template <class SquaredDistance>
  void descend(std::size_t number, const SpacePoint& x, const SquaredDistance& squared_distance, Search& search) const {
    const Node& node = nodes_[number];
    for (std::size_t k = node.first; k < node.first + node.count; ++k) {
      const double here = squared_distance(order_[k]);
      if (here < search.least) search = {here, order_[k]};
    }
    if (node.count > 0) return;
    std::size_t near = number + 1, far = node.other;
    double to_near = squared_distance_of(nodes_[near].box, x), to_far = squared_distance_of(nodes_[far].box, x);
    if (to_far < to_near) {
      std::swap(near, far);
      std::swap(to_near, to_far);
    }
    if (to_near < search.least) descend(near, x, squared_distance, search);
    if (to_far < search.least) descend(far, x, squared_distance, search);
  }

  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace stillpoint
