// Material points of a body: positions, masses and volumes, sorted by the cell that they lie in.
#pragma once

#include <stillpoint/problem.hpp>

#include <array>
#include <optional>
#include <vector>

#include "space/grid/cut_cells.hpp"
#include "space/grid/grid.hpp"
#include "space/points/cut_cell_rule.hpp"

namespace stillpoint {

/// Structure of arrays; n points, sorted by material and then by cell. A cell that holds points of two materials is
/// listed once for each.
template <int Dim>
struct MaterialPoints {
  std::array<std::vector<double>, Dim> x;  // positions [m], each (n)
  std::vector<double> volume;              // V_p [m³] (cross-section included), (n)
  std::vector<double> mass;                // m_p [kg], (n)
  std::vector<int> cell_begin;             // first point of occupied cell k, and n at its end: (occupied cells + 1)
  std::vector<int> cell;                   // grid number of occupied cell k
  std::vector<int> material_begin;         // first point of each material, and n at the end
  std::vector<int> number;                 // of each point when the body was placed; of parts of one the same, (n)
  // Only in a body that moves on from phase to phase:
  std::array<std::vector<double>, Dim> v;             // velocity [m/s], each (n)
  std::array<std::vector<double>, Dim * Dim> B_apic;  // Σ_i N_ip v_i ⊗ (x_i − x_p) [m²/s], each (n); APIC alone
  // Only where the points stand for domains, see point_domains.hpp:
  std::array<std::vector<double>, (Dim << Dim)> corner;  // c along d at [Dim c + d] [m], each (n)
  std::array<std::vector<double>, Dim> half;             // undeformed half sides [m], each (n)
  std::array<std::vector<double>, Dim> rest;             // undeformed positions [m], each (n)
  Point<Dim> widest{};                                   // a domain may be along each axis: the narrowest cell [m]

  std::size_t size() const { return volume.size(); }
  bool has_domains() const { return !corner[0].empty(); }
  std::size_t cells() const { return cell.size(); }
  /// Points of occupied cell k.
  std::size_t begin(std::size_t k) const { return static_cast<std::size_t>(cell_begin[k]); }
  std::size_t end(std::size_t k) const { return static_cast<std::size_t>(cell_begin[k + 1]); }
  std::size_t materials() const { return material_begin.size() - 1; }
  /// Number of the material of occupied cell k, by name.
  int material_of_cell(std::size_t k) const {
    int m = 0;
    while (material_begin[static_cast<std::size_t>(m) + 1] <= cell_begin[k]) ++m;
    return m;
  }
  Point<Dim> position(std::size_t p) const {
    Point<Dim> at;
    for (int d = 0; d < Dim; ++d) at[d] = x[d][p];
    return at;
  }
};

/// What the volumes of bodies can integrate, the worst over their cells.
struct QuadratureReport {
  /// Polynomials up to this power in each coordinate are integrated exactly over areas, where a cell has its whole
  /// pattern of points; empty: no cell has one, or it is not known, as of points from a file.
  std::optional<int> degree;
  bool equal_volumes = false;  // whether the body that has this degree takes equal volumes
  /// Cells that the border of a polygon or a solid cuts, border_cells[d] of them such that polynomials up to total
  /// degree d are integrated exactly over what is inside.
  std::array<int, highest_cut_cell_degree + 1> border_cells{};
  double smallest_share = 1;      // of a cell's length that the body covers, over the cells with material
  int cells_limited_by_sign = 0;  // cells in which a higher degree would need a negative volume
  // Cells that the body hardly reaches, with functions that reach it nowhere else, and those of them in which these
  // follow others.
  int slivers = 0, joined = 0;

  void add(const QuadratureReport& other);
  /// Those that integrate less than a total degree, at most highest_cut_cell_degree + 1.
  int border_cells_below(int needed) const;
};

template <int Dim>
struct PlacedBody {
  MaterialPoints<Dim> points;
  QuadratureReport quadrature;
  CellShares covered;  // by the body; empty: not known
};

/// The material points of a body, cell by cell.
/// - A box: in each cell's part of it, points_per_cell of them along each coordinate (uniform, at Gauss-Legendre
///   positions, seeded random, jittered), with volumes equal or fitted to moments.
/// - A polygon: cells that lie inside are filled in the same way. A cell that its border cuts keeps those of the cell's
///   points that lie inside, or else has one at the centroid of the part inside; their volumes share its area equally
///   or are fitted to its moments. With Gauss points and fitted volumes it has Gauss points of the part inside, no more
///   than a whole cell has. Parts below 1e-6 of a cell are left out.
/// - A solid in space: likewise, by the part of each cell in the solid and in the box of the body.
/// - A file: its points with their volumes, in the file's order within a cell. Throws SceneError if it is wrong.
/// A volume is an area times the thickness, in an axisymmetric body times 2π r, all the way round. density [kg/m³].
/// domains: whether points stand for domains, which uniform ones in a box have side by side; with equal volumes, which
/// integrate whatever is interpolated over them.
template <int Dim>
PlacedBody<Dim> place_body(const BodySpec& body, const Grid<Dim>& grid, double density, StressState state,
                           bool domains = false);

}  // namespace stillpoint
