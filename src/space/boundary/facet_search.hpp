// The facet of a border that is opposite to a position of another border.
//
// A facet is a piece of the border, with its tangent plane. Opposite is the piece nearest to the position, if it faces
// the other border there and if the foot of the position on its plane lies in it, or in a border that goes on beyond
// it: past an edge there is nothing to touch.
#pragma once

#include <optional>
#include <vector>

#include "space/boundary/contact_surface.hpp"

namespace stillpoint {

template <int Dim>
struct OppositeFacet {
  std::size_t piece;
  double gap;         // of the position to the plane of the piece [m]
  Point<Dim> foot;    // of the position on that plane
  Point<Dim> normal;  // out of the body
};

template <Kinematics K>
class FacetSearch {
  static constexpr int dim = dimensions(K);

 public:
  /// The surface, as it is when a phase begins, must outlive this object.
  explicit FacetSearch(const ContactSurface<K>& surface);

  /// The facet opposite to x, on a border with this normal; empty if there is none.
  std::optional<OppositeFacet<dim>> opposite(const Point<dim>& x, const Point<dim>& normal) const;

 private:
  struct Entry {
    double along;  // coordinate along axis_ [m]
    std::size_t piece;
  };

  std::size_t nearest(const Point<dim>& x) const;
  bool goes_on(std::size_t piece, const Point<dim>& towards) const;
  template <class Visit>
  void visit_near(double along, const Visit& visit) const;

  const ContactSurface<K>& surface_;
  std::size_t axis_ = 0;       // along which the surface is longest
  std::vector<Entry> sorted_;  // by `along`
};

}  // namespace stillpoint
