// The patches around each patch of a border, over which changes of multipliers are smoothed.
//
// Pressures that go to and fro from patch to patch cancel at the functions between them: the body does not feel them,
// and nothing takes back what a gap of that kind, which no motion closes, adds to them from update to update. A mean
// over each patch and its neighbours, with the weights ¼, ½, ¼ along each direction of an even border, has nothing of
// it, and leaves what is even as it is.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "space/boundary/border_of_body.hpp"
#include "space/boundary/border_piece.hpp"

namespace stillpoint {

class PatchNeighbours {
 public:
  /// The patches and pieces of a surface, as they are when a phase begins.
  template <Kinematics K>
  void find(std::span<const SurfacePatch> patches, const std::vector<BorderPiece<K>>& pieces);

  /// The mean of a value at patch k and at its neighbours, of those that count, as k itself has to; (patches).
  template <class Value>
  Value smoothed(std::size_t k, const std::vector<Value>& values, const std::vector<char>& counts) const {
    Value sum = values[k];
    double weights = 1;
    for (std::size_t n = begin_[k]; n < begin_[k + 1]; ++n) {
      if (!counts[list_[n].patch]) continue;
      sum += list_[n].weight * values[list_[n].patch];
      weights += list_[n].weight;
    }
    return sum / weights;
  }

 private:
  struct Neighbour {
    std::size_t patch;
    double weight;  // relative to that of the patch itself
  };
  std::vector<std::size_t> begin_{0};  // the first neighbour of each patch, (patches + 1)
  std::vector<Neighbour> list_;
};

}  // namespace stillpoint
