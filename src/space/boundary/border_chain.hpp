// A border in the plane as a chain of pieces, that is cut anew as it stretches from phase to phase.
//
// A piece stands for half of the way to the one before it and half of the way to the one after it. Where a border is
// drawn apart, as above the tip of a cone, a piece is put in the middle between two; where it is drawn together, pieces
// are left out. A patch that has become longer than a cell and a half is divided, one that is shorter than 0.4 of a
// cell goes on with the next. The mean of the pieces a new one lies between is its own state.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "space/boundary/border_patches.hpp"

namespace stillpoint {

/// Where a piece of a border that was cut anew comes from: in the middle between two of the pieces before, which may be
/// the same one. patch: theirs.
struct PieceOrigin {
  std::array<std::size_t, 2> piece, patch;
};

/// What pieces have that were cut anew, by what those before had.
template <class Value>
std::vector<Value> of_pieces_cut_anew(const std::vector<Value>& before, const std::vector<PieceOrigin>& origins) {
  std::vector<Value> after;
  for (const PieceOrigin& origin : origins) after.push_back((before[origin.piece[0]] + before[origin.piece[1]]) / 2);
  return after;
}

template <Kinematics K>
class BorderChain {
 public:
  /// A piece on its way into a border that was cut anew.
  struct Link {
    BorderPiece<K> piece;
    double length;  // undeformed [m]
    PieceOrigin origin;
  };
  struct LinkedPatch {
    double cell, depth;
    std::vector<Link> links;
  };

  /// closed: the last piece comes before the first. longest: that two pieces may be apart, as a share of a cell.
  BorderChain(bool closed, const std::array<FaceEnd, 2>& ends, double longest)
      : closed_(closed), ends_(ends), longest_(longest) {}

  /// Cuts anew where that is due, and measures all pieces. False if none came or went.
  bool cut(std::vector<LinkedPatch>& patches) const;

 private:
  using Links = std::vector<Link*>;

  static Links links_of(std::vector<LinkedPatch>& patches);
  Point<2> before(const Links& links, std::size_t i) const;
  Point<2> after(const Links& links, std::size_t i) const;
  bool leave_out(std::vector<LinkedPatch>& patches) const;
  bool put_between(std::vector<LinkedPatch>& patches) const;
  void measure(std::vector<LinkedPatch>& patches) const;
  void divide_and_join(std::vector<LinkedPatch>& patches) const;

  bool closed_;
  std::array<FaceEnd, 2> ends_;
  double longest_;
};

}  // namespace stillpoint
