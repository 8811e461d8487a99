// The frozen weights of a phase behind an interface without the basis as a template parameter: for work done once a
// phase, or at few points. Kernels take the weights from PointWeights.
#pragma once

#include <stillpoint/types.hpp>

#include <array>
#include <cstddef>
#include <vector>

#include "space/grid/grid_functions.hpp"

namespace stillpoint {

template <int Dim>
class PointFunctions {
 public:
  virtual ~PointFunctions() = default;

  static constexpr int most_per_cell = most_functions_of_cell(Dim);
  using Numbers = std::array<double, most_per_cell>;
  using Slopes = std::array<double, Dim * most_per_cell>;

  /// The position of occupied cell k in the grid.
  const std::array<int, Dim>& cell_at(std::size_t k) const { return at_[k]; }
  /// The same of all occupied cells.
  const std::vector<std::array<int, Dim>>& cells_at() const { return at_; }
  /// Grid number of local function a in occupied cell k: that of its first function, and on from it.
  int function(std::size_t k, int a) const { return first_[k] + offset_[a]; }
  int first_function(std::size_t k) const { return first_[k]; }
  int offset(int a) const { return offset_[a]; }
  int functions_of_cell() const { return functions_of_cell_; }

  /// Sets the values N_a of point p in occupied cell k; entries from functions_of_cell() on are left as they are.
  virtual void values(std::size_t k, std::size_t p, Numbers& N) const = 0;
  /// Sets the gradients of the functions at point p, ∂N_a/∂x_j at [functions_of_cell() j + a] [1/m].
  virtual void slopes(std::size_t k, std::size_t p, Slopes& dN) const = 0;

 protected:
  explicit PointFunctions(int functions_of_cell) : functions_of_cell_(functions_of_cell) {}

  std::array<int, most_per_cell> offset_{};
  std::vector<std::array<int, Dim>> at_;  // (occupied cells)
  std::vector<int> first_;                // (occupied cells)

 private:
  int functions_of_cell_;
};

}  // namespace stillpoint
