// Velocities from material points to the grid when a phase begins, and back when it ends.
//
//   to the grid    v_i = Σ_p m_p N_ip v_p/m_i,   m_i = Σ_p m_p N_ip             [APIC: N_ip v_p + B_p w_ip]
//   flip           v_p += Σ_i N_ip (v_i − v_i at the start), or a share of it and the rest of Σ_i N_ip v_i
//   pic            v_p  = Σ_i N_ip v_i
//   xpic(m)        v_p  = v_p − (I − S S⁺)^m v_p + Σ_i N_ip (v_i − v_i at the start), S to points, S⁺ to the grid;
//                  what m passes of averaging do not keep is noise [Hammerquist and Nairn 2017]
//   apic           v_p  = Σ_i N_ip v_i,  B_p = Σ_i N_ip v_i ⊗ (x_i − x_p), as they are at the end [Jiang et al. 2015]
//
// x_i is the centre of function i, Σ_i N_i(x) x_i = x; affine_velocity.hpp has B_p and w_ip.
//
// A node at a surface has points on one side only, and their mean velocity is that of a place further inside: a body
// that turns is strained there at the start of every phase, and 3 to 5 % of its angular momentum are gone after a turn.
// In a motion that nothing damps, flip's points therefore bring their velocity to where the node is,
//
//   v_i = Σ_p m_p N_ip (v_p + ∇v_p (x_i − x_p))/m_i,   ∇v_p = Σ_j v_j ⊗ ∇N_jp of the means v_j,
//
// with the same sum of momenta, since Σ_i N_ip (x_i − x_p) = 0; and apic begins with B_p of the same means.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "space/kernels/affine_velocity.hpp"
#include "space/kernels/conservation_check.hpp"
#include "space/kernels/nodal_sum.hpp"

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
  /// damped: whether the scene damps its motion, so that what a turn keeps of it does not matter.
  VelocityTransfer(const PhaseSpec& spec, bool damped) : spec_(spec), damped_(damped) {}

  /// Makes B_p of apic's points ready for a phase: in the first, where they have velocities v_p alone, from those.
  /// mass: m_i, (functions).
  void begin_phase(const Grid<dim>& grid, Points& points, const Weights& weights, const CornerSum& corner_sum,
                   const std::vector<double>& mass, bool first) const {
    if (spec_.transfer != Transfer::apic) return;
    if (first && !damped_) begin(grid, points, weights, corner_sum, mass);
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

  /// v_i from the points, (functions × dim). mass: m_i, (functions).
  std::vector<double> to_grid(const Grid<dim>& grid, const Points& points, const Weights& weights,
                              const CornerSum& corner_sum, const std::vector<double>& mass) {
    const std::vector<double> of_cells = momentum_of_cells(points, weights, corner_sum);
    std::vector<double> v = spec_.transfer == Transfer::apic ? affine_momentum(grid, points, weights, corner_sum)
                                                             : nodal_momentum(points, weights, corner_sum);
    if (spec_.transfer == Transfer::flip && !damped_ && B::partition_of_unity) {
      make_velocity(of_cells, mass, v);
      v = momentum_about(grid, points, weights, corner_sum,
                         [&, mean = std::move(v)](const Centres& centre, std::size_t k, std::size_t p) {
                           return MotionAbout{Affine::velocity_gradient(weights, mean.data(), k, p),
                                              Affine::distances_weighed(weights.N(k, p), centre, points.position(p))};
                         });
    }
    conservation_.compare_momentum(ConservationCheck<dim>::of_points(points), v);
    make_velocity(of_cells, mass, v);
    return v;
  }

  const ConservationCheck<dim>& conservation() const { return conservation_; }
  ConservationCheck<dim>& conservation() { return conservation_; }

  /// Moves velocities to the points at a phase's end. u, v, v_start, and the impulse of the forces over the phase: over
  /// the grid's functions, (functions × dim); mass: (functions). Positions are still those of the phase's start.
  void to_points(const Grid<dim>& grid, Points& points, const Weights& weights, const CornerSum& corner_sum,
                 const std::vector<double>& mass, const double* u, const std::vector<double>& v_end,
                 const std::vector<double>& v_start, const std::vector<double>& impulse) {
    const auto before = ConservationCheck<dim>::of_points(points);
    move(grid, points, weights, corner_sum, mass, u, v_end.data(), v_start.data());
    check_momentum(before, points, mass, v_start, impulse);
  }

 private:
  void begin(const Grid<dim>& grid, Points& points, const Weights& weights, const CornerSum& corner_sum,
             const std::vector<double>& mass) const {
    std::vector<double> v = nodal_momentum(points, weights, corner_sum);
    make_velocity(momentum_of_cells(points, weights, corner_sum), mass, v);
    const std::vector<double> at_rest(v.size());
    for_each_block(points.cells(), [&](std::size_t k) {
      const Centres centre = Affine::centres(grid, points.cell[k]);
      for (std::size_t p = points.begin(k); p < points.end(k); ++p)
        Affine::set(points, weights, centre, k, p, at_rest.data(), v.data());
    });
  }

  // Σ_p m_p N_ip v_p, (functions × dim) [kg m/s].
  std::vector<double> nodal_momentum(const Points& points, const Weights& weights, const CornerSum& corner_sum) const {
    return nodal_sum<dim>(points, weights, corner_sum, [&](std::size_t k, Corners<dim, per_cell>& corner) {
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        const auto N = weights.N(k, p);
        const double m = points.mass[p];
        for (int a = 0; a < per_cell; ++a) {
          for (int i = 0; i < dim; ++i) {
            const double share = N[a] * points.v[i][p];
            corner[dim * a + i] += m * share;
          }
        }
      }
    });
  }

  // Σ_p m_p (N_ip v_p + Σ_j A_ij w_j), likewise. about(centres of the cell, cell, point): A and w.
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

  // Σ m_p v_p and Σ m_p of all points in the cells that a function acts in, (functions × (dim + 1)).
  std::vector<double> momentum_of_cells(const Points& points, const Weights& weights,
                                        const CornerSum& corner_sum) const {
    return nodal_sum<dim + 1>(points, weights, corner_sum, [&](std::size_t k, Corners<dim + 1, per_cell>& corner) {
      std::array<double, dim + 1> of_cell{};
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        of_cell[dim] += points.mass[p];
        for (int i = 0; i < dim; ++i) of_cell[i] += points.mass[p] * points.v[i][p];
      }
      for (int a = 0; a < per_cell; ++a) std::copy(of_cell.begin(), of_cell.end(), corner.begin() + (dim + 1) * a);
    });
  }

  // v_i from momenta m_i v_i. A node whose mass is next to nothing takes the velocity of its cells' points.
  static void make_velocity(const std::vector<double>& of_cells, const std::vector<double>& mass,
                            std::vector<double>& v) {
    constexpr double next_to_nothing = 1e-12;
    for_each_block(mass.size(), [&](std::size_t f) {
      const double* cells = of_cells.data() + (dim + 1) * f;
      const bool of_its_own = mass[f] > next_to_nothing * cells[dim];
      const double m = of_its_own ? mass[f] : cells[dim];
      for (int i = 0; i < dim; ++i) v[dim * f + i] = m > 0 ? (of_its_own ? v[dim * f + i] : cells[i]) / m : 0;
    });
  }

  void move(const Grid<dim>& grid, Points& points, const Weights& weights, const CornerSum& corner_sum,
            const std::vector<double>& mass, const double* u, const double* v, const double* v_start) const {
    const std::array<std::vector<double>, dim> noise =
        spec_.transfer == Transfer::xpic ? null_space_part(points, weights, corner_sum, mass) : decltype(noise){};
    // Share of the increment in flip; the rest is the velocity itself.
    const double share = spec_.transfer == Transfer::flip ? spec_.flip_share : 0;
    for_each_block(points.cells(), [&](std::size_t k) {
      const auto centre = spec_.transfer == Transfer::apic ? Affine::centres(grid, points.cell[k]) : Centres{};
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        const auto now = weights.value(v, k, p), before = weights.value(v_start, k, p);
        for (int i = 0; i < dim; ++i) {
          double& v_p = points.v[i][p];
          v_p = spec_.transfer == Transfer::xpic ? v_p - noise[i][p] + now[i] - before[i]
                                                 : share * (v_p + now[i] - before[i]) + (1 - share) * now[i];
        }
        if (spec_.transfer == Transfer::apic) Affine::set(points, weights, centre, k, p, u, v);
      }
    });
  }

  // Σ_p m_p v_p has changed by the impulse in flip and xpic; in pic and apic it is Σ_i m_i v_i of the start and that.
  void check_momentum(const typename ConservationCheck<dim>::Momentum& before, const Points& points,
                      const std::vector<double>& mass, const std::vector<double>& v_start,
                      const std::vector<double>& impulse) {
    const double share = spec_.transfer == Transfer::flip ? spec_.flip_share : spec_.transfer == Transfer::xpic ? 1 : 0;
    std::vector<double> expected(v_start.size());
    for_each_index(expected.size(),
                   [&](std::size_t i) { expected[i] = impulse[i] + (1 - share) * mass[i / dim] * v_start[i]; });
    auto change = ConservationCheck<dim>::of_points(points);
    for (int i = 0; i < dim; ++i) change.sum[i] -= share * before.sum[i];
    change.scale = std::max(change.scale, before.scale);
    conservation_.compare_momentum(change, expected);
  }

  // (I − S S⁺)^m v_p
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
};

}  // namespace stillpoint
