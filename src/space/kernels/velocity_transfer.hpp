// Velocities from material points to the grid when a phase begins, and back when it ends.
//
//   to the grid    v_i = Σ_p m_p N_ip v_p/m_i,   m_i = Σ_p m_p N_ip             [APIC: N_ip v_p + B_p w_ip]
//   flip           v_p += Σ_i N_ip (v_i − v_i at the start), or a share of it and the rest of Σ_i N_ip v_i
//   pic            v_p  = Σ_i N_ip v_i
//   xpic(m)        v_p  = v_p − (I − S S⁺)^m v_p + Σ_i N_ip (v_i − v_i at the start), S to points, S⁺ to the grid;
//                  whatever m passes of averaging remove is noise [Hammerquist and Nairn 2017]
//   apic           v_p  = Σ_i N_ip v_i,  B_p = Σ_i N_ip v_i ⊗ (x_i − x_p), as they are at the end [Jiang et al. 2015]
//
// x_i is the centre of function i, Σ_i N_i(x) x_i = x; affine_velocity.hpp has B_p and w_ip.
//
// A node at a surface has points on one side only, and their mean velocity is that of a place further inside: a body
// that rotates is strained there at the start of every phase, and loses 3 to 5 % of its angular momentum in a
// revolution. In an undamped motion, flip therefore extrapolates the points' velocities to the node,
//
//   v_i = Σ_p m_p N_ip (v_p + ∇v_p (x_i − x_p))/m_i,   ∇v_p = Σ_j v_j ⊗ ∇N_jp of the means v_j,
//
// with the same sum of momenta, since Σ_i N_ip (x_i − x_p) = 0; and apic begins with the B_p of the same means.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "space/kernels/affine_velocity.hpp"
#include "space/kernels/conservation_check.hpp"
#include "space/kernels/nodal_sum.hpp"
#include "space/kernels/point_motion.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class VelocityTransfer {
  using Weights = PointWeights<B, K>;
  static constexpr int dim = Weights::dim;
  static constexpr int per_cell = Weights::per_cell;
  using Points = MaterialPoints<dim>;
  using Affine = AffineVelocity<B, K>;
  using Centres = typename Affine::Centres;
  using MotionAbout = typename Affine::MotionAbout;

 public:
  /// damped: whether the scene damps its motion, so that conservation in a rotation does not matter. ranks: see Ranks.
  VelocityTransfer(const PhaseSpec& spec, bool damped, const Ranks* ranks = nullptr)
      : spec_(spec), damped_(damped), conservation_(ranks) {}

  /// Prepares B_p of apic's points for a phase: in the first one, where they have velocities v_p alone, from those.
  /// mass: m_i, (functions); momentum: Σ_p m_p N_ip v_p, (functions × dim).
  void begin_phase(const Grid<dim>& grid, Points& points, const Weights& weights, const CornerSum& corner_sum,
                   const std::vector<double>& mass, const std::vector<double>& momentum, bool first) const {
    if (spec_.transfer != Transfer::apic) return;
    if (first && !damped_) begin(grid, points, weights, corner_sum, mass, momentum);
    if constexpr (Affine::carries_gradient) {
      for_each_block(points.cells(), [&](std::size_t k) {
        const Centres centre = Affine::centres(grid, points.cell[k]);
        for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
          const Point<dim> D = Affine::second_moments(weights.N(k, p), centre, points.position(p));
          for (int i = 0; i < dim; ++i) {
            for (int j = 0; j < dim; ++j) points.B_apic[dim * i + j][p] *= D[j];
          }
        }
      });
    }
  }

  /// The nodal velocities v_i from the points, (functions × dim). mass: m_i, (functions); momentum: Σ_p m_p N_ip v_p,
  /// (functions × dim).
  std::vector<double> to_grid(const Grid<dim>& grid, const Points& points, const Weights& weights,
                              const CornerSum& corner_sum, const std::vector<double>& mass,
                              const std::vector<double>& momentum) {
    std::vector<double> v =
        spec_.transfer == Transfer::apic ? affine_momentum(grid, points, weights, corner_sum) : momentum;
    if (spec_.transfer == Transfer::flip && !damped_ && B::partition_of_unity) {
      make_velocity(points, weights, corner_sum, mass, v);
      v = momentum_about(grid, points, weights, corner_sum,
                         [&, mean = std::move(v)](const Centres& centre, std::size_t k, std::size_t p) {
                           return MotionAbout{Affine::velocity_gradient(weights, mean.data(), k, p),
                                              Affine::distances_weighed(weights.N(k, p), centre, points.position(p))};
                         });
    }
    at_start_ = conservation_.of_points(points);
    conservation_.compare_momentum(at_start_, mass.size(), [p = v.data()](std::size_t i) { return p[i]; });
    make_velocity(points, weights, corner_sum, mass, v);
    return v;
  }

  /// Resumes a run in a phase that began with these points.
  void resume(const Points& points) { at_start_ = conservation_.of_points(points); }

  const ConservationCheck<dim>& conservation() const { return conservation_; }
  ConservationCheck<dim>& conservation() { return conservation_; }

  /// Computes the points' positions and velocities at a phase's end, which take effect only with take_velocity(). u,
  /// v_end, v_start: over the grid's functions, (functions × dim); mass: (functions). after(k) is called after occupied
  /// cell k, in parallel.
  template <class After>
  void move(const Points& points, const Weights& weights, const CornerSum& corner_sum, const std::vector<double>& mass,
            const std::vector<double>& u, const std::vector<double>& v_end, const std::vector<double>& v_start,
            const After& after) {
    // v_p⁺ = s v_p + Σ N_ip w_i,  w_i = s (v_i − v_i at the start) + (1 − s) v_i
    const double s = kept_share();
    increment_.resize(v_end.size());
    for_each_index(v_end.size(), [=, w = increment_.data(), now = v_end.data(), before = v_start.data()](
                                     std::size_t i) { w[i] = s * (now[i] - before[i]) + (1 - s) * now[i]; });
    motion_.find(points, weights, u.data(), increment_.data(), s, after);
    if (spec_.transfer == Transfer::xpic) {
      const std::array<std::vector<double>, dim> noise = null_space_part(points, weights, corner_sum, mass);
      for (int i = 0; i < dim; ++i) {
        for_each_index(points.size(), [v = motion_.v[i].data(), r = noise[i].data()](std::size_t p) { v[p] -= r[p]; });
      }
    }
  }
  /// The result of the last move().
  PointMotion<B, K>& motion() { return motion_; }
  /// Gives the points the velocities of move(), while their positions are still those of the phase's start. impulse: of
  /// the forces over the phase, (functions × dim).
  void take_velocity(const Grid<dim>& grid, Points& points, const Weights& weights, const std::vector<double>& mass,
                     const std::vector<double>& u, const std::vector<double>& v_end, const std::vector<double>& v_start,
                     const std::vector<double>& impulse) {
    points.v.swap(motion_.v);
    if (spec_.transfer == Transfer::apic) {
      for_each_block(points.cells(), [&](std::size_t k) {
        const auto centre = Affine::centres(grid, points.cell[k]);
        for (std::size_t p = points.begin(k); p < points.end(k); ++p)
          Affine::set(points, weights, centre, k, p, u.data(), v_end.data());
      });
    }
    check_momentum(points, mass, v_start, impulse);
  }

 private:
  void begin(const Grid<dim>& grid, Points& points, const Weights& weights, const CornerSum& corner_sum,
             const std::vector<double>& mass, const std::vector<double>& momentum) const {
    std::vector<double> v = momentum;
    make_velocity(points, weights, corner_sum, mass, v);
    const std::vector<double> at_rest(v.size());
    for_each_block(points.cells(), [&](std::size_t k) {
      const Centres centre = Affine::centres(grid, points.cell[k]);
      for (std::size_t p = points.begin(k); p < points.end(k); ++p)
        Affine::set(points, weights, centre, k, p, at_rest.data(), v.data());
    });
  }

  // The share of the increment in the points' final velocity; the rest is the nodal velocity itself.
  double kept_share() const {
    return spec_.transfer == Transfer::flip ? spec_.flip_share.value() : spec_.transfer == Transfer::xpic ? 1 : 0;
  }

  // The momenta Σ_p m_p (N_ip v_p + Σ_j A_ij w_j), (functions × dim). about(centres of the cell, cell, point): A and w.
  template <class About>
  std::vector<double> momentum_about(const Grid<dim>& grid, const Points& points, const Weights& weights,
                                     const CornerSum& corner_sum, const About& about) const {
    return nodal_sum<dim>(points, weights, corner_sum, [&](std::size_t k, Corners<dim, per_cell>& corner) {
      const Centres centre = Affine::centres(grid, points.cell[k]);
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        const auto N = weights.N(k, p);
        const double m = points.mass[p];
        const auto [A, w] = about(centre, k, p);
        for (int a = 0; a < per_cell; ++a) {
          for (int i = 0; i < dim; ++i) {
            double share = N[a] * points.v[i][p];
            for (int j = 0; j < dim; ++j) share += A[dim * i + j] * w[j][a];
            corner[dim * a + i] += m * share;
          }
        }
      }
    });
  }
  std::vector<double> affine_momentum(const Grid<dim>& grid, const Points& points, const Weights& weights,
                                      const CornerSum& corner_sum) const {
    return momentum_about(grid, points, weights, corner_sum, [&](const Centres& centre, std::size_t k, std::size_t p) {
      return MotionAbout{Affine::B_of(points, p), Affine::weights_of_B(weights, centre, points.position(p), k, p)};
    });
  }

  // Turns momenta m_i v_i into velocities v_i. A node with negligible mass takes the mean velocity of its cells'
  // points.
  static void make_velocity(const Points& points, const Weights& weights, const CornerSum& corner_sum,
                            const std::vector<double>& mass, std::vector<double>& v) {
    constexpr double next_to_nothing = 1e-12;
    const double body = sum_over(mass.size(), [&](std::size_t f) { return mass[f]; });
    // It may be light because its cells are, which are never heavier than the body.
    const auto may_be_light = [&](std::size_t f) {
      return !(mass[f] > next_to_nothing * body) && corner_sum.reaches(f);
    };
    std::vector<double> of_cells;  // Σ m_p v_p and Σ m_p, (functions × (dim + 1)), if some function is light
    for (std::size_t f = 0; f < mass.size() && of_cells.empty(); ++f)
      if (may_be_light(f)) of_cells = momentum_of_cells(points, weights, corner_sum);
    for_each_block(mass.size(), [&](std::size_t f) {
      double m = mass[f];
      if (may_be_light(f)) {
        const double* of_function = of_cells.data() + (dim + 1) * f;
        if (!(m > next_to_nothing * of_function[dim])) {
          m = of_function[dim];
          for (int i = 0; i < dim; ++i) v[dim * f + i] = of_function[i];
        }
      }
      for (int i = 0; i < dim; ++i) v[dim * f + i] = m > 0 ? v[dim * f + i] / m : 0;
    });
  }
  // The sums Σ m_p v_p and Σ m_p over all points in the cells that each function acts in.
  static std::vector<double> momentum_of_cells(const Points& points, const Weights& weights,
                                               const CornerSum& corner_sum) {
    return nodal_sum<dim + 1>(points, weights, corner_sum, [&](std::size_t k, Corners<dim + 1, per_cell>& corner) {
      std::array<double, dim + 1> of_cell{};
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        of_cell[dim] += points.mass[p];
        for (int i = 0; i < dim; ++i) of_cell[i] += points.mass[p] * points.v[i][p];
      }
      for (int a = 0; a < per_cell; ++a) std::ranges::copy(of_cell, corner.begin() + (dim + 1) * a);
    });
  }

  // Checks Σ_p m_p v_p: in flip and xpic it has changed by the impulse; in pic and apic it is the initial Σ_i m_i v_i
  // plus the impulse.
  void check_momentum(const Points& points, const std::vector<double>& mass, const std::vector<double>& v_start,
                      const std::vector<double>& impulse) {
    const double share = kept_share();
    auto change = conservation_.of_points(points);
    for (int i = 0; i < dim; ++i) change.sum[i] -= share * at_start_.sum[i];
    change.scale = std::max(change.scale, at_start_.scale);
    conservation_.compare_momentum(change, mass.size(),
                                   [share, gain = impulse.data(), m = mass.data(), v = v_start.data()](std::size_t i) {
                                     return gain[i] + (1 - share) * m[i / dim] * v[i];
                                   });
  }

  // The noise (I − S S⁺)^m v_p.
  std::array<std::vector<double>, dim> null_space_part(const Points& points, const Weights& weights,
                                                       const CornerSum& corner_sum,
                                                       const std::vector<double>& mass) const {
    std::array<std::vector<double>, dim> r = points.v;
    for (int pass = 0; pass < spec_.xpic_order; ++pass) {
      std::vector<double> mean =
          nodal_sum<dim>(points, weights, corner_sum, [&](std::size_t k, Corners<dim, per_cell>& corner) {
            for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
              const auto N = weights.N(k, p);
              for (int a = 0; a < per_cell; ++a) {
                for (int i = 0; i < dim; ++i) corner[dim * a + i] += points.mass[p] * N[a] * r[i][p];
              }
            }
          });
      for (std::size_t f = 0; f < mass.size(); ++f) {
        for (int i = 0; i < dim; ++i) mean[dim * f + i] /= mass[f] > 0 ? mass[f] : 1;
      }
      for_each_block(points.cells(), [&](std::size_t k) {
        for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
          const auto smooth = weights.value(mean.data(), k, p);
          for (int i = 0; i < dim; ++i) r[i][p] -= smooth[i];
        }
      });
    }
    return r;
  }

  PhaseSpec spec_;
  bool damped_;
  ConservationCheck<dim> conservation_;
  typename ConservationCheck<dim>::Momentum at_start_;  // momentum of the points when the phase began
  PointMotion<B, K> motion_;
  std::vector<double> increment_;  // w_i, (functions × dim)
};

}  // namespace stillpoint
