// Fields at places of a phase, see place_reader.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "space/grid/degrees_of_freedom.hpp"
#include "space/grid/grid_functions.hpp"
#include "space/phase/place_reader.hpp"
#include "space/points/body.hpp"
#include "space/points/point_domains.hpp"
#include "space/points/points_around.hpp"

namespace stillpoint {

/// The displacement gradient that the law of point p in occupied cell k takes.
template <Kinematics K>
using GradientOfPoint = std::function<TensorOf<K>(std::size_t k, std::size_t p)>;

template <Kinematics K>
class PhasePlaces final : public PlaceReader {
  static constexpr int dim = dimensions(K);
  static constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
  using Cell = std::array<int, dim>;

 public:
  /// functions: a basis whose local functions belong to single cells; degree: that of the basis. gradient: for u. u
  /// since the phase began and v, (functions × dim). The referenced objects must outlive this one.
  PhasePlaces(std::unique_ptr<const GridFunctions<dim>> functions, int degree, const Body<K>& body, const Ranks* ranks,
              const DegreesOfFreedom& dofs, GradientOfPoint<K> gradient, std::vector<double> u, std::vector<double> v)
      : functions_(std::move(functions)),
        degree_(degree == 3 ? 4 : degree),
        grid_(functions_->grid()),
        body_(body),
        dofs_(dofs),
        gradient_(std::move(gradient)),
        u_(std::move(u)),
        v_(std::move(v)),
        occupied_(static_cast<std::size_t>(functions_->fields() * grid_.cells()), 0),
        around_(grid_, body.points, ranks) {
    mark_occupied();
    unite(ranks, std::span(occupied_));
  }

  bool holds(ConstVec x) const override {
    const Point<dim> at = point_at(x);
    return cell_with_points(field_at(at), at).has_value();
  }
  bool reaches(ConstVec x) const override { return place_of(point_at(x)).has_value(); }
  void put_back(Vec x) const override {
    constexpr double share = 0.1;
    for (int d = 0; d < dim; ++d) {
      const auto& nodes = grid_.axes[d].nodes;
      const double at = std::clamp(x[d], nodes.front(), nodes.back());
      const double cell = at < x[d] ? nodes.back() - nodes[nodes.size() - 2] : nodes[1] - nodes[0];
      if (std::abs(at - x[d]) <= share * cell) x[d] = at;
    }
  }

  void displacement(ConstVec x, Vec out) const override { vector_at(x, u_, out); }
  void velocity(ConstVec x, Vec out) const override { vector_at(x, v_, out); }
  void strain(ConstVec x, Vec out) const override {
    std::ranges::fill(out, no_value);
    const Point<dim> at = point_at(x);
    const auto place = place_of(at);
    if (!place) return;
    std::ranges::fill(out, 0.0);
    const auto values = functions_->evaluate(place->field, place->cell, at);
    const int per_cell = functions_->per_cell();
    double u_r = 0;
    for (int a = 0; a < per_cell; ++a) {
      const double* u = u_.data() + dim * values.function[a];
      u_r += values.N[a] * u[0];
      for (int i = 0; i < dim; ++i) {
        for (int j = 0; j < dim; ++j) out[dim * i + j] += u[i] * values.dN[per_cell * j + a];
      }
    }
    // on the axis u_r/r has the limit ∂u_r/∂r
    if constexpr (K == Kinematics::axisymmetric) out[dim * dim] = at[0] > 0 ? u_r / at[0] : out[0];
  }
  void stress(ConstVec x, Vec out) const override {
    std::ranges::fill(out, no_value);
    const Point<dim> at = point_at(x);
    if (!place_of(at)) return;
    std::ranges::fill(out, 0.0);
    const auto shares = around_.fit(at, degree_);
    const std::vector<double> stresses =
        around_.values(shares, out.size(), [this](std::size_t k, std::size_t p, Vec of_point) {
          const auto& material = *body_.materials[static_cast<std::size_t>(body_.points.material_of_cell(k))];
          std::ranges::copy(material.cauchy(gradient_(k, p), p), of_point.begin());
        });
    for (std::size_t s = 0; s < shares.size(); ++s)
      for (std::size_t i = 0; i < out.size(); ++i) out[i] += shares[s].weight * stresses[out.size() * s + i];
  }
  double pore_pressure(ConstVec x) const override {
    return of_material(x, [this](const PointMaterial<K>& material, std::size_t k, std::size_t p, std::size_t) {
      return material.pore_pressure(gradient_(k, p), p);
    });
  }
  double history(const std::string& name, ConstVec x) const override {
    return of_material(x, [&name](const PointMaterial<K>& material, std::size_t, std::size_t, std::size_t of_material) {
      for (const auto& [shown, values] : material.shown_history())
        if (shown == name) return values[of_material];
      return 0.0;
    });
  }

 private:
  // The value at x by those of the points around, value_at(material, occupied cell, point, its number in the material).
  template <class ValueAt>
  double of_material(ConstVec x, const ValueAt& value_at) const {
    const Point<dim> at = point_at(x);
    if (!place_of(at)) return no_value;
    const auto shares = around_.fit(at, degree_);
    const auto number = static_cast<std::size_t>(shares.front().point.material);  // shared by all of them
    const PointMaterial<K>& material = *body_.materials[number];
    const auto begin = static_cast<std::size_t>(body_.points.material_begin[number]);
    const std::vector<double> of_points = around_.values(
        shares, 1, [&](std::size_t k, std::size_t p, Vec out) { out[0] = value_at(material, k, p, p - begin); });
    double sum = 0, least = 0;
    for (std::size_t s = 0; s < shares.size(); ++s) {
      sum += shares[s].weight * of_points[s];
      least = std::min(least, of_points[s]);
    }
    return std::max(sum, least);
  }

  static Point<dim> point_at(ConstVec x) {
    Point<dim> at;
    std::copy_n(x.begin(), dim, at.begin());
    return at;
  }
  double width(const Cell& cell, int d) const {
    const auto& nodes = grid_.axes[d].nodes;
    return nodes[static_cast<std::size_t>(cell[d]) + 1] - nodes[static_cast<std::size_t>(cell[d])];
  }
  // The distance of x from a cell along an axis, below 0 inside [m].
  double outside(const Point<dim>& x, const Cell& cell, int d) const {
    const auto& nodes = grid_.axes[d].nodes;
    const auto c = static_cast<std::size_t>(cell[d]);
    return std::max(nodes[c] - x[d], x[d] - nodes[c + 1]);
  }

  // The field that moves the material at x: that of the nearest point.
  int field_at(const Point<dim>& x) const { return functions_->fields() == 1 ? 0 : around_.nearest(x).field; }
  std::size_t place_in_list(int field, int cell) const {
    return static_cast<std::size_t>(field * grid_.cells() + cell);
  }
  // Marks the cells with material points; for domains the cells that they are partly in.
  void mark_occupied() {
    const MaterialPoints<dim>& points = body_.points;
    constexpr double within = 1 - 1e-6;  // share of the way to a corner, which may lie on a grid line
    for (std::size_t k = 0; k < points.cells(); ++k) {
      const int field = points.field_of_cell(k);
      if (!points.has_domains()) {
        occupied_[place_in_list(field, points.cell[k])] = 1;
        continue;
      }
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        const Point<dim> middle = points.position(p);
        for (Point<dim> x : Domain<dim>::of(points, p).x) {
          for (int d = 0; d < dim; ++d) x[d] = middle[d] + within * (x[d] - middle[d]);
          occupied_[place_in_list(field, grid_.cell_number(grid_.cell_of(x)))] = 1;
        }
      }
    }
  }

  // Whether material reaches all functions of a cell that do not vanish at x.
  bool is_whole(int field, const Cell& cell, const Point<dim>& x) const {
    constexpr double rounding = 1e-12;
    const auto values = functions_->evaluate(field, cell, x);
    for (int a = 0; a < functions_->per_cell(); ++a) {
      const int unknown = dim * values.function[a];
      if (dofs_.number[static_cast<std::size_t>(unknown)] < 0 && std::abs(values.N[a]) > rounding) return false;
    }
    return true;
  }
  // The cell that represents x, if it has points: that of x, or a neighbour if x is on its border.
  std::optional<Cell> cell_with_points(int field, const Point<dim>& x) const {
    constexpr double rounding = 1e-9;  // share of a cell
    const Cell here = grid_.cell_of(x);
    for (int k = 0; k < power(3, dim); ++k) {
      constexpr std::array aside = {0, -1, 1};
      Cell cell = here;
      for (int d = 0; d < dim; ++d) cell[d] += aside[static_cast<std::size_t>(k / power(3, d) % 3)];
      bool is_cell = grid_.holds(cell);
      for (int d = 0; d < dim && is_cell; ++d) is_cell = outside(x, cell, d) <= rounding * width(cell, d);
      if (!is_cell) continue;
      if (occupied_[place_in_list(field, grid_.cell_number(cell))] && is_whole(field, cell, x)) return cell;
    }
    return std::nullopt;
  }
  struct Place {
    int field;
    Cell cell;
  };
  // The field and the cell that represent x, or whose functions are extrapolated to x.
  std::optional<Place> place_of(const Point<dim>& x) const {
    const int field = field_at(x);
    if (const auto cell = cell_with_points(field, x)) return Place{field, *cell};
    const Cell cell = grid_.cell_of(around_.nearest(x).x);
    for (int d = 0; d < dim; ++d) {
      if (!(outside(x, cell, d) <= width(cell, d))) return std::nullopt;
    }
    if (!is_whole(field, cell, x)) return std::nullopt;
    return Place{field, cell};
  }

  void vector_at(ConstVec x, const std::vector<double>& nodal, Vec out) const {
    std::ranges::fill(out, no_value);
    const Point<dim> at = point_at(x);
    const auto place = place_of(at);
    if (!place) return;
    std::ranges::fill(out, 0.0);
    const auto values = functions_->evaluate(place->field, place->cell, at);
    for (int a = 0; a < functions_->per_cell(); ++a) {
      for (int i = 0; i < dim; ++i)
        out[i] += values.N[a] * nodal[static_cast<std::size_t>(dim * values.function[a] + i)];
    }
  }

  std::unique_ptr<const GridFunctions<dim>> functions_;
  // Degree of the fits. Amid points on all sides those of degree 2 and 3 have the same value, to order 4 alone.
  int degree_;
  const Grid<dim>& grid_;
  const Body<K>& body_;
  const DegreesOfFreedom& dofs_;
  GradientOfPoint<K> gradient_;
  std::vector<double> u_, v_;
  std::vector<char> occupied_;  // whether a cell has material points, (fields × cells of the grid)
  PointsAround<dim> around_;
};

extern template class PhasePlaces<Kinematics::line>;
extern template class PhasePlaces<Kinematics::plane>;
extern template class PhasePlaces<Kinematics::axisymmetric>;
extern template class PhasePlaces<Kinematics::space>;

}  // namespace stillpoint
