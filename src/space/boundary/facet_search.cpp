#include "space/boundary/facet_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stillpoint {
namespace {

template <std::size_t Dim>
double dot(const std::array<double, Dim>& a, const std::array<double, Dim>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < Dim; ++d) sum += a[d] * b[d];
  return sum;
}
template <std::size_t Dim>
std::array<double, Dim> difference(const std::array<double, Dim>& a, const std::array<double, Dim>& b) {
  std::array<double, Dim> c;
  for (std::size_t d = 0; d < Dim; ++d) c[d] = a[d] - b[d];
  return c;
}

/// The extent of a piece along the border [m].
template <Kinematics K>
double extent(const BorderPiece<K>& piece, double depth) {
  if constexpr (dimensions(K) == 3) return std::sqrt(piece.size());
  if (K == Kinematics::axisymmetric) return piece.size() / (2 * std::numbers::pi * piece.place()[0]);
  return piece.size() / depth;
}

}  // namespace

template <Kinematics K>
std::vector<BorderPiece<K>> moved_pieces(const ContactSurface<K>& surface, const double* u) {
  std::vector<BorderPiece<K>> pieces;
  for (std::size_t s = 0; s < surface.size(); ++s) {
    pieces.push_back(surface.piece(s));
    if (u) pieces.back().move(u);
  }
  return pieces;
}

template <Kinematics K>
FacetSearch<K>::FacetSearch(const ContactSurface<K>& surface) : facets_(surface.size()) {
  list(surface.patches(), [&](std::size_t s) -> const BorderPiece<K>& { return surface.piece(s); });
}

template <Kinematics K>
FacetSearch<K>::FacetSearch(std::span<const SurfacePatch> patches, const std::vector<BorderPiece<K>>& pieces)
    : facets_(pieces.size()) {
  list(patches, [&](std::size_t s) -> const BorderPiece<K>& { return pieces[s]; });
}

template <Kinematics K>
template <class PieceAt>
void FacetSearch<K>::list(std::span<const SurfacePatch> patches, const PieceAt& piece_at) {
  least_.fill(std::numeric_limits<double>::infinity());
  most_.fill(-std::numeric_limits<double>::infinity());
  for (const SurfacePatch& patch : patches) {
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      const BorderPiece<K>& piece = piece_at(s);
      facets_[s] = {piece.place(), piece.normal(), extent(piece, patch.depth), patch.cell};
      sorted_.push_back({0, s});
      for (std::size_t d = 0; d < dim; ++d) {
        least_[d] = std::min(least_[d], facets_[s].place[d]);
        most_[d] = std::max(most_[d], facets_[s].place[d]);
      }
    }
  }
  for (std::size_t d = 1; d < dim; ++d)
    if (most_[d] - least_[d] > most_[axis_] - least_[axis_]) axis_ = d;
  for (Entry& entry : sorted_) entry.along = facets_[entry.piece].place[axis_];
  std::ranges::stable_sort(sorted_, {}, &Entry::along);
}

// Calls visit(piece, distance along the axis) from `along` outwards, to both sides, until it returns false for a side.
template <Kinematics K>
template <class Visit>
void FacetSearch<K>::visit_near(double along, const Visit& visit) const {
  const auto middle = std::ranges::lower_bound(sorted_, along, {}, &Entry::along);
  for (auto up = middle; up != sorted_.end() && visit(up->piece, up->along - along); ++up) {
  }
  for (auto down = middle; down != sorted_.begin();)
    if (--down; !visit(down->piece, along - down->along)) break;
}

// Of those for which counts(piece) holds; of equally near ones the one with the lowest number. The number of pieces:
// there is none.
template <Kinematics K>
template <class Counts>
std::size_t FacetSearch<K>::nearest(const Point<dim>& x, const Counts& counts) const {
  std::size_t found = facets_.size();
  double least = std::numeric_limits<double>::infinity();
  visit_near(x[axis_], [&](std::size_t s, double away) {
    if (away * away > least) return false;
    if (!counts(s)) return true;
    const Point<dim> offset = difference(facets_[s].place, x);
    const double square = dot(offset, offset);
    if (square < least || (square == least && s < found)) least = square, found = s;
    return true;
  });
  return found;
}

// Whether another piece lies next to this one, in a direction along it, on a border that goes on smoothly.
template <Kinematics K>
bool FacetSearch<K>::goes_on(std::size_t piece, const Point<dim>& towards) const {
  constexpr double smooth = 0.7;  // the cosine between the normals
  const Facet& here = facets_[piece];
  const double near = 2.5 * here.extent, size = std::sqrt(dot(towards, towards));
  bool found = false;
  visit_near(here.place[axis_], [&](std::size_t s, double away) {
    if (away > near || found) return false;
    const Point<dim> offset = difference(facets_[s].place, here.place);
    const double distance = std::sqrt(dot(offset, offset));
    found = s != piece && distance <= near && dot(offset, towards) > 0.5 * distance * size &&
            dot(facets_[s].normal, here.normal) > smooth;
    return true;
  });
  return found;
}

template <Kinematics K>
auto FacetSearch<K>::opposite(const Point<dim>& x, const Point<dim>& normal) const
    -> std::optional<OppositeFacet<dim>> {
  if (sorted_.empty()) return std::nullopt;
  const auto depth_below = [&](std::size_t s) { return -dot(difference(x, facets_[s].place), facets_[s].normal); };
  constexpr double against = -0.5;  // the cosine between normals: the side of a body does not bear what lies on its top
  const auto faces = [&](std::size_t s) { return dot(facets_[s].normal, normal) < against; };
  std::size_t q = nearest(x, [](std::size_t) { return true; });
  if (!faces(q)) {
    if (!(depth_below(q) > 0)) return std::nullopt;
    q = nearest(x, faces);
    if (q == facets_.size() || depth_below(q) > facets_[q].cell) return std::nullopt;
  }
  const Facet& facet = facets_[q];
  const double gap = -depth_below(q);
  const Point<dim> offset = difference(x, facet.place);
  Point<dim> aside;
  for (std::size_t d = 0; d < dim; ++d) aside[d] = offset[d] - gap * facet.normal[d];
  constexpr double half = 0.6;  // of the extent: Gauss points are not in the middle of what they stand for
  if (std::sqrt(dot(aside, aside)) > half * facet.extent && !goes_on(q, aside)) return std::nullopt;
  OppositeFacet<dim> opposite{q, gap, facet.place, facet.normal};
  for (std::size_t d = 0; d < dim; ++d) opposite.foot[d] += aside[d];
  return opposite;
}

template <Kinematics K>
double FacetSearch<K>::depth(const Point<dim>& x) const {
  if (!is_in_box(x)) return -std::numeric_limits<double>::infinity();
  const Facet& facet = facets_[nearest(x, [](std::size_t) { return true; })];
  const Point<dim> offset = difference(x, facet.place);
  const double below = -dot(offset, facet.normal), distance = std::sqrt(dot(offset, offset));
  if (distance <= facet.extent) return below;
  return holds(x) ? std::max(std::abs(below), distance - facet.extent) : -distance;
}

// Around an axis the border goes on at its other side. No place is in the box of no border.
template <Kinematics K>
bool FacetSearch<K>::is_in_box(const Point<dim>& x) const {
  const double reaches_to = K == Kinematics::axisymmetric ? -most_[0] : least_[0];
  for (std::size_t d = 0; d < dim; ++d)
    if (x[d] < (d == 0 ? reaches_to : least_[d]) || x[d] > most_[d]) return false;
  return true;
}

template <Kinematics K>
bool FacetSearch<K>::holds(const Point<dim>& x) const {
  double winding = 0;
  const auto add = [&](const Point<dim>& place, const Point<dim>& normal, double area) {
    const Point<dim> r = difference(place, x);
    winding += area * dot(normal, r) / std::pow(dot(r, r), 0.5 * dim);
  };
  for (const Entry& entry : sorted_) {
    const Facet& facet = facets_[entry.piece];
    const double area = std::pow(facet.extent, dim - 1);
    add(facet.place, facet.normal, area);
    if constexpr (K == Kinematics::axisymmetric)
      add({-facet.place[0], facet.place[1]}, {-facet.normal[0], facet.normal[1]}, area);
  }
  return winding > (dim == 3 ? 2 : 1) * std::numbers::pi;
}

template std::vector<BorderPiece<Kinematics::line>> moved_pieces(const ContactSurface<Kinematics::line>&,
                                                                 const double*);
template std::vector<BorderPiece<Kinematics::plane>> moved_pieces(const ContactSurface<Kinematics::plane>&,
                                                                  const double*);
template std::vector<BorderPiece<Kinematics::axisymmetric>> moved_pieces(
    const ContactSurface<Kinematics::axisymmetric>&, const double*);
template std::vector<BorderPiece<Kinematics::space>> moved_pieces(const ContactSurface<Kinematics::space>&,
                                                                  const double*);
template class FacetSearch<Kinematics::line>;
template class FacetSearch<Kinematics::plane>;
template class FacetSearch<Kinematics::axisymmetric>;
template class FacetSearch<Kinematics::space>;

}  // namespace stillpoint
