// The corners of cells at functions that cells of several ranks have.
//
// A function belongs to the first rank with a cell there. The others send it what their cells have at their corners,
// and it adds these to its own in the order that the cells have in the whole body, in which one process would add them
// too: the sums have the same bits for any number of ranks. Then all ranks are told.
#pragma once

#include <compare>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "parallel/of_all.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

/// The place of an occupied cell in the order of all, whatever ranks they belong to.
struct CellPlace {
  int material = 0, cell = 0;
  auto operator<=>(const CellPlace&) const = default;  // NOLINT(modernize-use-nullptr): of the compiler's own 0
};

template <int Dim>
CellPlace place_of_cell(const MaterialPoints<Dim>& points, std::size_t k) {
  return {points.material_of_cell(k), points.cell[k]};
}
template <int Dim>
std::vector<CellPlace> places_of_cells(const MaterialPoints<Dim>& points) {
  std::vector<CellPlace> places;
  for (std::size_t k = 0; k < points.cells(); ++k) places.push_back(place_of_cell(points, k));
  return places;
}

class SharedCorners {
 public:
  /// A corner of another rank's cell at a function of this one.
  struct Other {
    int function = 0;
    CellPlace of;
  };

  /// function_of_corner: (cells × per cell); places: (cells).
  SharedCorners(const Ranks& ranks, const std::vector<int>& function_of_corner, std::size_t functions,
                const std::vector<CellPlace>& places);

  /// The corners of this rank's cells; behind them come those of others, in this order.
  std::size_t corners() const { return corners_; }
  const std::vector<Other>& others() const { return others_; }
  /// The functions of this rank, in ascending order.
  std::span<const int> functions() const { return of_rank(static_cast<std::size_t>(ranks_.rank())); }
  /// Whether a cell of some rank has the function.
  bool reach(std::size_t function) const { return owner_[function] < ranks_.count(); }
  int owner(int function) const { return owner_[static_cast<std::size_t>(function)]; }
  /// Whether the function is one of another rank, or cells of other ranks have it as well.
  bool is_of_others_too(int function) const { return is_met_[static_cast<std::size_t>(function)] != 0; }
  /// The functions of all ranks, one after the other.
  const std::vector<int>& functions_of_all() const { return functions_; }

  /// Completes values at corners, (corners() + others().size()) × components, by those of the other ranks.
  void exchange(double* values, std::size_t components) const;
  /// Completes values at functions, (functions × components), of which this rank has those of its own. Returns whether
  /// all ranks say that what they give is good.
  bool gather(double* values, std::size_t components, bool is_good = true) const;

 private:
  std::span<const int> of_rank(std::size_t rank) const {
    return std::span(functions_).subspan(begin_[rank], begin_[rank + 1] - begin_[rank]);
  }

  const Ranks& ranks_;
  std::size_t corners_;
  std::vector<int> owner_;                      // its rank; the number of ranks: no cell has it, (functions)
  std::vector<char> is_met_;                    // see is_of_others_too(), (functions)
  std::vector<int> functions_;                  // those of rank 0, of rank 1 …
  std::vector<std::size_t> begin_;              // the first of each rank in functions_, (ranks + 1)
  std::vector<std::vector<std::size_t>> sent_;  // own corners that each rank is sent
  std::vector<std::size_t> received_;           // number of corners from each rank
  std::vector<Other> others_;
  // Work arrays, so that nothing is allocated in an evaluation.
  mutable std::vector<double> packed_, gathered_;
  mutable std::vector<Parcel> to_, from_;
  mutable std::vector<std::size_t> gathered_begin_;
};

}  // namespace stillpoint
