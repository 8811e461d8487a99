// The border of one body on a surface, as it is saved, and as one stage of a run hands it on to the next.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <cstddef>
#include <vector>

#include "space/boundary/border_piece.hpp"

namespace stillpoint {

/// A patch of a surface.
struct SurfacePatch {
  std::size_t body = 0;            // number in the scene
  std::size_t begin = 0, end = 0;  // its pieces
  double cell = 0;                 // the width of its cell, ∛(volume) in space [m]
  double depth = 1;                // thickness, or 2 π r if axisymmetric [m]; 1 in space
  double stiffness = 0;            // κ [N/m³]
  // In the present phase:
  std::size_t first_function = 0, end_function = 0;  // its functions, in functions_of_patches()
  double weight = 0;                                 // the largest Σ_a |w_a| of its pieces
};

template <Kinematics K>
struct BorderOfBody {
  std::vector<BorderPiece<K>> pieces;
  std::vector<SurfacePatch> patches;        // whose pieces are counted from the first one of the body
  std::vector<std::size_t> ends_of_chains;  // numbers of these patches (border_chains.hpp); empty: there are no chains

  /// Saves or restores it; a border of chains may then have other numbers of pieces and patches. Throws StateError.
  void archive(const StateArchive& state);

 private:
  void take_numbers(const std::vector<std::size_t>& new_ends_of_chains, const std::vector<std::size_t>& ends);
};

}  // namespace stillpoint
