// The extension of functions whose support meets the body in slivers alone, from a cell further inside.
//
// In every other cell, the polynomial Σ_k u_k N_k|_c of the functions N_k of the host cell c is a combination Σ_e u_e
// N_e of the functions there. Hence with
//
//   u_e = Σ_k W_ek u_k,   Σ_e W_ek N_e = N_k|_c continued,
//
// the functions N_k + Σ_e W_ek N_e reproduce every polynomial that the basis does, are as smooth as it is, and each of
// them has its share of a cell that the body fills [Höllig, Reif and Wipper 2001, weighted extended B-splines]. W is
// the product of one such matrix along each axis.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "space/grid/basis.hpp"
#include "space/grid/cut_cells.hpp"
#include "space/grid/domain_basis.hpp"
#include "space/grid/extended_functions.hpp"

namespace stillpoint {

/// The basis whose local functions belong to a single cell.
template <AxisBasis B>
struct BasisOfOneCell {
  using type = B;
};
template <int Degree>
struct BasisOfOneCell<DomainBSpline<Degree>> {
  using type = BSpline<Degree>;
};

template <AxisBasis Spline, int Dim>
class SliverExtension {
  using Basis = TensorBasis<Spline, Dim>;
  using Sources = std::vector<ExtendedFunctions::Source>;

 public:
  /// Whether a function may follow these sources.
  using MayFollow = std::function<bool(int function, const Sources& sources)>;
  SliverExtension(const Grid<Dim>& grid, const CutCells<Dim>& cut, const MayFollow& may_follow);

  const ExtendedFunctions& functions() const { return functions_; }
  /// The number of cells with outer functions, which meet the body in slivers alone, and of those in which all of these
  /// follow others.
  int slivers() const { return slivers_; }
  int joined() const { return joined_; }

 private:
  template <class Visit>
  void for_functions(int cell, const Visit& visit) const;
  std::map<int, std::vector<int>> cells_of_outer_functions(const CutCells<Dim>& cut) const;
  Sources sources_from_nearest_host(int function, const std::vector<int>& cells, const CutCells<Dim>& cut,
                                    const MayFollow& may_follow) const;
  double distance_of(int function, int cell) const;
  Sources sources_from(int function, int cell, int host) const;

  const Grid<Dim>& grid_;
  std::array<int, Basis::per_cell> offset_;
  ExtendedFunctions functions_;
  int slivers_ = 0, joined_ = 0;
};

}  // namespace stillpoint
