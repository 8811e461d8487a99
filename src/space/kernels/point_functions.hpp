// The frozen weights of a phase, whatever their basis: for what is done once a phase, or at few points, and need not be
// compiled for each basis. Kernels take them from PointWeights, which they know whole.
#pragma once

#include <stillpoint/types.hpp>

#include <array>
#include <cstddef>
#include <vector>

#include "space/grid/degrees_of_freedom.hpp"
#include "space/grid/grid_functions.hpp"

namespace stillpoint {

template <int Dim>
class PointFunctions {
 public:
  virtual ~PointFunctions() = default;

  static constexpr int most_per_cell = most_functions_of_cell(Dim);
  using Numbers = std::array<double, most_per_cell>;
  using Slopes = std::array<double, Dim * most_per_cell>;

  /// Where occupied cell k is in the grid.
  const std::array<int, Dim>& cell_at(std::size_t k) const { return at_[k]; }
  /// Grid number of local function a in occupied cell k.
  int function(std::size_t k, int a) const { return first_[k] + offset_[a]; }
  int functions_of_cell() const { return functions_of_cell_; }

  /// N_a at [a] of point p in occupied cell k; entries from functions_of_cell() on are left as they are.
  virtual void values(std::size_t k, std::size_t p, Numbers& N) const = 0;
  /// Its gradients, ∂N_a/∂x_j at [functions_of_cell() j + a] [1/m].
  virtual void slopes(std::size_t k, std::size_t p, Slopes& dN) const = 0;

  /// F_i += N_ap value(i), at the free degrees of freedom, component after component; F: (n).
  template <class Value>
  void add_at_functions(std::size_t k, std::size_t p, const Value& value, const DegreesOfFreedom& dofs, Vec F) const {
    Numbers N;
    values(k, p, N);
    for (int i = 0; i < Dim; ++i) {
      const double of_component = value(i);
      for (int a = 0; a < functions_of_cell_; ++a) {
        dofs.for_sources(Dim * function(k, a) + i, [&](int, int dof, double share) {
          if (dofs.is_free(dof)) F[static_cast<std::size_t>(dof)] += of_component * share * N[a];
        });
      }
    }
  }

 protected:
  explicit PointFunctions(int functions_of_cell) : functions_of_cell_(functions_of_cell) {}

  std::array<int, most_per_cell> offset_{};
  std::vector<std::array<int, Dim>> at_;  // (occupied cells)
  std::vector<int> first_;                // (occupied cells)

 private:
  int functions_of_cell_;
};

}  // namespace stillpoint
