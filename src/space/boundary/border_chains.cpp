#include "space/boundary/border_chains.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

namespace stillpoint {

template <Kinematics K>
void BorderChains<K>::add(const BodySpec& body, const std::vector<BorderPatch<K>>& patches, std::size_t first) {
  const int along = std::min(body.points_per_cell[0], body.points_per_cell[1]);
  const double longest = std::min(1.2, 1.5 / along);  // [cells]: pieces begin 1/along apart
  for (std::size_t k = 0; k < patches.size();) {
    std::size_t end = k + 1;
    while (end < patches.size() && patches[end].goes_on) ++end;
    const std::array<FaceEnd, 2> ends = {patches[k].ends[0], patches[end - 1].ends[1]};
    chains_.push_back({first + k, first + end, BorderChain<K>(patches[end - 1].closes, ends, longest)});
    k = end;
  }
}

template <Kinematics K>
auto BorderChains<K>::linked(const Chain& chain, const Pieces& pieces, const Patches& patches) -> LinkedPatches {
  LinkedPatches all;
  for (std::size_t k = chain.begin; k < chain.end; ++k) {
    all.push_back({patches[k].cell, patches[k].depth, {}});
    for (std::size_t s = patches[k].begin; s < patches[k].end; ++s) {
      const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * pieces[s].X[0] : patches[k].depth;
      all.back().links.push_back({pieces[s], pieces[s].area / depth, {{s, s}, {k, k}}});
    }
  }
  return all;
}

template <Kinematics K>
std::vector<PieceOrigin> BorderChains<K>::cut_anew(Pieces& pieces, Patches& patches) {
  if (empty()) return {};
  // The weights are those of the phase that has ended, and would be copied with the pieces.
  for (BorderPiece<K>& piece : pieces) piece.at.entries.clear();
  std::vector<PieceOrigin> origins;
  Pieces next_pieces;
  Patches next_patches;
  bool changed = false;
  for (Chain& chain : chains_) {
    LinkedPatches cut = linked(chain, pieces, patches);
    if constexpr (dimensions(K) == 2) changed = chain.chain.cut(cut) || changed;
    chain.begin = next_patches.size();
    for (const auto& [cell, depth, links] : cut) {
      SurfacePatch patch = patches[links.front().origin.patch[0]];
      patch.begin = next_pieces.size(), patch.stiffness = 0;
      for (const auto& [piece, length, origin] : links) {
        next_pieces.push_back(piece), origins.push_back(origin);
        for (const std::size_t before : origin.patch)
          patch.stiffness += patches[before].stiffness / static_cast<double>(2 * links.size());
      }
      patch.end = next_pieces.size();
      next_patches.push_back(patch);
    }
    chain.end = next_patches.size();
  }
  pieces = std::move(next_pieces);  // their areas have changed
  if (!changed) return {};
  patches = std::move(next_patches);
  return origins;
}

template <Kinematics K>
std::vector<std::size_t> BorderChains<K>::ends(std::size_t first, std::size_t end) const {
  std::vector<std::size_t> ends;
  for (const Chain& chain : chains_)
    if (chain.begin >= first && chain.begin < end) ends.push_back(chain.end - first);
  return ends;
}

template <Kinematics K>
void BorderChains<K>::take_ends(const std::vector<std::size_t>& ends) {
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    chains_[c].begin = c == 0 ? 0 : ends[c - 1];
    chains_[c].end = ends[c];
  }
}

template class BorderChains<Kinematics::line>;
template class BorderChains<Kinematics::plane>;
template class BorderChains<Kinematics::axisymmetric>;
template class BorderChains<Kinematics::space>;

}  // namespace stillpoint
