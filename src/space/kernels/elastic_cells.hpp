// Internal forces of linear elastic material in bilinear and trilinear cells, from moments of their points.
//
// With positions ξ from 0 to 1 in a cell whose sides are 1/q_j, and products of different coordinates x_m = Π_{d ∈ m}
// ξ_d, m a set of axes, the displacement in a cell, whose corner a is at 1 along the axes in a, is
//
// so that with constant moduli A and small strain the sums that give the forces at the corners,
//
//   T_ij[m] = Σ_p V_p P_ij x_m = A : Σ_p V_p H x_m,
//   G_ij[m] = Σ_p V_p H_ij x_m = Σ_n q_j c_{n ∪ j, i} Σ_p V_p x_n x_m,
//
// depend on the points only through the moments Σ_p V_p x_n x_m: 6 numbers in the plane, 23 in space. The cost of a
// cell does not depend on its number of points. The force conjugate to c_m, f_m = Σ_{j ∈ m} q_j T_ij[m \ j], goes to
// the corners by the transpose of the sum that gives c_m.
//
// An isotropic law has P_ii = (A_n − A_c) H_ii + A_c tr H and P_ij = A_s (H_ij + H_ji). If the points of a cell share
// their change of volume, see MeanDilatation, t̄ = Σ V_p tr H_p/Σ V_p takes the place of tr H, without further terms:
// a_p = κ V_p t̄, so that the law's V P̄ is V P.
#pragma once

#include <stillpoint/unroll.hpp>

#include <array>
#include <cstddef>
#include <vector>

#include "base/lanes.hpp"
#include "space/kernels/point_weights.hpp"

namespace stillpoint {

template <int Dim>
class ElasticCells {
  static_assert(Dim == 2 || Dim == 3);
  static constexpr Kinematics K = Dim == 2 ? Kinematics::plane : Kinematics::space;

 public:
  using Weights = PointWeights<BSpline<1>, K>;
  /// The moduli of an isotropic law: P_xx = normal H_xx + cross (H_yy + …), P_xy = P_yx = shear (H_xy + H_yx) [Pa].
  struct Moduli {
    double normal, cross, shear;
  };

  /// Computes the moments for a phase of these points and weights, which must outlive it. moduli: of each material.
  /// shares_dilatation: whether the points of a cell share their change of volume.
  void rebuild(const MaterialPoints<Dim>& points, const Weights& weights, std::vector<Moduli> moduli,
               bool shares_dilatation) {
    points_ = &points;
    weights_ = &weights;
    moduli_ = std::move(moduli);
    shares_dilatation_ = shares_dilatation;
    for (auto& moment : moments_) moment.resize(points.cells() + slack);
    for (auto& per_side : inverse_side_) per_side.resize(points.cells() + slack);
    for_each_block(points.cells(), [&](std::size_t k) {
      std::array<double, kMoments> sum{};
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        std::array<std::array<double, 3>, Dim> power;  // 1, ξ, ξ²
        for (int d = 0; d < Dim; ++d) {
          const double xi = weights.position_in_cell(static_cast<std::size_t>(d), k, p);
          power[d] = {1, xi, xi * xi};
        }
        for (int e = 0; e < kExponents; ++e) {
          if (kMomentOf[e] < 0) continue;
          double product = points.volume[p];
          for (int d = 0; d < Dim; ++d) product *= power[d][exponent(e, d)];
          sum[static_cast<std::size_t>(kMomentOf[e])] += product;
        }
      }
      for (std::size_t m = 0; m < sum.size(); ++m) moments_[m][k] = sum[m];
      for (std::size_t d = 0; d < Dim; ++d) inverse_side_[d][k] = weights.cell(k).inverse_side[d];
    });
  }
  bool empty() const { return moduli_.empty(); }
  double bytes() const { return bytes_per_cell * static_cast<double>(points_->cells()); }

  /// Sets corner[kCorners Dim k + Dim a + i], the force of cell k at its corner a, for the cells begin … end − 1. u:
  /// over the grid's functions. Returns 0, or NaN if a force is not finite.
  double forces(const double* u, std::size_t begin, std::size_t end, double* corner) const {
    return shares_dilatation_ ? forces_of_cells<true>(u, begin, end, corner)
                              : forces_of_cells<false>(u, begin, end, corner);
  }

 private:
  static constexpr int kCorners = 1 << Dim;             // number of corners, and of sets of axes, as bits
  static constexpr int kExponents = Dim == 2 ? 9 : 27;  // exponents 0 to 2 of each ξ_d, as digits to the base of 3
  static constexpr int exponent(int e, int d) { return e / power(3, d) % 3; }
  static constexpr bool has(int set, int axis) { return (set >> axis & 1) != 0; }
  static constexpr int exponents_of(int m, int n) {  // exponents of x_m x_n
    int e = 0;
    for (int d = Dim - 1; d >= 0; --d) e = 3 * e + has(m, d) + has(n, d);
    return e;
  }
  // The index of each moment, of x_n x_m where n lacks an axis, and m does; −1: not needed.
  static constexpr auto kMomentOf = [] {
    std::array<int, kExponents> number{};
    for (int& of : number) of = -1;
    for (int m = 0; m < kCorners - 1; ++m) {
      for (int n = 0; n < kCorners - 1; ++n) number[exponents_of(m, n)] = 0;
    }
    int next = 0;
    for (int& of : number) {
      if (of == 0) of = next++;
    }
    return number;
  }();
  static constexpr std::size_t kMoments = [] {
    std::size_t count = 0;
    for (const int of : kMomentOf) count += of >= 0;
    return count;
  }();

 public:
  static constexpr double bytes_per_cell = (kMoments + Dim) * sizeof(double);

 private:
  static constexpr int lanes = Dim == 2 ? 4 : 8;  // number of cells at a time
  static constexpr std::size_t slack = lanes - 1;
  using Lane = Lanes<lanes>;
  using PerCorner = std::array<std::array<Lane, Dim>, kCorners>;

  template <bool Shared>
  double forces_of_cells(const double* u, std::size_t begin, std::size_t end, double* corner) const {
    double bad = 0;
    for (std::size_t first = begin; first < end;) {
      std::size_t last = first + 1;
      const int material = points_->material_of_cell(first);
      while (last < end && last - first < lanes && points_->material_of_cell(last) == material) ++last;
      const Moduli& moduli = moduli_[static_cast<std::size_t>(material)];
      PerCorner c = displacements(u, first, last - first);
      forces_of<Shared>(moduli, first, c);
      bad += store(c, last - first, corner + kCorners * Dim * first);
      first = last;
    }
    return bad;
  }

  /// c: the displacements of the corners of cells from the first on; on return the forces on them.
  template <bool Shared>
  [[gnu::always_inline]] void forces_of(const Moduli& A, std::size_t first, PerCorner& c) const {
    std::array<Lane, Dim> q;
    unroll<Dim>([&](auto d) __attribute__((always_inline)) { q[d] = Lane::load(&inverse_side_[d][first]); });
    const auto moment = [&](auto m, auto n) __attribute__((always_inline)) {
      return Lane::load(&moments_[kMomentOf[exponents_of(m, n)]][first]);
    };
    // The coefficients c_m from the corners.
    unroll<Dim>([&](auto d) __attribute__((always_inline)) {
      unroll<kCorners>([&](auto m) __attribute__((always_inline)) {
        if constexpr (has(m, d)) subtract(c[m ^ (1 << d)], c[m]);
      });
    });
    std::array<std::array<std::array<Lane, kCorners>, Dim>, Dim> H;  // coefficient of x_n at [i][j][n], n without j
    unroll<Dim * Dim>([&](auto ij) __attribute__((always_inline)) {
      constexpr int i = ij / Dim, j = ij % Dim;
      unroll<kCorners>([&](auto n) __attribute__((always_inline)) {
        if constexpr (!has(n, j)) H[i][j][n] = c[n | (1 << j)][i].times(q[j]);
      });
    });
    const auto G = [&](auto i, auto j, auto m) __attribute__((always_inline)) {
      Lane sum{};
      unroll<kCorners>([&](auto n) __attribute__((always_inline)) {
        if constexpr (!has(n, j)) sum = sum.plus_product(H[i][j][n], moment(m, n));
      });
      return sum;
    };
    PerCorner f{};
    const auto add = [&](auto i, auto j, auto m, const Lane& T) __attribute__((always_inline)) {
      f[m | (1 << j)][i] = f[m | (1 << j)][i].plus_product(q[j], T);
    };
    Lane pressure{};  // κ t̄
    unroll<kCorners - 1>([&](auto m) __attribute__((always_inline)) {
      std::array<Lane, Dim> of_axis;
      Lane trace{};
      unroll<Dim>([&](auto k) __attribute__((always_inline)) { trace = trace.plus(of_axis[k] = G(k, k, m)); });
      const double spherical = Shared ? -(A.normal - A.cross) / Dim : A.cross;
      Lane of_all = trace.times(spherical);
      if constexpr (Shared) {
        const Lane volume = moment(std::integral_constant<int, 0>{}, m);
        if constexpr (m == 0) pressure = trace.over(volume).times((A.normal + (Dim - 1) * A.cross) / Dim);
        of_all = of_all.plus_product(pressure, volume);
      }
      unroll<Dim>([&](auto i) __attribute__((always_inline)) {
        if constexpr (!has(m, i)) add(i, i, m, of_all.plus(of_axis[i].times(A.normal - A.cross)));
      });
    });
    unroll<Dim * Dim>([&](auto ij) __attribute__((always_inline)) {
      constexpr int i = ij / Dim, j = ij % Dim;
      if constexpr (i < j) {
        using I = std::integral_constant<int, i>;
        using J = std::integral_constant<int, j>;
        unroll<kCorners>([&](auto m) __attribute__((always_inline)) {
          if constexpr (has(m, i) && has(m, j)) return;
          const Lane T = G(I{}, J{}, m).plus(G(J{}, I{}, m)).times(A.shear);
          if constexpr (!has(m, j)) add(I{}, J{}, m, T);
          if constexpr (!has(m, i)) add(J{}, I{}, m, T);
        });
      }
    });
    // The forces f_m to the corners.
    unroll<Dim>([&](auto d) __attribute__((always_inline)) {
      unroll<kCorners>([&](auto m) __attribute__((always_inline)) {
        if constexpr (has(m, d)) subtract(f[m], f[m ^ (1 << d)]);
      });
    });
    c = f;
  }
  [[gnu::always_inline]] static void subtract(const std::array<Lane, Dim>& what, std::array<Lane, Dim>& from) {
    unroll<Dim>([&](auto i) __attribute__((always_inline)) { from[i] = from[i].minus(what[i]); });
  }

  // The components of two corners that are neighbours along x are contiguous: four numbers in the plane, and in space
  // six, of which two are loaded twice.
  static constexpr int kFours = Dim - 1, kStep = 2;

  // The displacements of the corners of `count` cells; lanes past the last cell repeat those of the first.
  [[gnu::always_inline]] PerCorner displacements(const double* u, std::size_t first, std::size_t count) const {
    PerCorner at;
    unroll<kCorners / 2>([&](auto pair) __attribute__((always_inline)) {
      std::array<const double*, lanes> of_cell;
      unroll<lanes>([&](auto lane) __attribute__((always_inline)) {
        constexpr std::size_t q = lane;
        const std::size_t k = first + (q < count ? q : 0);
        of_cell[q] = u + Dim * static_cast<std::ptrdiff_t>(weights_->function(k, 2 * pair));
      });
      unroll<kFours>([&](auto four) __attribute__((always_inline)) {
        const auto columns = transposed_rows([&](auto lane) __attribute__((always_inline)) {
          return Lanes<4>::load(of_cell[lane] + kStep * four);
        });
        unroll<4>([&](auto s) __attribute__((always_inline)) {
          constexpr int component = kStep * four + s;
          at[2 * pair + component / Dim][component % Dim] = columns[s];
        });
      });
    });
    return at;
  }
  template <class Row>
  [[gnu::always_inline]] static std::array<Lane, 4> transposed_rows(const Row& row) {
    const auto four = [&](auto half) __attribute__((always_inline)) {
      return transposed({row(std::integral_constant<int, 4 * half>{}), row(std::integral_constant<int, 4 * half + 1>{}),
                         row(std::integral_constant<int, 4 * half + 2>{}),
                         row(std::integral_constant<int, 4 * half + 3>{})});
    };
    const auto lower = four(std::integral_constant<int, 0>{});
    if constexpr (lanes == 4) {
      return lower;
    } else {
      const auto upper = four(std::integral_constant<int, 1>{});
      return {joined(lower[0], upper[0]), joined(lower[1], upper[1]), joined(lower[2], upper[2]),
              joined(lower[3], upper[3])};
    }
  }
  // Stores the forces. Returns 0, or NaN if a force is not finite.
  [[gnu::always_inline]] static double store(const PerCorner& force, std::size_t count, double* corner) {
    Lanes<4> bad{};
    unroll<kCorners * Dim / 4>([&](auto four) __attribute__((always_inline)) {
      std::array<Lane, 4> column;
      unroll<4>([&](auto s) __attribute__((always_inline)) {
        constexpr int entry = 4 * four + s;
        column[s] = force[entry / Dim][entry % Dim];
      });
      unroll<lanes / 4>([&](auto half) __attribute__((always_inline)) {
        std::array<Lanes<4>, 4> of_half;
        unroll<4>([&](auto s) __attribute__((always_inline)) { of_half[s] = four_lanes<half()>(column[s]); });
        const auto rows = transposed(of_half);
        unroll<4>([&](auto r) __attribute__((always_inline)) {
          constexpr std::size_t lane = 4 * half + r;
          if (lane >= count) return;
          rows[r].store(corner + kCorners * Dim * lane + 4 * four);
          bad = bad.plus(rows[r].times(0));
        });
      });
    });
    return bad[0] + bad[1] + bad[2] + bad[3];
  }
  template <int Half>
  [[gnu::always_inline]] static Lanes<4> four_lanes(const Lane& all) {
    if constexpr (lanes == 4) {
      return all;
    } else if constexpr (Half == 0) {
      return lower_half(all);
    } else {
      return upper_half(all);
    }
  }

  const MaterialPoints<Dim>* points_ = nullptr;
  const Weights* weights_ = nullptr;
  std::vector<Moduli> moduli_;
  bool shares_dilatation_ = false;
  std::array<std::vector<double>, kMoments> moments_;  // moments of each cell, with slack [m³]
  std::array<std::vector<double>, Dim> inverse_side_;  // [1/m]
};

}  // namespace stillpoint
