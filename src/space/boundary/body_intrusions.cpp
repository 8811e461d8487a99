// Where bodies of a contact lie in each other without feeling it. A piece of a border presses on the facet that was
// opposite to it when the phase began: one that had none, or comes to another part of the other border, meets nothing.
#include <algorithm>

#include "space/boundary/body_contact.hpp"
#include "space/boundary/facet_search.hpp"

namespace stillpoint {

template <Kinematics K>
std::vector<Intrusion> BodyContact<K>::intrusions(const double* u) const {
  std::vector<Intrusion> found;
  for (const Pair* const pair : whole_) {
    const std::vector<char> closed = pair->force.finder().closed(u);
    const std::vector<BorderPiece<K>> first = moved_pieces(pair->first, u), second = moved_pieces(pair->second, u);
    const FacetSearch<K> of_first(pair->first.patches(), first), of_second(pair->second.patches(), second);
    Intrusion deepest{.of = Intrusion::Of::bodies, .rigid = pair->number};
    deepest.bears = std::ranges::count(closed, 1) > 0;
    // What a piece that is closed lies in, it feels, and so does what is opposite to it.
    const auto look = [&](const ContactSurface<K>& surface, const std::vector<BorderPiece<K>>& pieces,
                          const FacetSearch<K>& other, const auto& feels) {
      for (const SurfacePatch& patch : surface.patches()) {
        for (std::size_t s = patch.begin; s < patch.end; ++s) {
          const auto facet = other.opposite(pieces[s].place(), pieces[s].normal());
          if (!facet || feels(s, *facet)) continue;
          const double cells = -facet->gap / patch.cell;
          if (!(cells > deepest.cells)) continue;
          deepest.cells = cells;
          const Point<dim> x = pieces[s].place();
          deepest.at.assign(x.begin(), x.end());
        }
      }
    };
    look(pair->first, first, of_second, [&](std::size_t s, const auto&) { return closed[s] != 0; });
    look(pair->second, second, of_first, [&](std::size_t, const auto& facet) { return closed[facet.piece] != 0; });
    if (deepest.cells > 0) found.push_back(std::move(deepest));
  }
  return found;
}

template std::vector<Intrusion> BodyContact<Kinematics::line>::intrusions(const double*) const;
template std::vector<Intrusion> BodyContact<Kinematics::plane>::intrusions(const double*) const;
template std::vector<Intrusion> BodyContact<Kinematics::axisymmetric>::intrusions(const double*) const;
template std::vector<Intrusion> BodyContact<Kinematics::space>::intrusions(const double*) const;

}  // namespace stillpoint
