// A block in one plane of a grid whose deformation is given, with its loads: their resultant, and what they leave over.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "free_block.hpp"
#include "largest.hpp"
#include "space/boundary/boundary_conditions.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/kernels/corner_sum.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/points/make_body.hpp"

namespace stillpoint::test {

struct Matrix {
  double xx, xy, yx, yy;
  Point<2> operator*(const Point<2>& a) const { return {xx * a[0] + xy * a[1], yx * a[0] + yy * a[1]}; }
  Matrix operator*(const Matrix& b) const {
    return {xx * b.xx + xy * b.yx, xx * b.xy + xy * b.yy, yx * b.xx + yy * b.yx, yx * b.xy + yy * b.yy};
  }
  Matrix cofactor() const { return {yy, -yx, -xy, xx}; }
};
inline Matrix rotation(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)};
}

struct Resultant {
  Point<2> force{};
  double moment = 0;  // about the origin

  void add(const Point<2>& at, const Point<2>& f) {
    for (std::size_t i = 0; i < 2; ++i) force[i] += f[i];
    moment += at[0] * f[1] - at[1] * f[0];
  }
};

/// The block [0.5, 1.75] × [0.25, 0.75] m of free_block() in cells of 0.25 m, with its loads.
template <AxisBasis B, Kinematics K>
class LoadedBlock {
  using Basis = TensorBasis<B, 2>;

 public:
  explicit LoadedBlock(Scene scene)
      : scene_(std::move(scene)),
        grid_(grid_at<2>(scene_, 0)),
        body_(make_body<K>(scene_, grid_, true)),
        loads_(make_boundary_conditions<K>(scene_, grid_, 1)) {
    begin_phase();
  }

  /// Each position goes to where(x), which is affine, and the next phase begins.
  void deform(const std::function<Point<2>(const Point<2>&)>& where) {
    const Point<2> origin = where({0, 0}), along_x = where({1, 0}), along_y = where({0, 1});
    const double det =
        (along_x[0] - origin[0]) * (along_y[1] - origin[1]) - (along_y[0] - origin[0]) * (along_x[1] - origin[1]);
    std::vector<double> u;
    for (int f = 0; f < Basis::count(grid_); ++f) {
      const Point<2> at = greville(f), to = where(at);
      for (std::size_t i = 0; i < 2; ++i) u.push_back(to[i] - at[i]);
    }
    for (const auto& load : loads_) load->end_phase(u.data());
    for (std::size_t p = 0; p < body_.points.size(); ++p) {
      const Point<2> to = where(body_.points.position(p));
      for (std::size_t i = 0; i < 2; ++i) body_.points.x[i][p] = to[i];
      body_.points.volume[p] *= det;
      for (std::size_t c = 0; B::window > 1 && c < 4; ++c) {
        const Point<2> corner = where({body_.points.corner[2 * c][p], body_.points.corner[2 * c + 1][p]});
        for (std::size_t i = 0; i < 2; ++i) body_.points.corner[2 * c + i][p] = corner[i];
      }
    }
    order_.sort(body_.points, grid_);
    begin_phase();
  }

  /// Of Σ_p V_p σ ∇N_ip with the same first row of σ everywhere and the nodal forces along x, over the largest of
  /// these.
  double imbalance(double stress_xx, double stress_xy) const {
    std::vector<double> F = constant_force_;
    for (const auto& load : loads_) load->add_load(parts(), 0, F);
    for (std::size_t k = 0; k < F.size(); ++k) {
      if (dofs_->free[k] % 2 == 1) F[k] = 0;
    }
    const double scale = largest_magnitude(F);
    for (std::size_t k = 0; k < body_.points.cells(); ++k) {
      for (std::size_t p = body_.points.begin(k); p < body_.points.end(k); ++p) {
        const double* dN = weights_.dN(k, p);
        for (int a = 0; a < Basis::per_cell; ++a) {
          const int dof = dofs_->number[static_cast<std::size_t>(2 * weights_.function(k, a))];
          const double force = stress_xx * dN[a] + stress_xy * dN[Basis::per_cell + a];
          F[static_cast<std::size_t>(dof)] -= body_.points.volume[p] * force;
        }
      }
    }
    return largest_magnitude(F) / scale;
  }

  /// Of the nodal forces: Σ F_i and Σ ξ_i × F_i.
  Resultant resultant() const {
    std::vector<double> F = constant_force_;
    const std::vector<double> u(held_size_, 0.0);
    for (const auto& load : loads_) load->add_load(parts(), 0, F);
    for (const auto& load : loads_) load->add_following_force(parts(), 0, u.data(), F);
    Resultant sum;
    for (std::size_t k = 0; k < F.size(); k += 2) sum.add(greville(dofs_->free[k] / 2), {F[k], F[k + 1]});
    return sum;
  }

 private:
  // Σ_i N_i(x) ξ_i = x: the mean of the p knots inside a function's support.
  Point<2> greville(int function) const {
    Point<2> at{};
    for (int d = 0; d < 2; ++d) {
      const Axis& axis = grid_.axes[static_cast<std::size_t>(d)];
      const int i = Basis::index_along(grid_, function, d);
      for (int k = 1; k <= B::degree; ++k) {
        const int node = std::clamp(i + k - B::degree, 0, axis.cells());
        at[static_cast<std::size_t>(d)] += axis.nodes[static_cast<std::size_t>(node)] / B::degree;
      }
    }
    return at;
  }
  void begin_phase() {
    weights_.rebuild(grid_, body_.points);
    const auto functions = static_cast<std::size_t>(Basis::count(grid_));
    std::vector<char> reached(functions, 0);
    for (std::size_t k = 0; k < body_.points.cells(); ++k) {
      for (int a = 0; a < Basis::per_cell; ++a) reached[static_cast<std::size_t>(weights_.function(k, a))] = 1;
    }
    std::vector<int> function_of_corner;
    for (std::size_t k = 0; k < body_.points.cells(); ++k)
      for (int a = 0; a < Basis::per_cell; ++a) function_of_corner.push_back(weights_.function(k, a));
    corner_sum_.rebuild(function_of_corner, functions);
    held_size_ = 2 * functions;
    held_ = HeldUnknowns(held_size_, 0);
    dofs_.emplace(reached, 2, std::vector<int>{});
    node_mass_.assign(functions, 1);
    mass_.emplace(Mass::lumped(std::vector<double>(dofs_->size(), 1)));
    constant_force_.assign(dofs_->size(), 0);
    for (const auto& load : loads_) load->begin_phase(parts(), constant_force_);
  }
  PhaseParts<2> parts() const {
    return {grid_,  functions_, body_.points, weights_, corner_sum_, held_,
            *dofs_, node_mass_, *mass_,       false,    false,       gone_};
  }

  const Scene scene_;
  Grid<2> grid_;
  const FunctionsOfBasis<B, 2> functions_{grid_};
  Body<K> body_;
  BoundaryConditions<2> loads_;
  PointOrder<2> order_;
  PointWeights<B, K> weights_;
  CornerSum corner_sum_;
  HeldUnknowns held_;
  std::size_t held_size_ = 0;
  std::optional<DegreesOfFreedom> dofs_;
  std::vector<double> node_mass_, constant_force_, gone_;
  std::optional<Mass> mass_;
};

}  // namespace stillpoint::test
