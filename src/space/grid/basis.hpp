// Bases on an axis, and their tensor products on a grid.
//
// On a cell an axis basis has `per_cell` functions, numbered contiguously from first(cell):
//   BSpline<p>     p + 1 functions, C^(p-1), knots at the nodes and p + 1 of them at each end, so that the boundary
//                  functions interpolate there [Piegl and Tiller 1997, algorithms A2.2 and A2.3]
//   CubicHermite   value and slope at both nodes, C¹; a slope's degree of freedom is du/dx
#pragma once

#include <stillpoint/unroll.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <optional>
#include <vector>

#include "base/lanes.hpp"
#include "space/grid/grid.hpp"

namespace stillpoint {

template <class B>
concept AxisBasis = requires(const Axis& axis, int cell, double x, double* N) {
  { B::degree } -> std::convertible_to<int>;
  { B::per_cell } -> std::convertible_to<int>;
  // Whether Σ_i N_i = 1, so that row sums lump the mass.
  { B::partition_of_unity } -> std::convertible_to<bool>;
  // The number of neighbouring cells to which the local functions belong.
  { B::window } -> std::convertible_to<int>;
  // Whether local function a is a value (and not a slope).
  { B::is_value(cell) } -> std::convertible_to<bool>;
  // The number of functions of so many cells next to each other.
  { B::count(cell) } -> std::convertible_to<int>;
  { B::first(cell) } -> std::convertible_to<int>;
  // Sets N[a], dN[a] = dN_a/dx of the cell's functions at x; N, dN: (per_cell).
  {B::evaluate(axis, cell, x, N, N)};
};

template <int Degree>
struct BSpline {
  static constexpr int degree = Degree;
  static constexpr int per_cell = Degree + 1;
  static constexpr int window = 1;
  static constexpr bool partition_of_unity = true;
  static constexpr bool is_value(int) { return true; }
  static constexpr int count(int cells) { return cells + Degree; }
  static int first(int cell) { return cell; }
  /// The centre of a function, Greville's abscissa x_i: Σ_i N_i(x) x_i = x.
  static double centre(const Axis& axis, int function) {
    double sum = 0;
    for (int q = function - Degree + 1; q <= function; ++q)
      sum += axis.nodes[static_cast<std::size_t>(std::clamp(q, 0, axis.cells()))];
    return sum / Degree;
  }

  /// Evaluates the functions of one cell at many positions in it.
  class OnCell {
   public:
    OnCell(const Axis& axis, int cell) {
      for (int k = 0; k < 2 * Degree; ++k)
        knot_[k] = axis.nodes[static_cast<std::size_t>(std::clamp(cell + 1 - Degree + k, 0, axis.cells()))];
      for (int q = 1; q <= Degree; ++q) {
        for (int r = 0; r < q; ++r) per_length_[q - 1][r] = 1 / (right(r) - left(q, r));
      }
    }

    // Cox–de Boor recursion, N_i,q = (x − t_i)/(t_i+q − t_i) N_i,q−1 + (t_i+q+1 − x)/(t_i+q+1 − t_i+1) N_i+1,q−1
    void evaluate(double x, double* N, double* dN) const {
      std::array<double, per_cell> lower{};  // the functions of degree p − 1
      N[0] = 1;
      for (int q = 1; q <= Degree; ++q) {
        if (q == Degree) std::copy(N, N + Degree, lower.begin());
        double saved = 0;
        for (int r = 0; r < q; ++r) {
          const double share = N[r] * per_length_[q - 1][r];
          N[r] = saved + (right(r) - x) * share;
          saved = (x - left(q, r)) * share;
        }
        N[q] = saved;
      }
      // N'_i,p = p N_i,p−1/(t_i+p − t_i) − p N_i+1,p−1/(t_i+p+1 − t_i+1)
      for (int r = 0; r <= Degree; ++r) {
        const auto slope = [&](int k) { return Degree * lower[k] * per_length_[Degree - 1][k]; };
        dN[r] = (r > 0 ? slope(r - 1) : 0.0) - (r < Degree ? slope(r) : 0.0);
      }
    }

   private:
    double right(int r) const { return knot_[Degree + r]; }
    double left(int q, int r) const { return knot_[Degree + r - q]; }

    std::array<double, static_cast<std::size_t>(2 * Degree)> knot_;  // knots t from number cell + 1 − p on [m]
    std::array<std::array<double, static_cast<std::size_t>(Degree)>, static_cast<std::size_t>(Degree)>
        per_length_;  // 1/(t_i+q − t_i) at [q − 1] [1/m]
  };
  static void evaluate(const Axis& axis, int cell, double x, double* N, double* dN) {
    OnCell(axis, cell).evaluate(x, N, dN);
  }
};

struct CubicHermite {
  static constexpr int degree = 3;
  static constexpr int per_cell = 4;
  static constexpr int window = 1;
  static constexpr bool partition_of_unity = false;
  static constexpr bool is_value(int a) { return a % 2 == 0; }
  static constexpr int count(int cells) { return 2 * (cells + 1); }
  static int first(int cell) { return 2 * cell; }
  /// The node that a function belongs to.
  static double centre(const Axis& axis, int function) { return axis.nodes[static_cast<std::size_t>(function / 2)]; }

  class OnCell {
   public:
    OnCell(const Axis& axis, int cell)
        : left_(axis.nodes[static_cast<std::size_t>(cell)]),
          h_(axis.nodes[static_cast<std::size_t>(cell) + 1] - left_) {}

    // Hermite polynomials with s = (x − x_c)/h: 1 − 3s² + 2s³, h s(1 − s)², 3s² − 2s³, −h s²(1 − s)
    void evaluate(double x, double* N, double* dN) const {
      const double s = (x - left_) / h_;
      N[0] = 1 + s * s * (2 * s - 3);
      N[1] = h_ * s * (1 - s) * (1 - s);
      N[2] = s * s * (3 - 2 * s);
      N[3] = h_ * s * s * (s - 1);
      dN[0] = 6 * s * (s - 1) / h_;
      dN[1] = (1 - s) * (1 - 3 * s);
      dN[2] = -dN[0];
      dN[3] = s * (3 * s - 2);
    }

   private:
    double left_, h_;
  };
  static void evaluate(const Axis& axis, int cell, double x, double* N, double* dN) {
    OnCell(axis, cell).evaluate(x, N, dN);
  }
};

constexpr int power(int base, int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

/// The product of one axis basis with itself over Dim coordinates; local functions with the first coordinate fastest.
template <AxisBasis B, int Dim>
struct TensorBasis {
  static constexpr int per_cell = power(B::per_cell, Dim);

  using OfAxes = std::array<std::array<double, B::per_cell>, Dim>;

  /// N[a] and dN[d][a] = ∂N_a/∂x_d at a point.
  struct Values {
    std::array<double, per_cell> N;
    std::array<std::array<double, per_cell>, Dim> dN;
  };

  /// The number of functions, of those cells that have numbers.
  static int count(const Grid<Dim>& grid) {
    int total = 1;
    for (int d = 0; d < Dim; ++d) total *= count_along(grid, d);
    return total;
  }
  static int count_along(const Grid<Dim>& grid, int axis) { return B::count(grid.range(axis).count()); }
  static constexpr int axis_index(int a, int d) { return a / power(B::per_cell, d) % B::per_cell; }
  static constexpr bool is_value(int a) {
    for (int d = 0; d < Dim; ++d) {
      if (!B::is_value(axis_index(a, d))) return false;
    }
    return true;
  }
  /// Global number of a cell's first function.
  static int first(const Grid<Dim>& grid, const std::array<int, Dim>& cell) {
    int number = 0;
    for (int d = Dim - 1; d >= 0; --d)
      number = number * count_along(grid, d) + B::first(cell[d]) - B::first(grid.range(d).first);
    return number;
  }
  /// The offsets of local functions a from first(). Where an axis has no second cell, functions of that cell vanish and
  /// get an offset within the grid.
  static std::array<int, per_cell> offsets(const Grid<Dim>& grid) {
    std::array<int, per_cell> offset{};
    for (int a = 0; a < per_cell; ++a) {
      for (int d = Dim - 1; d >= 0; --d) {
        const int count = count_along(grid, d);
        offset[a] = offset[a] * count + std::min(axis_index(a, d), count - 1);
      }
    }
    return offset;
  }
  static Values evaluate(const Grid<Dim>& grid, const std::array<int, Dim>& cell, const Point<Dim>& x) {
    std::array<std::array<double, B::per_cell>, Dim> N, dN;
    for (int d = 0; d < Dim; ++d) B::evaluate(grid.axes[d], cell[d], x[d], N[d].data(), dN[d].data());
    Values values;
    multiply(N, dN, values.N.data(), values.dN[0].data());
    return values;
  }
  /// Evaluates the functions of all cells at many positions, for a basis whose local functions belong to a single cell.
  class OnCells {
   public:
    explicit OnCells(const Grid<Dim>& grid) {
      for (int d = 0; d < Dim; ++d) {
        first_[d] = grid.range(d).first;
        for (int c = grid.range(d).first; c < grid.range(d).end; ++c) axes_[d].emplace_back(grid.axes[d], c);
      }
    }
    /// N: (per_cell), dN: (Dim × per_cell).
    void evaluate(const std::array<int, Dim>& cell, const Point<Dim>& x, double* N, double* dN) const {
      OfAxes of_axis, slope;
      evaluate_factors(cell, x, of_axis, slope);
      multiply(of_axis, slope, N, dN);
    }
    /// Sets the functions along each axis, and their derivatives.
    void evaluate_factors(const std::array<int, Dim>& cell, const Point<Dim>& x, OfAxes& N, OfAxes& dN) const {
      for (int d = 0; d < Dim; ++d)
        axes_[d][static_cast<std::size_t>(cell[d] - first_[d])].evaluate(x[d], N[d].data(), dN[d].data());
    }

   private:
    std::array<int, Dim> first_{};
    std::array<std::vector<typename B::OnCell>, Dim> axes_;
  };
  /// The functions that do not vanish on a face of the grid, in ascending order; face_values() leaves out slopes along
  /// the face.
  static std::vector<int> face_functions(const Grid<Dim>& grid, int axis, bool upper) {
    // One function across the face has a value there: the last, or the last but one if a slope follows it.
    const CellRange along = grid.range(axis);
    std::vector<int> found;
    if (upper ? along.end < grid.axes[static_cast<std::size_t>(axis)].cells() : along.first > 0) return found;
    const int count = count_along(grid, axis);
    const int across = !upper ? 0 : B::is_value(B::per_cell - 1) ? count - 1 : count - 2;
    int stride = 1;
    for (int d = 0; d < axis; ++d) stride *= count_along(grid, d);
    for (int begin = across * stride; begin < TensorBasis::count(grid); begin += count * stride) {
      for (int number = begin; number < begin + stride; ++number) found.push_back(number);
    }
    return found;
  }
  static std::vector<int> face_values(const Grid<Dim>& grid, int axis, bool upper) {
    std::vector<int> values = face_functions(grid, axis, upper);
    std::erase_if(values, [&](int number) { return !is_value(grid, number); });
    return values;
  }
  /// Whether a function, by its global number, is a value along each axis.
  static bool is_value(const Grid<Dim>& grid, int number) {
    for (int d = 0; d < Dim; ++d) {
      if (!B::is_value(index_along(grid, number, d))) return false;
    }
    return true;
  }
  /// The place along an axis of a function given by its global number, among all functions of the axis.
  static int index_along(const Grid<Dim>& grid, int number, int axis) {
    for (int d = 0; d < axis; ++d) number /= count_along(grid, d);
    return B::first(grid.range(axis).first) + number % count_along(grid, axis);
  }
  /// index_along() of each axis.
  static std::array<int, Dim> places_of(const Grid<Dim>& grid, int number) {
    std::array<int, Dim> places;
    for (int d = 0; d < Dim; ++d) places[d] = index_along(grid, number, d);
    return places;
  }
  /// The global number of the function at these places; −1 if it has none.
  static int number_at(const Grid<Dim>& grid, const std::array<int, Dim>& places) {
    int number = 0;
    for (int d = Dim - 1; d >= 0; --d) {
      const int along = places[d] - B::first(grid.range(d).first), count = count_along(grid, d);
      if (along < 0 || along >= count) return -1;
      number = number * count + along;
    }
    return number;
  }
  /// The global number of the function that alone carries the value at x (1 there, all others 0); empty if there is
  /// none, as inside a spline.
  static std::optional<int> interpolating_function(const Grid<Dim>& grid, const Point<Dim>& x) {
    constexpr double rounding = 1e-12;
    const auto cell = grid.cell_of(x);
    const Values values = evaluate(grid, cell, x);
    const auto offset = offsets(grid);
    std::optional<int> found;
    for (int a = 0; a < per_cell; ++a) {
      if (std::abs(values.N[a] - 1) < rounding) {
        found = first(grid, cell) + offset[a];
      } else if (std::abs(values.N[a]) > rounding) {
        return std::nullopt;
      }
    }
    return found;
  }

  // N_a = Π_d N_a(d), ∂N_a/∂x_e = dN_a(e) Π_{d≠e} N_a(d)
  static void multiply(const OfAxes& N, const OfAxes& dN, double* product, double* gradients) {
    if constexpr (Dim == 1) {
      std::copy(N[0].begin(), N[0].end(), product);
      std::copy(dN[0].begin(), dN[0].end(), gradients);
    } else if constexpr (Dim == 2 && B::per_cell <= 4) {
      constexpr int n = B::per_cell;
      // Stores whole rows of functions along x; the next row overwrites what exceeds a row's end.
      const auto padded = [](const auto& of_axis) {
        return Lanes<4>{{of_axis[0], of_axis[n > 1 ? 1 : 0], of_axis[n > 2 ? 2 : 0], of_axis[n > 3 ? 3 : 0]}};
      };
      const Lanes<4> N_x = padded(N[0]), dN_x = padded(dN[0]);
      unroll<n>([&](auto b) __attribute__((always_inline)) {
        constexpr std::size_t room = b + 1 < n ? 4 : n;
        N_x.times(N[1][b]).store_first(product + n * b, room);
        dN_x.times(N[1][b]).store_first(gradients + n * b, room);
        N_x.times(dN[1][b]).store_first(gradients + per_cell + n * b, room);
      });
    } else {
      for (int a = 0; a < per_cell; ++a) {
        const auto along = [&](int slope) {
          double factor = 1;
          for (int d = 0; d < Dim; ++d) factor *= (d == slope ? dN : N)[d][axis_index(a, d)];
          return factor;
        };
        product[a] = along(-1);
        for (int e = 0; e < Dim; ++e) gradients[per_cell * e + a] = along(e);
      }
    }
  }
};

}  // namespace stillpoint
