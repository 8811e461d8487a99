// The groups of patches of a border, those of a cell each, and the groups around each of them, over which changes of
// multipliers are smoothed.
//
// Pressures that go to and fro from patch to patch cancel at the functions between them: the body does not feel them,
// and nothing takes back what a gap of that kind, which no motion closes, adds to them from update to update. Patches
// finer than cells, as those of domains, can do so in many ways: what they have in common changes alone. Beyond that
// the mean of a group and of its neighbours,
//
//   S = ½ (I + D⁻¹ A),   D = diag Σ_l A_kl,
//
// with the weights ¼, ½, ¼ along an even border, has nothing of what alternates from cell to cell, at the ends of what
// is touched either, and leaves what is even as it is. No eigenvalue of S is below 0, whatever the weights A of the
// neighbours are, nor above 1.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "space/boundary/border_of_body.hpp"
#include "space/boundary/border_piece.hpp"

namespace stillpoint {

class PatchNeighbours {
 public:
  /// The patches and pieces of a surface, as they are when a phase begins. groups: the number of each patch's group,
  /// which ascend by one at most; empty: each patch is one.
  template <Kinematics K>
  void find(std::span<const SurfacePatch> patches, const std::vector<BorderPiece<K>>& pieces,
            const std::vector<std::size_t>& groups);

  std::size_t groups() const { return begin_.size() - 1; }
  std::size_t group_of(std::size_t patch) const { return group_.empty() ? patch : group_[patch]; }
  /// The mean of a value at group k and at its neighbours, of those that count, as k itself has to; (groups).
  template <class Value>
  Value smoothed(std::size_t k, const std::vector<Value>& values, const std::vector<char>& counts) const {
    Value sum = 0 * values[k];
    double weights = 0;
    for (std::size_t n = begin_[k]; n < begin_[k + 1]; ++n) {
      if (!counts[list_[n].group]) continue;
      sum += list_[n].weight * values[list_[n].group];
      weights += list_[n].weight;
    }
    return weights > 0 ? Value(0.5 * values[k] + 0.5 / weights * sum) : values[k];
  }

 private:
  struct Neighbour {
    std::size_t group;
    double weight;
  };
  std::vector<std::size_t> group_;     // of each patch; empty: see find()
  std::vector<std::size_t> begin_{0};  // the first neighbour of each group, (groups + 1)
  std::vector<Neighbour> list_;
};

}  // namespace stillpoint
