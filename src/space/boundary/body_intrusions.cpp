// Where bodies of a contact lie in each other without feeling it. A piece of a border presses on the facet that was
// opposite to it when the phase began: one that had none, or comes to another part of the other border, meets nothing,
// nor does one that is deep in the other body, where no facet is opposite.
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "space/boundary/body_contact.hpp"
#include "space/boundary/facet_search.hpp"

namespace stillpoint {
namespace {

/// The border of a body of a contact, and which of its pieces press on the other body.
template <Kinematics K>
struct MovedBorder {
  const ContactSurface<K>& surface;
  std::vector<BorderPiece<K>> pieces;
  FacetSearch<K> facets;
  std::vector<char> presses;

  MovedBorder(const ContactSurface<K>& of, const double* u)
      : surface(of), pieces(moved_pieces(of, u)), facets(of.patches(), pieces), presses(pieces.size(), 0) {}

  /// Whether the same side of the body bears a pressure beside piece s, within two cells.
  bool bears_beside(std::size_t s, double cell) const {
    constexpr double along = 0.7, near = 2;  // the cosine between normals; [cells]
    const auto x = pieces[s].place(), n = pieces[s].normal();
    for (std::size_t other = 0; other < pieces.size(); ++other) {
      if (!presses[other]) continue;
      const auto y = pieces[other].place(), m = pieces[other].normal();
      double square = 0, cosine = 0;
      for (std::size_t d = 0; d < x.size(); ++d) square += (y[d] - x[d]) * (y[d] - x[d]), cosine += n[d] * m[d];
      if (cosine > along && std::sqrt(square) < near * cell) return true;
    }
    return false;
  }
};

/// Finds the pieces of a border that lie deepest in another body without feeling it: of all that are beside a place
/// that bears, and of the others. opposite_feels: whether a piece opposite to it feels what is in it.
template <Kinematics K>
void find_deepest(const MovedBorder<K>& border, const MovedBorder<K>& other, bool opposite_feels,
                  std::array<Intrusion, 2>& deepest) {
  constexpr double negligible = 0.02;  // [cells]
  for (const SurfacePatch& patch : border.surface.patches()) {
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      if (border.presses[s]) continue;
      const auto x = border.pieces[s].place();
      const auto facet = other.facets.opposite(x, border.pieces[s].normal());
      if (facet && opposite_feels && other.presses[facet->piece]) continue;
      const double cells = (facet ? -facet->gap : other.facets.depth(x)) / patch.cell;
      // Beside an edge that it has gone past, it is not known on which side of a facet a place is.
      constexpr double known = 0.5;  // [cells]
      if (!(cells > (facet ? negligible : known))) continue;
      deepest[border.bears_beside(s, patch.cell) ? 1 : 0].take(cells, 0, x);
    }
  }
}

}  // namespace

template <Kinematics K>
std::vector<Intrusion> BodyContact<K>::intrusions(const double* u) const {
  std::vector<Intrusion> found;
  for (const Pair* const pair : whole_) {
    MovedBorder<K> first(pair->first, u), second(pair->second, u);
    first.presses = pair->force.finder().closed(u);
    for (std::size_t s = 0; s < first.presses.size(); ++s) {
      if (!first.presses[s]) continue;
      if (const auto facet = second.facets.opposite(first.pieces[s].place(), first.pieces[s].normal()))
        second.presses[facet->piece] = 1;
    }
    std::array<Intrusion, 2> deepest;
    for (std::size_t bears = 0; bears < deepest.size(); ++bears)
      deepest[bears] = {.of = Intrusion::Of::bodies, .rigid = pair->number, .bears = bears != 0};
    find_deepest(first, second, /*opposite_feels=*/false, deepest);
    find_deepest(second, first, /*opposite_feels=*/true, deepest);
    for (Intrusion& one : deepest)
      if (one.cells > 0) found.push_back(std::move(one));
  }
  return found;
}

template std::vector<Intrusion> BodyContact<Kinematics::line>::intrusions(const double*) const;
template std::vector<Intrusion> BodyContact<Kinematics::plane>::intrusions(const double*) const;
template std::vector<Intrusion> BodyContact<Kinematics::axisymmetric>::intrusions(const double*) const;
template std::vector<Intrusion> BodyContact<Kinematics::space>::intrusions(const double*) const;

}  // namespace stillpoint
