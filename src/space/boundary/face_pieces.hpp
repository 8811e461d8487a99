// Cuts a part of a face of a box into pieces, several in each cell.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "scene/support_kind.hpp"
#include "space/boundary/face_rule.hpp"
#include "space/grid/grid.hpp"

namespace stillpoint {

/// Calls visit(x, size, share) for each piece: its position, its length in the plane or area in space [m or m²], and
/// its share of the cell's face. The face lies across axis `normal` at `at`; rule_along gives the quadrature rule of
/// the body along each of the face's axes.
template <int Dim, class RuleAlong, class Visit>
void for_face_pieces(const Grid<Dim>& grid, std::size_t normal, double at, const std::vector<FaceInterval>& part,
                     const RuleAlong& rule_along, const Visit& visit) {
  struct Piece {
    double x, length, share;
  };
  const auto pieces_along = [&](const FaceInterval& interval) {
    std::vector<Piece> pieces;
    const auto& nodes = grid.axes[interval.along].nodes;
    const std::vector<FacePoint> rule = rule_along(interval.along);
    for (std::size_t c = 0; c + 1 < nodes.size(); ++c) {
      const double begin = std::max(interval.from, nodes[c]), end = std::min(interval.to, nodes[c + 1]);
      if (!(end > begin)) continue;
      for (const auto& [xi, weight] : rule) {
        const double length = (end - begin) / 2 * weight;
        pieces.push_back({(begin + end) / 2 + (end - begin) / 2 * xi, length, length / (nodes[c + 1] - nodes[c])});
      }
    }
    return pieces;
  };
  static_assert(Dim == 2 || Dim == 3);
  const std::vector<Piece> first = pieces_along(part.front());
  const std::vector<Piece> second = Dim == 2 ? std::vector<Piece>{{0, 1, 1}} : pieces_along(part.back());
  for (const Piece& b : second) {
    for (const Piece& a : first) {
      Point<Dim> x;
      x[normal] = at;
      x[part.front().along] = a.x;
      if constexpr (Dim == 3) x[part.back().along] = b.x;
      visit(x, a.length * b.length, a.share * b.share);
    }
  }
}

}  // namespace stillpoint
