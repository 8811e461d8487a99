// A piece of a body's border, which moves with the body and changes its area with it.
#pragma once

#include <array>
#include <cmath>

#include "space/boundary/carried_point.hpp"
#include "space/boundary/way_since_placed.hpp"
#include "space/kernels/change_of_volume.hpp"

namespace stillpoint {

template <Kinematics K>
struct BorderPiece {
  static constexpr int dim = dimensions(K);
  using Entry = typename CarriedPoint<dim>::Entry;

  Point<dim> X;  // undeformed position [m]
  CarriedPoint<dim> at;
  double area;                     // undeformed area [m²]
  std::array<double, dim> vector;  // n da when the phase begins [m²]
  Point<dim>
      gone{};  // the way from at.x to where it is: stages of small strain leave points, and weights, in place [m]

  /// x: undeformed position; normal: outwards.
  static BorderPiece make(const Point<dim>& x, double area, const Point<dim>& normal) {
    CarriedPoint<dim> at{};
    at.x = x;
    BorderPiece piece{.X = x, .at = at, .area = area, .vector = {}};
    for (std::size_t d = 0; d < dim; ++d) piece.vector[d] = normal[d] * area;
    return piece;
  }

  /// The cell on the body's side of the piece, which matters on a grid line.
  std::array<int, dim> cell_inside(const Grid<dim>& grid) const {
    constexpr double inwards = 1e-9;
    Point<dim> inside = at.x;
    const auto here = grid.cell_of(inside);
    for (int d = 0; d < dim; ++d) {
      const auto& nodes = grid.axes[d].nodes;
      const double h = nodes[static_cast<std::size_t>(here[d]) + 1] - nodes[static_cast<std::size_t>(here[d])];
      inside[d] -= inwards * h * (vector[d] > 0 ? 1 : vector[d] < 0 ? -1 : 0);
    }
    return grid.cell_of(inside);
  }
  /// Sets the weights in a body of a single phase, by that cell. If some of the cell's functions have no material, the
  /// others take the whole force. False if none has.
  bool freeze_in_single_phase(const PhaseParts<dim>& phase) {
    const double reached = at.freeze(cell_inside(phase.grid), phase);
    if (!(reached > 1e-12)) return false;
    if (phase.functions.partition_of_unity()) {
      for (Entry& entry : at.entries) entry.w /= reached;
    }
    return true;
  }
  /// The area when the phase begins [m²].
  double size() const {
    double square = 0;
    for (const double along : vector) square += along * along;
    return std::sqrt(square);
  }
  /// The unit normal when the phase begins, outwards.
  Point<dim> normal() const {
    Point<dim> n;
    for (std::size_t d = 0; d < dim; ++d) n[d] = vector[d] / size();
    return n;
  }
  /// Moves the piece by the displacement u at the end of a phase.
  void move(const double* u) {
    vector = deformed_area(u);
    at.move(u);
  }
  /// Moves it from where it was placed to where another run has left it; in_place: as the points of small strain.
  void leave_placed(const WaySincePlaced<dim>& way, bool in_place) {
    if (in_place) {
      gone = way.u;
      return;
    }
    vector = way.area(vector);
    for (std::size_t i = 0; i < dim; ++i) at.x[i] += way.u[i];
  }

  /// Moves it at the end of a stage of small strain.
  void move_in_place(const double* u) {
    for (const Entry& a : at.entries) {
      for (std::size_t i = 0; i < dim && a.function >= 0; ++i)
        gone[i] += a.w * u[dim * a.function + static_cast<int>(i)];
    }
  }
  /// Where it is when the phase begins [m].
  Point<dim> place() const {
    Point<dim> x = at.x;
    for (std::size_t i = 0; i < dim; ++i) x[i] += gone[i];
    return x;
  }

  /// The deformed area vector cof(f) n da; cof(f) = [f_yy, −f_yx; −f_xy, f_xx] in the plane, times f_θθ if
  /// axisymmetric.
  std::array<double, dim> deformed_area(const double* u) const {
    if constexpr (dim == 1) {
      return vector;
    } else {
      return times_normal(ChangeOfVolume<K>::cofactor(deformation(u)));
    }
  }
  /// The derivative of the deformed area by component j of a function.
  std::array<double, dim> area_derivative(const double* u, const Entry& b, int j) const {
    if constexpr (dim == 1) {
      return {};
    } else {
      TensorOf<K> df{};
      for (int i = 0; i < dim; ++i) df[dim * j + i] = b.dN[i];
      if (j == 0 && has_hoop()) df[hoop] = b.w / at.x[0];
      return times_normal(ChangeOfVolume<K>::cofactor_rate(deformation(u), df));
    }
  }

 private:
  static constexpr std::size_t hoop = gradient_components(K) - 1;  // index of θθ, if axisymmetric

  bool has_hoop() const { return K == Kinematics::axisymmetric && at.x[0] > 0; }
  std::array<double, dim> times_normal(const TensorOf<K>& cofactor) const {
    std::array<double, dim> all{};
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) all[i] += cofactor[dim * i + j] * vector[j];
    }
    return all;
  }
  // The deformation gradient f, with f_θθ = 1 on the axis.
  TensorOf<K> deformation(const double* u) const {
    TensorOf<K> f = plus_identity<K>({});
    double u_r = 0;
    for (const Entry& a : at.entries) {
      if (a.function < 0) continue;
      const double* of_function = u + dim * a.function;
      u_r += a.w * of_function[0];
      for (int i = 0; i < dim; ++i) {
        for (int j = 0; j < dim; ++j) f[dim * i + j] += of_function[i] * a.dN[j];
      }
    }
    if (has_hoop()) f[hoop] += u_r / at.x[0];
    return f;
  }
};

}  // namespace stillpoint
