// A least-squares fit of the grid's functions to values at material points, and to their gradients where known:
//
//   min_z  Σ_p m_p (|Σ_a N_ap z_a − w_p|² + β Σ_j h_j² |Σ_a z_a ∂N_ap/∂x_j − g_pj|²),   h_j the cell's sides
//
// by conjugate gradients on the normal equations, scaled by their diagonal. The gradients determine what the values
// leave open: a function that the body hardly reaches has N next to nothing at its points, but ∇N much larger. The
// start is Σ_p m_p N_ip (w_p + g_p (x_i − x_p))/m_i with the functions' centres x_i, exact where w is linear in x, so
// that few iterations are needed. The result has the same bits for any number of threads; one thread at a time makes
// it.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "space/kernels/nodal_sum.hpp"

namespace stillpoint {

/// The values to fit at P points, in their present order.
template <int Components, int Dim>
struct PointValues {
  std::vector<std::array<double, Components>> value;  // w_p
  // g_p, ∂w_i/∂x_j at [Dim i + j] [1/m]; empty: not known, taken as 0.
  std::vector<std::array<double, Components * Dim>> gradient;
  std::vector<double> mass;  // m_p, 0 at points that are left out
};

struct PointFitOptions {
  double gradient_share = 0.1;  // β; 0: gradients do not count
  double tolerance = 0;         // error of the fit, at most about this, in the unit of the values
  int iterations = 10;          // at most
};

template <int Components, AxisBasis B, Kinematics K>
class PointFit {
  using Weights = PointWeights<B, K>;
  static constexpr int dim = Weights::dim, per_cell = Weights::per_cell;
  using Corner = Corners<Components, per_cell>;

 public:
  using Values = PointValues<Components, dim>;
  using Options = PointFitOptions;

  PointFit(const Grid<dim>& grid, const MaterialPoints<dim>& points, const Weights& weights,
           const CornerSum& corner_sum, const Values& values, const Options& options)
      : grid_(grid), points_(points), weights_(weights), corner_sum_(corner_sum), values_(values), options_(options) {}

  /// The coefficients z, component i at [Components function + i]. Where held, (functions × Components) or empty, is
  /// not 0, z is 0.
  std::vector<double> solve(const std::vector<char>& held) const {
    std::vector<double> z = start();
    std::vector<double> inverse = inverse_diagonal();
    for (std::size_t k = 0; k < held.size(); ++k) {
      if (held[k]) z[k] = inverse[k] = 0;
    }
    std::vector<double> r = residual(z), p(z.size(), 0.0);
    const double all_mass =
        sum_over_ranks(corner_sum_.ranks(), values_.mass.size(), [&](std::size_t q) { return values_.mass[q]; });
    const double enough = options_.tolerance * options_.tolerance * all_mass;
    double before = 1;
    for (int k = 0; k < options_.iterations; ++k) {
      const double now = sum_over(r.size(), [&](std::size_t i) { return r[i] * inverse[i] * r[i]; });
      if (!(now > enough)) break;
      const double turn = k > 0 ? now / before : 0;
      for_each_index(p.size(), [&, P = p.data()](std::size_t i) { P[i] = inverse[i] * r[i] + turn * P[i]; });
      const std::vector<double> Ap = apply(p);
      const double pAp = sum_over(p.size(), [&](std::size_t i) { return p[i] * Ap[i]; });
      if (!(pAp > 0)) break;
      const double length = now / pAp;
      for_each_index(p.size(), [&, Z = z.data(), R = r.data()](std::size_t i) {
        Z[i] += length * p[i];
        R[i] -= length * Ap[i];
      });
      before = now;
    }
    return z;
  }

  /// The fitted value Σ_a N_ap z_a at point p of occupied cell k.
  std::array<double, Components> value(const std::vector<double>& z, std::size_t k, std::size_t p) const {
    const auto N = weights_.N(k, p);
    std::array<double, Components> sum{};
    for (int a = 0; a < per_cell; ++a) {
      const double* of_function = z.data() + Components * weights_.function(k, a);
      for (int i = 0; i < Components; ++i) sum[i] += N[a] * of_function[i];
    }
    return sum;
  }

 private:
  // β h_j² of occupied cell k [m²].
  std::array<double, dim> gradient_weights(std::size_t k) const {
    const auto cell = grid_.cell_at(points_.cell[k]);
    std::array<double, dim> weights;
    for (int d = 0; d < dim; ++d) {
      const double h = grid_.axes[d].scale_at(cell[d]);
      weights[d] = options_.gradient_share * h * h;
    }
    return weights;
  }
  std::array<double, Components * dim> known_gradient(std::size_t p) const {
    return values_.gradient.empty() ? std::array<double, Components * dim>{} : values_.gradient[p];
  }
  // The fitted gradient Σ_a z_a ∂N_ap/∂x_j, component i at [dim i + j].
  std::array<double, Components * dim> gradient(const std::vector<double>& z, std::size_t k, std::size_t p) const {
    const auto dN = weights_.dN(k, p);
    std::array<double, Components * dim> sum{};
    for (int a = 0; a < per_cell; ++a) {
      const double* of_function = z.data() + Components * weights_.function(k, a);
      for (int i = 0; i < Components; ++i) {
        for (int j = 0; j < dim; ++j) sum[dim * i + j] += of_function[i] * dN[per_cell * j + a];
      }
    }
    return sum;
  }

  // The moments Σ_p m_p (N_ap value + β Σ_j h_j² ∂N_ap/∂x_j gradient_j) of value_at(k, p) and, unless β is 0,
  // gradient_at(k, p).
  template <class ValueAt, class GradientAt>
  std::vector<double> moments(const ValueAt& value_at, const GradientAt& gradient_at) const {
    const bool by_gradients = options_.gradient_share > 0;
    const auto add_cell = [&](std::size_t k, Corner& corner) {
      const std::array<double, dim> gradient_weight = gradient_weights(k);
      for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) {
        const double m = values_.mass[p];
        if (m == 0) continue;
        const auto N = weights_.N(k, p);
        const auto w = value_at(k, p);
        if (!by_gradients) {
          for (int a = 0; a < per_cell; ++a) {
            for (int i = 0; i < Components; ++i) corner[Components * a + i] += m * (N[a] * w[i]);
          }
          continue;
        }
        const auto dN = weights_.dN(k, p);
        const auto g = gradient_at(k, p);
        for (int a = 0; a < per_cell; ++a) {
          for (int i = 0; i < Components; ++i) {
            double share = N[a] * w[i];
            for (int j = 0; j < dim; ++j) share += gradient_weight[j] * dN[per_cell * j + a] * g[dim * i + j];
            corner[Components * a + i] += m * share;
          }
        }
      }
    };
    return nodal_sum<Components>(points_, weights_, corner_sum_, add_cell, of_corners_);
  }
  std::vector<double> apply(const std::vector<double>& z) const {
    return moments([&](std::size_t k, std::size_t p) { return value(z, k, p); },
                   [&](std::size_t k, std::size_t p) { return gradient(z, k, p); });
  }
  std::vector<double> residual(const std::vector<double>& z) const {
    const auto minus = [](auto a, const auto& b) {
      for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
      return a;
    };
    return moments([&](std::size_t k, std::size_t p) { return minus(values_.value[p], value(z, k, p)); },
                   [&](std::size_t k, std::size_t p) { return minus(known_gradient(p), gradient(z, k, p)); });
  }

  // The sums Σ_p m_p term(N_ip, β Σ_j h_j² (∂N_ip/∂x_j)²), (functions).
  template <class Term>
  std::vector<double> sums(const Term& term) const {
    return nodal_sum<1>(points_, weights_, corner_sum_, [&](std::size_t k, Corners<1, per_cell>& corner) {
      const std::array<double, dim> gradient_weight = gradient_weights(k);
      for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) {
        const auto N = weights_.N(k, p);
        const auto dN = weights_.dN(k, p);
        for (int a = 0; a < per_cell; ++a) {
          double slope = 0;
          for (int j = 0; j < dim; ++j) slope += gradient_weight[j] * dN[per_cell * j + a] * dN[per_cell * j + a];
          corner[a] += values_.mass[p] * term(N[a], slope);
        }
      }
    });
  }
  // The inverse of the diagonal Σ_p m_p (N_ip² + β Σ_j h_j² (∂N_ip/∂x_j)²); 0 where that is 0.
  std::vector<double> inverse_diagonal() const {
    const std::vector<double> diagonal = sums([](double N, double slope) { return N * N + slope; });
    std::vector<double> inverse(Components * diagonal.size());
    for (std::size_t i = 0; i < inverse.size(); ++i) {
      const double of_function = diagonal[i / Components];
      inverse[i] = of_function > 0 ? 1 / of_function : 0;
    }
    return inverse;
  }

  // The start Σ_p m_p N_ip (w_p + g_p (x_i − x_p))/m_i.
  std::vector<double> start() const {
    std::vector<double> z = nodal_sum<Components>(points_, weights_, corner_sum_, [&](std::size_t k, Corner& corner) {
      const auto centre = centres(points_.cell[k]);
      for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) {
        if (values_.mass[p] == 0) continue;
        const auto N = weights_.N(k, p);
        const Point<dim> x = points_.position(p);
        const auto g = known_gradient(p);
        for (int a = 0; a < per_cell; ++a) {
          for (int i = 0; i < Components; ++i) {
            double w = values_.value[p][i];
            for (int j = 0; j < dim; ++j) w += g[dim * i + j] * (centre[j][a] - x[j]);
            corner[Components * a + i] += values_.mass[p] * N[a] * w;
          }
        }
      }
    });
    const std::vector<double> mass = sums([](double N, double) { return N; });
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = mass[k / Components] > 0 ? z[k] / mass[k / Components] : 0;
    return z;
  }

  // The centres x_i with Σ_i N_i(x) x_i = x: the mean of a function's inner knots.
  std::array<std::array<double, per_cell>, dim> centres(int cell_number) const {
    std::array<std::array<double, per_cell>, dim> of_cell{};
    if constexpr (B::partition_of_unity) {
      const auto cell = grid_.cell_at(cell_number);
      for (int d = 0; d < dim; ++d) {
        const Axis& axis = grid_.axes[d];
        for (int a = 0; a < per_cell; ++a) {
          const int last = B::first(cell[d]) + TensorBasis<B, dim>::axis_index(a, d);
          for (int q = last - B::degree + 1; q <= last; ++q)
            of_cell[d][a] += axis.nodes[static_cast<std::size_t>(std::clamp(q, 0, axis.cells()))] / B::degree;
        }
      }
    }
    return of_cell;
  }

  const Grid<dim>& grid_;
  const MaterialPoints<dim>& points_;
  const Weights& weights_;
  const CornerSum& corner_sum_;
  const Values& values_;
  Options options_;
  mutable std::vector<double> of_corners_;  // work space of the sums
};

}  // namespace stillpoint
