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
double extent(const ContactSurface<K>& surface, std::size_t s) {
  if constexpr (dimensions(K) == 3) return std::sqrt(surface.area(s));
  if (K == Kinematics::axisymmetric) return surface.area(s) / (2 * std::numbers::pi * surface.start(s)[0]);
  return surface.area(s) / surface.patches().front().depth;
}

}  // namespace

template <Kinematics K>
FacetSearch<K>::FacetSearch(const ContactSurface<K>& surface) : surface_(surface) {
  double longest = -1;
  for (std::size_t d = 0; d < dim; ++d) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t s = 0; s < surface.size(); ++s) {
      least = std::min(least, surface.start(s)[d]);
      most = std::max(most, surface.start(s)[d]);
    }
    if (most - least > longest) longest = most - least, axis_ = d;
  }
  for (std::size_t s = 0; s < surface.size(); ++s) sorted_.push_back({surface.start(s)[axis_], s});
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

// Of equally near pieces the one with the lowest number.
template <Kinematics K>
std::size_t FacetSearch<K>::nearest(const Point<dim>& x) const {
  std::size_t found = surface_.size();
  double least = std::numeric_limits<double>::infinity();
  visit_near(x[axis_], [&](std::size_t s, double away) {
    if (away * away > least) return false;
    const Point<dim> offset = difference(surface_.start(s), x);
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
  const double length = extent(surface_, piece), near = 2.5 * length, size = std::sqrt(dot(towards, towards));
  bool found = false;
  visit_near(surface_.start(piece)[axis_], [&](std::size_t s, double away) {
    if (away > near || found) return false;
    const Point<dim> offset = difference(surface_.start(s), surface_.start(piece));
    const double distance = std::sqrt(dot(offset, offset));
    found = s != piece && distance <= near && dot(offset, towards) > 0.5 * distance * size &&
            dot(surface_.normal(s), surface_.normal(piece)) > smooth;
    return true;
  });
  return found;
}

template <Kinematics K>
auto FacetSearch<K>::opposite(const Point<dim>& x, const Point<dim>& normal) const
    -> std::optional<OppositeFacet<dim>> {
  if (sorted_.empty()) return std::nullopt;
  const std::size_t q = nearest(x);
  const Point<dim> n = surface_.normal(q), offset = difference(x, surface_.start(q));
  constexpr double against = -0.5;  // the cosine between normals: the side of a body does not bear what lies on its top
  if (!(dot(n, normal) < against)) return std::nullopt;
  const double gap = dot(offset, n);
  Point<dim> aside;
  for (std::size_t d = 0; d < dim; ++d) aside[d] = offset[d] - gap * n[d];
  constexpr double half = 0.6;  // of the extent: Gauss points are not in the middle of what they stand for
  if (std::sqrt(dot(aside, aside)) > half * extent(surface_, q) && !goes_on(q, aside)) return std::nullopt;
  OppositeFacet<dim> facet{q, gap, surface_.start(q), n};
  for (std::size_t d = 0; d < dim; ++d) facet.foot[d] += aside[d];
  return facet;
}

template class FacetSearch<Kinematics::line>;
template class FacetSearch<Kinematics::plane>;
template class FacetSearch<Kinematics::axisymmetric>;
template class FacetSearch<Kinematics::space>;

}  // namespace stillpoint
