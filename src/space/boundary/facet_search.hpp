// The facet of a border that is opposite to a position of another border.
//
// A facet is a piece of the border, with its tangent plane. Opposite is the piece nearest to the position, if it faces
// the other border there and if the foot of the position on its plane lies in it, or in a border that goes on beyond
// it: past an edge there is nothing to touch. In a body that is thin, or beside a corner, what lies past a face is
// nearer to another one: then it is the nearest of those that face the other border, if that is no more than a cell
// away.
#pragma once

#include <array>
#include <optional>
#include <span>
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
  /// A surface as it is when a phase begins.
  explicit FacetSearch(const ContactSurface<K>& surface);
  /// Patches of a surface whose pieces, of all of it, have moved.
  FacetSearch(std::span<const SurfacePatch> patches, const std::vector<BorderPiece<K>>& pieces);

  /// The facet opposite to x, on a border with this normal; empty if there is none.
  std::optional<OppositeFacet<dim>> opposite(const Point<dim>& x, const Point<dim>& normal) const;
  /// How far x is from the border [m]; negative outside the body, far outside −∞. Of an x further away than a piece is
  /// long it is known by the whole border, which no facet beside a corner can belie: x is inside if the border winds
  /// around it,
  ///
  ///   Σ_s A_s n_s·r_s/|r_s|^d = 2 π, or 4 π in space, and 0 outside,   r_s = x_s − x.
  double depth(const Point<dim>& x) const;
  /// The box that holds all of them, from and to.
  std::array<Point<dim>, 2> box() const { return {least_, most_}; }

 private:
  struct Facet {
    Point<dim> place, normal;
    double extent, cell;  // along the border; the shortest side of its cell [m]
  };
  struct Entry {
    double along;  // coordinate along axis_ [m]
    std::size_t piece;
  };

  bool is_in_box(const Point<dim>& x) const;
  bool holds(const Point<dim>& x) const;
  template <class PieceAt>
  void list(std::span<const SurfacePatch> patches, const PieceAt& piece_at);
  template <class Counts>
  std::size_t nearest(const Point<dim>& x, const Counts& counts) const;
  bool goes_on(std::size_t piece, const Point<dim>& towards) const;
  template <class Visit>
  void visit_near(double along, const Visit& visit) const;

  std::vector<Facet> facets_;  // (pieces)
  Point<dim> least_, most_;    // the box of their positions
  std::size_t axis_ = 0;       // along which the surface is longest
  std::vector<Entry> sorted_;  // of the patches, by `along`
};

/// The pieces of a surface where u takes them; null: where the phase begins.
template <Kinematics K>
std::vector<BorderPiece<K>> moved_pieces(const ContactSurface<K>& surface, const double* u);

}  // namespace stillpoint
