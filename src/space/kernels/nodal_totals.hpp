// The sums over material points at the grid's functions when a phase begins, formed in the pass over the cells that
// makes the weights, while these are in the first-level cache:
//
//   mass              m_i = Σ_p m_p N_ip; if the basis is no partition of unity, cell by cell the diagonal of the
//                     consistent mass, Σ_p m_p N_ip², scaled so that its values (not its slopes) sum to the cell's mass
//                     [Hinton, Rock, Zienkiewicz 1976]
//   stiffness bound   G_i = Σ_p V_p A_p |∇N_ip| Σ_j |∇N_jp|, see stiffness_bound()
//   momentum          Σ_p m_p N_ip v_p, of a body that moves on from phase to phase
//
// Either mass conserves the mass of each cell.
#pragma once

#include <stillpoint/unroll.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/lanes.hpp"
#include "base/parallel_loop.hpp"
#include "space/kernels/nodal_sum.hpp"
#include "space/kernels/trilinear.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class NodalTotals {
  using Weights = PointWeights<B, K>;
  static constexpr int dim = Weights::dim;
  static constexpr int per_cell = Weights::per_cell;
  static constexpr int rows = Weights::rows;
  static constexpr int terms = 2 + dim;  // m, G and m v
  static constexpr bool is_trilinear = Weights::from_positions && dim == 3;
  using Points = MaterialPoints<dim>;

 public:
  /// Makes the weights, and the sums of each cell's points at its corners. wave_modulus: λ + 2μ of each material [Pa].
  void begin(const Grid<dim>& grid, const Points& points, Weights& weights, const std::vector<double>& wave_modulus) {
    of_corners_.resize(terms * per_cell * points.cells() + CornerSum::slack);
    moves_ = !points.v[0].empty();
    weights.rebuild(grid, points, [&](std::size_t k) {
      const double A = wave_modulus[static_cast<std::size_t>(points.material_of_cell(k))];
      add_points(points, weights, k, A, of_corners_.data() + terms * per_cell * k);
    });
  }
  /// Sums the corners at the functions.
  void sum(const CornerSum& corner_sum) {
    const std::size_t functions = corner_sum.functions();
    mass_.assign(functions, 0);
    bound_.assign(functions, 0);
    momentum_.assign(dim * functions, 0);
    of_corners_.resize(terms * corner_sum.corners() + CornerSum::slack);
    corner_sum.for_functions(of_corners_.data(), terms, [&](std::size_t f) {
      const auto total = corner_sum.sum<terms>(f, of_corners_.data());
      mass_[f] = total[0];
      bound_[f] = total[1];
      for (int i = 0; i < dim; ++i) momentum_[dim * f + i] = total[2 + i];
    });
    corner_sum.complete(mass_.data(), 1);
    corner_sum.complete(bound_.data(), 1);
    corner_sum.complete(momentum_.data(), dim);
    if (!moves_) of_corners_ = std::vector<double>();  // there is no other phase
  }

  const std::vector<double>& mass() const { return mass_; }          // (functions) [kg]
  const std::vector<double>& bound() const { return bound_; }        // (functions) [N/m]
  const std::vector<double>& momentum() const { return momentum_; }  // (functions × dim) [kg m/s]; 0 if at rest
  /// Whether a point gives a function mass or stiffness: at a grid line the functions across the next cell have
  /// gradients.
  bool reaches(std::size_t function) const { return mass_[function] != 0 || bound_[function] != 0; }

 private:
  // Local functions are taken a few at a time.
  static constexpr int lanes = 4, chunks = (per_cell + lanes - 1) / lanes;
  using Some = Lanes<lanes>;
  using OfFunctions = std::array<Some, static_cast<std::size_t>(chunks)>;  // zeros past the last function
  static constexpr std::size_t in_last = per_cell - lanes * (chunks - 1);

  // The values N_a and |∇N_a|² at a point.
  struct Functions {
    OfFunctions N, square;
  };
  [[gnu::always_inline]] static Functions functions(const Weights& weights, std::size_t k, std::size_t p) {
    Functions at;
    if constexpr (Weights::from_positions && dim == 2) {
      // N = (1 − ξ, ξ, 1 − ξ, ξ) (1 − η, 1 − η, η, η), and gradients lack the factor along their axis
      const auto& cell = weights.cell(k);
      const double xi = weights.position_in_cell(0)[p], eta = weights.position_in_cell(1)[p];
      const Some along_x = Some{{1, 0, 1, 0}}.plus_product(Some{{-1, 1, -1, 1}}, Some{{xi, xi, xi, xi}});
      const Some along_y = Some{{1, 1, 0, 0}}.plus_product(Some{{-1, -1, 1, 1}}, Some{{eta, eta, eta, eta}});
      at.N[0] = along_x.times(along_y);
      const Some by_x = along_y.times(cell.inverse_side[0]), by_y = along_x.times(cell.inverse_side[1]);
      at.square[0] = by_x.times(by_x).plus_product(by_y, by_y);
      if constexpr (rows > dim) {
        const Some hoop = at.N[0].over(cell.left[0] + xi * cell.side[0]);
        at.square[0] = at.square[0].plus_product(hoop, hoop);
      }
    } else {
      const auto N = weights.N(k, p);
      const auto dN = weights.dN(k, p);
      unroll<chunks>([&](auto c) __attribute__((always_inline)) {
        at.N[c] = load<c>(&N[0]);
        at.square[c] = Some{};
        unroll<rows>([&](auto j) __attribute__((always_inline)) {
          const Some along = load<c>(&dN[per_cell * j]);
          at.square[c] = at.square[c].plus_product(along, along);
        });
      });
    }
    return at;
  }
  template <int Chunk>
  [[gnu::always_inline]] static Some load(const double* of_functions) {
    return Some::load_first(of_functions + lanes * Chunk, Chunk + 1 < chunks ? lanes : in_last);
  }

  // The sums of a trilinear cell, eight points at a time, each a product of positive factors: a function that its
  // points hardly reach has a small mass with all its digits.
  void add_points_of_trilinear_cell(const Points& points, const Weights& weights, std::size_t k, double A,
                                    double* corners) const requires(is_trilinear) {
    using Eight = Lanes<8>;
    const auto& cell = weights.cell(k);
    std::array<Some, per_cell> inertia{};    // m and m v at each corner
    std::array<Some, per_cell / 4> bound{};  // G at four corners each
    const std::size_t end = points.end(k);
    for (std::size_t p = points.begin(k); p < end; p += Trilinear::lanes) {
      const std::size_t count = end - p;
      const auto row = [&](const std::vector<double>& values) __attribute__((always_inline)) {
        return Eight::load_first(values.data() + p, count);
      };
      const Eight m = row(points.mass);
      std::array<Eight, dim> momentum{};
      if (moves_) unroll<dim>([&](auto i) __attribute__((always_inline)) { momentum[i] = m.times(row(points.v[i])); });
      // [d][upper]: the factor 1 − ξ_d or ξ_d, and its square
      std::array<std::array<Eight, 2>, dim> factor, square;
      unroll<dim>([&](auto d) __attribute__((always_inline)) {
        factor[d][1] = weights.eight_from_corner(d, k, p).times(cell.inverse_side[d]);
        factor[d][0] = factor[d][1].times(-1).plus(1);
        unroll<2>([&](auto upper)
                      __attribute__((always_inline)) { square[d][upper] = factor[d][upper].times(factor[d][upper]); });
      });
      std::array<Eight, per_cell> length;  // |∇N_a|
      Eight together{};
      unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
        constexpr int i = a & 1, j = a >> 1 & 1, l = a >> 2;
        const auto along = [&](int d, const Eight& e, const Eight& f) __attribute__((always_inline)) {
          const double per_side = cell.inverse_side[static_cast<std::size_t>(d)];
          return e.times(f).times(per_side * per_side);
        };
        length[a] = along(0, square[1][j], square[2][l])
                        .plus(along(1, square[0][i], square[2][l]))
                        .plus(along(2, square[0][i], square[1][j]))
                        .root();
        together = together.plus(length[a]);
        const Eight N = factor[0][i].times(factor[1][j]).times(factor[2][l]);
        const auto sum = [&](const Eight& of_points) __attribute__((always_inline)) {
          return halves_added(N.times(of_points));
        };
        inertia[a] = inertia[a].plus(sums(sum(m), sum(momentum[0]), sum(momentum[1]), sum(momentum[2])));
      });
      const Eight G = row(points.volume).times(A).times(together);
      unroll<per_cell / 4>([&](auto four) __attribute__((always_inline)) {
        const auto sum = [&](int a) __attribute__((always_inline)) {
          return halves_added(G.times(length[4 * four + a]));
        };
        bound[four] = bound[four].plus(sums(sum(0), sum(1), sum(2), sum(3)));
      });
    }
    for (int a = 0; a < per_cell; ++a) {
      corners[terms * a] = inertia[a][0];
      corners[terms * a + 1] = bound[a / 4][a % 4];
      for (int i = 0; i < dim; ++i) corners[terms * a + 2 + i] = inertia[a][1 + i];
    }
  }

  // Sums over the cell's points at its corners, (per_cell × terms).
  void add_points(const Points& points, const Weights& weights, std::size_t k, double A, double* corners) const {
    if constexpr (is_trilinear) {
      add_points_of_trilinear_cell(points, weights, k, A, corners);
      return;
    }
    std::array<OfFunctions, terms> sum{};
    [[maybe_unused]] double cell_mass = 0;
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      const Functions at = functions(weights, k, p);
      const double m = points.mass[p];
      OfFunctions length;
      Some together{};
      unroll<chunks>([&](auto c) __attribute__((always_inline)) {
        length[c] = at.square[c].root();
        together = together.plus(length[c]);
      });
      const double G = points.volume[p] * A * (together[0] + together[1] + (together[2] + together[3]));
      unroll<chunks>([&](auto c) __attribute__((always_inline)) {
        sum[0][c].add(m, B::partition_of_unity ? at.N[c] : at.N[c].times(at.N[c]));
        sum[1][c].add(G, length[c]);
      });
      if constexpr (!B::partition_of_unity) cell_mass += m;
      if (!moves_) continue;
      unroll<dim>([&](auto i) __attribute__((always_inline)) {
        const double momentum = m * points.v[i][p];
        unroll<chunks>([&](auto c) __attribute__((always_inline)) { sum[2 + i][c].add(momentum, at.N[c]); });
      });
    }
    if constexpr (terms == lanes) {
      unroll<chunks>([&](auto c) __attribute__((always_inline)) {
        const auto of_corner = transposed({sum[0][c], sum[1][c], sum[2][c], sum[3][c]});
        unroll<(c + 1 < chunks ? lanes : static_cast<int>(in_last))>([&](auto a) __attribute__((always_inline)) {
          of_corner[a].store(corners + terms * (lanes * c + a));
        });
      });
    } else {
      for (int a = 0; a < per_cell; ++a) {
        for (int term = 0; term < terms; ++term) corners[terms * a + term] = sum[term][a / lanes][a % lanes];
      }
    }
    if constexpr (!B::partition_of_unity) {
      double of_values = 0;
      for (int a = 0; a < per_cell; ++a) of_values += Weights::Basis::is_value(a) ? corners[terms * a] : 0;
      for (int a = 0; a < per_cell; ++a) corners[terms * a] *= cell_mass / of_values;
    }
  }

  bool moves_ = false;
  std::vector<double> of_corners_;  // (cells × per_cell × terms)
  std::vector<double> mass_, bound_, momentum_;
};

}  // namespace stillpoint
