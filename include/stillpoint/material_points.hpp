// Material points of a body: places, masses and volumes, sorted by the cell that they lie in.
#pragma once

#include <stillpoint/grid.hpp>
#include <stillpoint/scene.hpp>

#include <array>
#include <vector>

namespace stillpoint {

/// Structure of arrays; n points. Points of one cell are contiguous.
template <int Dim>
struct MaterialPoints {
  std::array<std::vector<double>, Dim> x;  // places [m], each (n)
  std::vector<double> volume;              // V_p [m³] (cross-section included), (n)
  std::vector<double> mass;                // m_p [kg], (n)
  std::vector<int> cell_begin;             // first point of occupied cell k, and n at its end: (occupied cells + 1)
  std::vector<int> cell;                   // grid number of occupied cell k

  std::size_t size() const { return volume.size(); }
  Point<Dim> place(std::size_t p) const {
    Point<Dim> at;
    for (int d = 0; d < Dim; ++d) at[d] = x[d][p];
    return at;
  }
};

/// What the volumes of a body can integrate, the worst over its cells.
struct QuadratureReport {
  int degree = 0;                 // polynomials up to this power in each coordinate are integrated exactly
  double smallest_share = 1;      // of a cell's length that the body covers, over the cells with material
  int cells_limited_by_sign = 0;  // cells where a higher degree would need a negative volume
};

template <int Dim>
struct PlacedBody {
  MaterialPoints<Dim> points;
  QuadratureReport quadrature;
};

/// Fills the body's box with points cell by cell: in each cell's part of the box, points_per_cell of them along each
/// coordinate (uniform, at Gauss-Legendre places, or seeded random); volumes equal or fitted to moments.
/// density [kg/m³].
template <int Dim>
PlacedBody<Dim> place_body(const BodySpec& body, const Grid<Dim>& grid, double density);

}  // namespace stillpoint
