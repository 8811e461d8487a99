// Internal forces of linear elastic material in bilinear cells, from moments of their points.
//
// In a cell with sides a and b and positions ξ, η from 0 to 1 in it,
//
//   H_i1 = (l_i + t_i η)/a,   H_i2 = (r_i + t_i ξ)/b        l, r, t: differences of the corners' displacements
//
// so that with constant moduli A and small strain the sums that the corners' forces are made of,
//
//   Σ V_p P_p (1, ξ, η) = A : Σ V_p H_p (1, ξ, η),
//
// take of the points no more than Σ V_p (1, ξ, η, ξ², ξη, η²). A cell costs the same however many points it has.
//
// In the plane an isotropic law has P_xx, P_yy = κ tr H ± μ (H_xx − H_yy). If the points of a cell share their change
// of volume, see MeanDilatation, t̄ = Σ V_p tr H_p/Σ V_p stands for tr H, and that is all: a_p = κ V_p t̄, so that the
// law's V P̄ is V P.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/lanes.hpp"
#include "base/unroll.hpp"
#include "space/kernels/point_weights.hpp"

namespace stillpoint {

class ElasticCells {
 public:
  using Weights = PointWeights<BSpline<1>, Kinematics::plane>;
  /// Of an isotropic law: P_xx = normal H_xx + cross H_yy, P_xy = P_yx = shear (H_xy + H_yx) [Pa].
  struct Moduli {
    double normal, cross, shear;
  };

  /// For a phase of these points and weights, which outlive it. moduli: of each material. shares_dilatation: whether
  /// the points of a cell share their change of volume.
  void rebuild(const MaterialPoints<2>& points, const Weights& weights, std::vector<Moduli> moduli,
               bool shares_dilatation) {
    points_ = &points;
    weights_ = &weights;
    moduli_ = std::move(moduli);
    shares_dilatation_ = shares_dilatation;
    for (auto& moment : moments_) moment.resize(points.cells() + slack);
    for (auto& per_side : inverse_side_) per_side.resize(points.cells() + slack);
    for_each_block(points.cells(), [&](std::size_t k) {
      std::array<double, 6> sum{};
      const double *xi = weights.position_in_cell(0), *eta = weights.position_in_cell(1);
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        const std::array terms{1.0, xi[p], eta[p], xi[p] * xi[p], xi[p] * eta[p], eta[p] * eta[p]};
        for (std::size_t m = 0; m < terms.size(); ++m) sum[m] += points.volume[p] * terms[m];
      }
      for (std::size_t m = 0; m < sum.size(); ++m) moments_[m][k] = sum[m];
      for (std::size_t d = 0; d < 2; ++d) inverse_side_[d][k] = weights.cell(k).inverse_side[d];
    });
  }
  bool empty() const { return moduli_.empty(); }
  double bytes() const { return 8.0 * sizeof(double) * static_cast<double>(points_->cells()); }

  /// corner[8 k + 2 a + i]: the force of cell k at its corner a, for the cells begin … end − 1. u: over the grid's
  /// functions. Returns 0, or NaN if a force is not finite.
  double forces(const double* u, std::size_t begin, std::size_t end, double* corner) const {
    return shares_dilatation_ ? forces_of_cells<true>(u, begin, end, corner)
                              : forces_of_cells<false>(u, begin, end, corner);
  }

 private:
  static constexpr std::size_t lanes = 4;  // cells at a time
  static constexpr std::size_t slack = lanes - 1;
  using Four = Lanes<4>;

  template <bool Shared>
  double forces_of_cells(const double* u, std::size_t begin, std::size_t end, double* corner) const {
    double bad = 0;
    for (std::size_t first = begin; first < end;) {
      std::size_t last = first + 1;
      const int material = points_->material_of_cell(first);
      while (last < end && last - first < lanes && points_->material_of_cell(last) == material) ++last;
      const Moduli& moduli = moduli_[static_cast<std::size_t>(material)];
      bad += forces_of<Shared>(moduli, u, first, last - first, corner + 8 * first);
      first = last;
    }
    return bad;
  }

  // Of `count` cells, at most as many as there are lanes.
  template <bool Shared>
  [[gnu::always_inline]] double forces_of(const Moduli& A, const double* u, std::size_t first, std::size_t count,
                                          double* corner) const {
    // Displacements x and y of two neighbouring corners lie side by side.
    std::array<Four, 4> lower_corners, upper_corners;
    unroll<lanes>([&](auto lane) __attribute__((always_inline)) {
      constexpr std::size_t q = lane;
      const std::size_t k = first + (q < count ? q : 0);
      lower_corners[q] = Four::load(u + 2 * static_cast<std::ptrdiff_t>(weights_->function(k, 0)));
      upper_corners[q] = Four::load(u + 2 * static_cast<std::ptrdiff_t>(weights_->function(k, 2)));
    });
    const auto u_below = transposed(lower_corners), u_above = transposed(upper_corners);  // x, y; x, y
    const auto moment = [&](std::size_t m) __attribute__((always_inline)) { return Four::load(&moments_[m][first]); };
    const Four M = moment(0), M_x = moment(1), M_y = moment(2), M_xx = moment(3), M_xy = moment(4), M_yy = moment(5);
    const Four per_x = Four::load(&inverse_side_[0][first]), per_y = Four::load(&inverse_side_[1][first]);
    // Σ V H_ij (1, ξ, η)
    struct Sums {
      Four of_1, of_xi, of_eta;
    };
    std::array<Sums, 2> H_x, H_y;
    unroll<2>([&](auto i) __attribute__((always_inline)) {
      const Four lower = u_below[2 + i].minus(u_below[i]), left = u_above[i].minus(u_below[i]);
      const Four twist = u_above[2 + i].minus(u_above[i]).minus(lower);
      const Four l = lower.times(per_x), t_x = twist.times(per_x), r = left.times(per_y), t_y = twist.times(per_y);
      H_x[i] = {l.times(M).plus_product(t_x, M_y), l.times(M_x).plus_product(t_x, M_xy),
                l.times(M_y).plus_product(t_x, M_yy)};
      H_y[i] = {r.times(M).plus_product(t_y, M_x), r.times(M_x).plus_product(t_y, M_xx),
                r.times(M_y).plus_product(t_y, M_xy)};
    });
    // κ t̄
    const Four pressure = Shared ? H_x[0].of_1.plus(H_y[1].of_1).over(M).times((A.normal + A.cross) / 2) : Four{};
    // Σ V P_xx, times 1, ξ or η as H_xx, H_yy and `volume`, Σ V, are; of H_yy and H_xx it is P_yy.
    const auto normal_stress = [&](const Four& along, const Four& across, const Four& volume)
        __attribute__((always_inline)) {
      if constexpr (Shared) return along.minus(across).times(A.shear).plus_product(pressure, volume);
      return along.times(A.normal).plus(across.times(A.cross));
    };
    // The far side of a cell takes Σ V P_i1 η or Σ V P_i2 ξ, the near side what is left of Σ V P.
    const Four shear = H_y[0].of_1.plus(H_x[1].of_1).times(A.shear);
    const std::array far_x = {normal_stress(H_x[0].of_eta, H_y[1].of_eta, M_y).times(per_x),
                              H_y[0].of_eta.plus(H_x[1].of_eta).times(A.shear).times(per_x)};
    const std::array far_y = {H_y[0].of_xi.plus(H_x[1].of_xi).times(A.shear).times(per_y),
                              normal_stress(H_y[1].of_xi, H_x[0].of_xi, M_x).times(per_y)};
    const std::array near_x = {normal_stress(H_x[0].of_1, H_y[1].of_1, M).times(per_x).minus(far_x[0]),
                               shear.times(per_x).minus(far_x[1])};
    const std::array near_y = {shear.times(per_y).minus(far_y[0]),
                               normal_stress(H_y[1].of_1, H_x[0].of_1, M).times(per_y).minus(far_y[1])};
    std::array<Four, 4> below, above;  // of both corners, x and y
    unroll<2>([&](auto i) __attribute__((always_inline)) {
      below[i] = near_x[i].plus(near_y[i]).times(-1);
      below[2 + i] = near_x[i].minus(far_y[i]);
      above[i] = near_y[i].minus(far_x[i]);
      above[2 + i] = far_x[i].plus(far_y[i]);
    });
    const auto of_below = transposed(below), of_above = transposed(above);
    Four bad{};
    unroll<lanes>([&](auto lane) __attribute__((always_inline)) {
      constexpr std::size_t q = lane;
      if (q >= count) return;
      of_below[q].store(corner + 8 * q);
      of_above[q].store(corner + 8 * q + 4);
      bad = bad.plus(of_below[q].plus(of_above[q]).times(0));
    });
    return bad[0] + bad[1] + bad[2] + bad[3];
  }

  const MaterialPoints<2>* points_ = nullptr;
  const Weights* weights_ = nullptr;
  std::vector<Moduli> moduli_;
  bool shares_dilatation_ = false;
  std::array<std::vector<double>, 6> moments_;  // Σ V (1, ξ, η, ξ², ξη, η²) of each cell, with slack [m³]
  std::array<std::vector<double>, 2> inverse_side_;  // [1/m]
};

}  // namespace stillpoint
