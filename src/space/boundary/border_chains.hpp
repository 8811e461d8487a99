// The chains of all borders of a surface in the plane, whose pieces material points carry.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/state_archive.hpp>

#include <vector>

#include "space/boundary/border_chain.hpp"

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
class BorderChains {
 public:
  using Pieces = std::vector<BorderPiece<K>>;
  using Patches = std::vector<SurfacePatch>;

  bool empty() const { return chains_.empty(); }
  /// The chains of a body, of which these are the patches; first: the number of the first one on the surface.
  void add(const BodySpec& body, const std::vector<BorderPatch<K>>& patches, std::size_t first);
  /// Cuts all of them anew where that is due. Where the pieces come from, (pieces); empty if they are what they were.
  std::vector<PieceOrigin> cut_anew(Pieces& pieces, Patches& patches);
  /// Saves or restores how many pieces and patches there are, with what of them does not change. Throws StateError.
  void archive(const StateArchive& state, Pieces& pieces, Patches& patches);

 private:
  struct Chain {
    std::size_t begin, end;  // its patches
    BorderChain<K> chain;
  };
  using LinkedPatches = std::vector<typename BorderChain<K>::LinkedPatch>;

  static LinkedPatches linked(const Chain& chain, const Pieces& pieces, const Patches& patches);
  void take_numbers(const std::vector<std::size_t>& ends_of_chains, const std::vector<std::size_t>& ends,
                    Patches& patches);

  std::vector<Chain> chains_;
};

}  // namespace stillpoint
