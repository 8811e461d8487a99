// The material points of a body: positions, masses and volumes, sorted by cell.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "space/grid/cut_cells.hpp"
#include "space/grid/grid.hpp"
#include "space/points/cut_cell_rule.hpp"

namespace stillpoint {

/// Material points as a structure of arrays; n points, sorted by material and field of motion, and then by cell. A cell
/// that holds points of two materials, or of two fields, is listed once for each. A material of bodies in two fields
/// counts as two.
template <int Dim>
struct MaterialPoints {
  std::array<std::vector<double>, Dim> x;  // positions [m], each (n)
  std::vector<double> volume;              // V_p [m³] (cross-section included), (n)
  std::vector<double> mass;                // m_p [kg], (n)
  std::vector<int> cell_begin;             // first point of occupied cell k, and n at its end: (occupied cells + 1)
  std::vector<int> cell;                   // grid number of occupied cell k
  std::vector<int> material_begin;         // first point of each material, and n at the end
  std::vector<int> field_of_material;      // empty if all are in one field
  std::vector<int> field_of_body;          // of each [[body]], likewise
  std::vector<int> number;                 // number of each point when the body was placed; all parts of a point have
                                           // its number, (n)
  // Only in a body that moves on from phase to phase:
  std::array<std::vector<double>, Dim> v;             // velocity [m/s], each (n)
  std::array<std::vector<double>, Dim * Dim> B_apic;  // Σ_i N_ip v_i ⊗ (x_i − x_p) [m²/s], each (n); APIC alone
  // Only where the points represent domains, see point_domains.hpp:
  std::array<std::vector<double>, (Dim << Dim)> corner;  // coordinate d of corner c at [Dim c + d] [m], each (n)
  std::array<std::vector<double>, Dim> half;             // undeformed half sides [m], each (n)
  std::array<std::vector<double>, Dim> rest;             // undeformed positions [m], each (n)
  Point<Dim> widest{};                                   // largest width of a domain along each even axis: the
                                                         // narrowest cell [m]

  std::size_t size() const { return volume.size(); }
  bool has_domains() const { return !corner[0].empty(); }
  std::size_t cells() const { return cell.size(); }
  /// The points of occupied cell k are begin(k) … end(k) − 1.
  std::size_t begin(std::size_t k) const { return static_cast<std::size_t>(cell_begin[k]); }
  std::size_t end(std::size_t k) const { return static_cast<std::size_t>(cell_begin[k + 1]); }
  std::size_t materials() const { return material_begin.size() - 1; }
  /// The index of the material of occupied cell k, in the order of the names.
  int material_of_cell(std::size_t k) const {
    int m = 0;
    while (material_begin[static_cast<std::size_t>(m) + 1] <= cell_begin[k]) ++m;
    return m;
  }
  /// The field of motion that moves the points of occupied cell k, see motion_fields.hpp.
  int field_of_cell(std::size_t k) const {
    return field_of_material.empty() ? 0 : field_of_material[static_cast<std::size_t>(material_of_cell(k))];
  }
  /// The field of motion that moves a [[body]], by its number.
  int field_of(std::size_t body) const { return field_of_body.empty() ? 0 : field_of_body[body]; }
  Point<Dim> position(std::size_t p) const {
    Point<Dim> at;
    for (int d = 0; d < Dim; ++d) at[d] = x[d][p];
    return at;
  }
};

/// The accuracy of quadrature by the volumes of bodies, the worst over their cells.
struct QuadratureReport {
  /// The power in each coordinate up to which polynomials are integrated exactly over areas, in cells with their whole
  /// pattern of points; empty: no cell has one, or it is not known, as for points from a file.
  std::optional<int> degree;
  bool equal_volumes = false;  // whether the body with this degree has equal volumes
  /// The numbers of cells that the border of a polygon or a solid cuts: border_cells[d] is that of cells in which
  /// polynomials up to total degree d are integrated exactly over the part inside.
  std::array<int, highest_cut_cell_degree + 1> border_cells{};
  double smallest_share = 1;      // smallest share of a cell's length that the body covers, over the cells with
                                  // material
  int cells_limited_by_sign = 0;  // cells in which a higher degree would need a negative volume
  // The number of sliver cells, with functions that reach the body only in slivers, and of those in which all of these
  // follow others.
  int slivers = 0, joined = 0;

  void add(const QuadratureReport& other);
  /// The number of cut cells that integrate less than a total degree, at most highest_cut_cell_degree + 1.
  int border_cells_below(int needed) const;
};

template <int Dim>
struct PlacedBody {
  MaterialPoints<Dim> points;
  QuadratureReport quadrature;
  CellShares covered;  // cells covered by the body; empty: not known
};

/// Makes the material points of a body, cell by cell.
/// - A box: in each cell's part of it, points_per_cell of them along each coordinate (uniform, at Gauss–Legendre
///   positions, seeded random, jittered), with volumes equal or fitted to moments.
/// - A polygon: cells that lie inside are filled in the same way. A cell that its border cuts keeps those of the cell's
///   points that lie inside, or else has one at the centroid of the part inside; their volumes share its area equally
///   or are fitted to its moments. With Gauss points and fitted volumes it has Gauss points of the part inside, no more
///   than a whole cell has. Parts below 1e-6 of a cell are left out.
/// - A solid in space: likewise, by the part of each cell in the solid and in the box of the body.
/// - A file: its points with their volumes, in the file's order within a cell. Throws SceneError if it is wrong.
/// A volume is an area times the thickness, in an axisymmetric body times 2π r, the full circumference. density
/// [kg/m³]. domains: whether points represent domains, which are adjacent boxes for uniform points in a box; they have
/// equal volumes, which integrate exactly whatever is interpolated over them.
template <int Dim>
PlacedBody<Dim> place_body(const BodySpec& body, const Grid<Dim>& grid, double density, StressState state,
                           bool domains = false);

/// The body of the point with a number; first_number: the number of the first point of each body, and that of all
/// points.
inline std::size_t body_of(const std::vector<int>& first_number, int number) {
  return static_cast<std::size_t>(std::ranges::upper_bound(first_number, number) - first_number.begin()) - 1;
}

/// Calls visit(occupied cell, point, number of the point) for all points.
template <int Dim, class Visit>
void for_points(const MaterialPoints<Dim>& points, const Visit& visit) {
  for (std::size_t k = 0; k < points.cells(); ++k) {
    for (std::size_t p = points.begin(k); p < points.end(k); ++p)
      visit(k, p, static_cast<std::size_t>(points.number[p]));
  }
}

}  // namespace stillpoint
