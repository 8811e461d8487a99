// The chains of all borders of a surface in the plane, whose pieces material points carry.
#pragma once

#include <stillpoint/problem.hpp>

#include <vector>

#include "space/boundary/border_chain.hpp"
#include "space/boundary/border_of_body.hpp"

namespace stillpoint {

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
  /// Where the chains of the patches first … end − 1 end, counted from the first one.
  std::vector<std::size_t> ends(std::size_t first, std::size_t end) const;
  /// Lets the chains of all patches end elsewhere, (chains).
  void take_ends(const std::vector<std::size_t>& ends);

 private:
  struct Chain {
    std::size_t begin, end;  // its patches
    BorderChain<K> chain;
  };
  using LinkedPatches = std::vector<typename BorderChain<K>::LinkedPatch>;

  static LinkedPatches linked(const Chain& chain, const Pieces& pieces, const Patches& patches);

  std::vector<Chain> chains_;
};

}  // namespace stillpoint
