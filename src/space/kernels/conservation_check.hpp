// Checks the conservation of mass and momentum: in the transfer between material points and grid, and since the run
// began in a body that nothing acts on.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel_loop.hpp"
#include "parallel/of_all.hpp"
#include "scene/dimensions.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

template <int Dim>
class ConservationCheck {
 public:
  struct Momentum {
    std::array<double, Dim> sum{};  // Σ_p m_p v_p [kg m/s]
    double scale = 0;               // Σ_p m_p |v_p|
  };
  explicit ConservationCheck(const Ranks* ranks) : ranks_(ranks) {}

  Momentum of_points(const MaterialPoints<Dim>& points) const {
    Momentum momentum;
    const auto& m = points.mass;
    for (int i = 0; i < Dim; ++i) {
      const auto& v = points.v[i];
      momentum.sum[i] = over_points(points, [&](std::size_t p) { return m[p] * v[p]; });
      momentum.scale += over_points(points, [&](std::size_t p) { return m[p] * std::abs(v[p]); });
    }
    return momentum;
  }

  /// Compares the nodes' masses, (functions), with the body's mass when the run began.
  void compare_mass(double body, const std::vector<double>& at_nodes) {
    const double sum = sum_over(at_nodes.size(), [&](std::size_t f) { return at_nodes[f]; });
    mass_ = std::max(mass_, std::abs(sum - body) / body);
  }
  /// Compares the momenta of `functions` nodes, at(Dim function + component), with those of the points.
  template <class At>
  void compare_momentum(const Momentum& of_points, std::size_t functions, const At& at) {
    if (!(of_points.scale > 0)) return;
    for (std::size_t i = 0; i < Dim; ++i) {
      const double sum = sum_over(functions, [&](std::size_t f) { return at(Dim * f + i); });
      momentum_ = std::max(momentum_, std::abs(sum - of_points.sum[i]) / of_points.scale);
    }
  }
  /// Compares the points' momenta with those of the first call: in a free body they are conserved.
  void compare_with_start(const MaterialPoints<Dim>& points) {
    const Momentum now = of_points(points);
    const auto [turn, turn_scale] = angular_momentum(points);
    if (!start_) start_ = Start{now, turn, turn_scale};
    if (start_->momentum.scale > 0) {
      for (int i = 0; i < Dim; ++i)
        momentum_ = std::max(momentum_, std::abs(now.sum[i] - start_->momentum.sum[i]) / start_->momentum.scale);
    }
    if (start_->turn_scale > 0) {
      for (std::size_t k = 0; k < turn.size(); ++k) {
        const double change = std::abs(turn[k] - start_->turn[k]) / start_->turn_scale;
        angular_momentum_ = std::max(angular_momentum_.value_or(0), change);
      }
    }
  }
  void archive(const StateArchive& state) {
    bool compares = start_.has_value();
    state("compares_with_start", compares);
    if (compares) {
      if (!start_) start_.emplace();
      state("momentum_at_start", start_->momentum.sum);
      state("momentum_scale", start_->momentum.scale);
      state("turn_at_start", start_->turn);
      state("turn_scale", start_->turn_scale);
    }
    state("mass_error", mass_);
    state("momentum_error", momentum_);
    state("angular_momentum_error", angular_momentum_);
  }
  double mass() const { return mass_; }
  double momentum() const { return momentum_; }
  /// The error of angular momentum; empty if it was not compared.
  std::optional<double> angular_momentum() const { return angular_momentum_; }

 private:
  using Turn = std::array<double, Dim == 3 ? 3 : 1>;  // angular momentum about x, y, z, or z alone [kg m²/s]
  struct Start {
    Momentum momentum;
    Turn turn{};
    double turn_scale = 0;
  };
  // The angular momentum Σ_p m_p (x_p × v_p + B_p,yx − B_p,xy) (about z), and its scale Σ_p m_p |x_p − x_c| |v_p| about
  // the centre of mass x_c.
  std::pair<Turn, double> angular_momentum(const MaterialPoints<Dim>& points) const {
    if constexpr (Dim == 1) {
      return {{0}, 0};
    } else {
      const auto mean = [&](const std::vector<double>& x) {
        return over_points(points, [&](std::size_t p) { return points.mass[p] * x[p]; }) /
               over_points(points, [&](std::size_t p) { return points.mass[p]; });
      };
      Point<Dim> centre;
      for (std::size_t d = 0; d < Dim; ++d) centre[d] = mean(points.x[d]);
      const auto& v = points.v;
      const bool affine = !points.B_apic[0].empty();
      Turn turn;
      for (std::size_t k = 0; k < turn.size(); ++k) {
        const std::size_t i = dimension_info(Dim).turns[k].from, j = dimension_info(Dim).turns[k].to;
        turn[k] = over_points(points, [&](std::size_t p) {
          const double spin = affine ? points.B_apic[Dim * j + i][p] - points.B_apic[Dim * i + j][p] : 0;
          return points.mass[p] * (points.x[i][p] * v[j][p] - points.x[j][p] * v[i][p] + spin);
        });
      }
      const double scale = over_points(points, [&](std::size_t p) {
        double distance = 0, speed = 0;
        for (std::size_t d = 0; d < Dim; ++d) {
          distance = std::hypot(distance, points.x[d][p] - centre[d]);
          speed = std::hypot(speed, v[d][p]);
        }
        return points.mass[p] * distance * speed;
      });
      return {turn, scale};
    }
  }

  // Σ term(p) over the points of all ranks.
  template <class Term>
  double over_points(const MaterialPoints<Dim>& points, const Term& term) const {
    return sum_over_ranks(ranks_, points.size(), term);
  }

  const Ranks* ranks_;
  std::optional<Start> start_;
  std::optional<double> angular_momentum_;
  double mass_ = 0, momentum_ = 0;  // the largest relative errors so far
};

}  // namespace stillpoint
