// The functions of a grid, of one field of motion or more, behind an interface without the basis as a template
// parameter: for work done once a phase, or at few positions. Kernels have the basis as a template parameter instead,
// see basis.hpp.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "space/grid/basis.hpp"
#include "space/grid/grid.hpp"
#include "space/grid/spline_coefficient.hpp"

namespace stillpoint {

/// The largest number of functions of a cell: that of cubic splines, in up to two dimensions those that a domain
/// reaches.
constexpr int most_functions_of_cell(int dim) { return dim == 3 ? power(4, dim) : power(5, dim); }

template <int Dim>
class GridFunctions {
 public:
  using Cell = std::array<int, Dim>;

  /// The local functions of a cell at a position; entries from per_cell() on are left as they are.
  struct Values {
    std::array<int, most_functions_of_cell(Dim)> function;  // their numbers in the grid
    std::array<double, most_functions_of_cell(Dim)> N;
    std::array<double, Dim * most_functions_of_cell(Dim)> dN;  // ∂N_a/∂x_j at [per_cell j + a] [1/m]
  };

  virtual ~GridFunctions() = default;

  const Grid<Dim>& grid() const { return grid_; }
  int per_cell() const { return per_cell_; }
  /// The number of functions of a cell along one axis.
  int per_axis() const { return per_axis_; }
  /// The window of the basis, see AxisBasis.
  int window() const { return window_; }
  int degree() const { return degree_; }
  bool partition_of_unity() const { return partition_of_unity_; }

  /// The number of functions of all fields: each field has all functions of the grid, one field after the other.
  int count() const { return fields_ * count_of_field(); }
  int fields() const { return fields_; }
  virtual int count_of_field() const = 0;
  /// The number of functions along an axis, as they are numbered.
  virtual int count_along(int axis) const = 0;
  /// The functions of a field.
  virtual Values evaluate(int field, const Cell& cell, const Point<Dim>& x) const = 0;
  /// The centre of a function along an axis [m].
  virtual double centre(int function, int axis) const = 0;
  /// The coefficient of a function of f(x) along an axis. Of a basis of values.
  virtual WeightedPositions coefficient_along(int function, int axis) const = 0;
  /// Whether the function is a value along each axis, and not a slope.
  virtual bool is_value(int function) const = 0;
  /// The functions of all fields that do not vanish on a face of the grid, in ascending order.
  virtual std::vector<int> on_face(int axis, bool upper) const = 0;
  /// The function of the first field that alone carries the value at x; empty if there is none, as inside a spline.
  virtual std::optional<int> interpolating(const Point<Dim>& x) const = 0;

  std::vector<int> values_on_face(int axis, bool upper) const {
    std::vector<int> values = on_face(axis, upper);
    std::erase_if(values, [&](int function) { return !is_value(function); });
    return values;
  }

 protected:
  /// The grid must outlive this object.
  GridFunctions(const Grid<Dim>& grid, int fields, int per_axis, int window, int degree, bool partition_of_unity)
      : grid_(grid),
        fields_(fields),
        per_axis_(per_axis),
        per_cell_(power(per_axis, Dim)),
        window_(window),
        degree_(degree),
        partition_of_unity_(partition_of_unity) {}

 private:
  const Grid<Dim>& grid_;
  int fields_, per_axis_, per_cell_, window_, degree_;
  bool partition_of_unity_;
};

template <AxisBasis B, int Dim>
class FunctionsOfBasis final : public GridFunctions<Dim> {
  using Basis = TensorBasis<B, Dim>;
  using typename GridFunctions<Dim>::Cell;
  using typename GridFunctions<Dim>::Values;
  static_assert(Basis::per_cell <= most_functions_of_cell(Dim));

 public:
  explicit FunctionsOfBasis(const Grid<Dim>& grid, int fields = 1)
      : GridFunctions<Dim>(grid, fields, B::per_cell, B::window, B::degree, B::partition_of_unity) {}

  int count_of_field() const override { return Basis::count(this->grid()); }
  int count_along(int axis) const override { return Basis::count_along(this->grid(), axis); }
  Values evaluate(int field, const Cell& cell, const Point<Dim>& x) const override {
    const auto of_cell = Basis::evaluate(this->grid(), cell, x);
    const auto offset = Basis::offsets(this->grid());
    const int first = field * count_of_field() + Basis::first(this->grid(), cell);
    Values values;
    for (int a = 0; a < Basis::per_cell; ++a) {
      values.function[a] = first + offset[a];
      values.N[a] = of_cell.N[a];
      for (int j = 0; j < Dim; ++j) values.dN[Basis::per_cell * j + a] = of_cell.dN[j][a];
    }
    return values;
  }
  double centre(int function, int axis) const override {
    return B::centre(this->grid().axes[axis], Basis::index_along(this->grid(), function, axis));
  }
  WeightedPositions coefficient_along(int function, int axis) const override {
    if constexpr (!B::partition_of_unity) return {{centre(function, axis)}, {1.0}};
    const int along = Basis::index_along(this->grid(), function, axis);
    return spline_coefficient(this->grid().axes[axis], B::degree, along);
  }
  bool is_value(int function) const override { return Basis::is_value(this->grid(), function); }
  std::vector<int> on_face(int axis, bool upper) const override {
    const std::vector<int> of_field = Basis::face_functions(this->grid(), axis, upper);
    std::vector<int> all;
    for (int field = 0; field < this->fields(); ++field)
      for (const int function : of_field) all.push_back(field * count_of_field() + function);
    return all;
  }
  std::optional<int> interpolating(const Point<Dim>& x) const override {
    return Basis::interpolating_function(this->grid(), x);
  }
};

}  // namespace stillpoint
