#include "space/boundary/border_of_body.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace stillpoint {
namespace {

/// Whether numbers are those at which parts of so many end, none of them empty.
bool are_ends(const std::vector<std::size_t>& ends, std::size_t of) {
  const bool ascend = std::ranges::adjacent_find(ends, std::ranges::greater_equal{}) == ends.end();
  return !ends.empty() && ascend && ends.front() > 0 && ends.back() == of;
}

}  // namespace

template <Kinematics K>
void BorderOfBody<K>::archive(const StateArchive& state) {
  if (!ends_of_chains.empty()) {
    std::vector<std::size_t> new_ends_of_chains = ends_of_chains, ends;
    for (const SurfacePatch& patch : patches) ends.push_back(patch.end);
    state("chains", new_ends_of_chains, "patches", ends);
    if (state.restores()) take_numbers(new_ends_of_chains, ends);
    state.each(
        "undeformed", pieces, [](BorderPiece<K> & piece) -> auto& { return piece.X; });
    std::vector<double> sizes;
    for (const BorderPiece<K>& piece : pieces) sizes.push_back(piece.area);
    for (const SurfacePatch& patch : patches) sizes.push_back(patch.cell), sizes.push_back(patch.depth);
    state("sizes", Vec(sizes));
    auto from = sizes.begin();
    for (BorderPiece<K>& piece : pieces) piece.area = *from++;
    for (SurfacePatch& patch : patches) patch.cell = *from++, patch.depth = *from++;
  }
  state.each(
      "positions", pieces, [](BorderPiece<K> & piece) -> auto& { return piece.at.x; });
  state.each(
      "gone", pieces, [](BorderPiece<K> & piece) -> auto& { return piece.gone; });
  state.each(
      "areas", pieces, [](BorderPiece<K> & piece) -> auto& { return piece.vector; });
  std::vector<double> stiffness;
  for (const SurfacePatch& patch : patches) stiffness.push_back(patch.stiffness);
  state("stiffness", Vec(stiffness));
  for (std::size_t k = 0; k < patches.size(); ++k) patches[k].stiffness = stiffness[k];
}

template <Kinematics K>
void BorderOfBody<K>::take_numbers(const std::vector<std::size_t>& new_ends_of_chains,
                                   const std::vector<std::size_t>& ends) {
  if (new_ends_of_chains.size() != ends_of_chains.size() || !are_ends(new_ends_of_chains, ends.size()) ||
      !are_ends(ends, ends.empty() ? 0 : ends.back()))
    throw StateError("'chains' and 'patches' are not those of a border");
  std::vector<SurfacePatch> all;
  for (std::size_t c = 0; c < ends_of_chains.size(); ++c) {
    const SurfacePatch like = patches[c == 0 ? 0 : ends_of_chains[c - 1]];
    for (std::size_t k = all.size(); k < new_ends_of_chains[c]; ++k) {
      all.push_back(like);
      all[k].begin = k == 0 ? 0 : ends[k - 1], all[k].end = ends[k];
    }
  }
  patches = std::move(all);
  ends_of_chains = new_ends_of_chains;
  const BorderPiece<K> like = pieces.front();
  pieces.resize(ends.back(), like);
}

template struct BorderOfBody<Kinematics::line>;
template struct BorderOfBody<Kinematics::plane>;
template struct BorderOfBody<Kinematics::axisymmetric>;
template struct BorderOfBody<Kinematics::space>;

}  // namespace stillpoint
