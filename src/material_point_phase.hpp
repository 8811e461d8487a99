// A Lagrangian phase for one dimension, basis and material law: the loops over material points.
#pragma once

#include <stillpoint/lagrangian_phase.hpp>
#include <stillpoint/material.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "cell_assembly.hpp"
#include "degrees_of_freedom.hpp"
#include "nodal_force.hpp"
#include "nodal_loads.hpp"
#include "parallel_loop.hpp"
#include "point_weights.hpp"
#include "prescribed_motion.hpp"

namespace stillpoint {

/// Where the parts of a phase come from; make_phase() puts them together.
template <AxisBasis B, MaterialLaw Law>
struct PhaseParts {
  static constexpr int dim = Law::dim;
  MaterialPoints<dim> points;
  QuadratureReport quadrature;
  PointWeights<B, dim> weights;
  DegreesOfFreedom dofs;
  Mass mass;
  SplitMatrix consistent;  // M as assembled, for projections and moving supports
  NodalLoads loads;
  std::vector<PrescribedMotion> motions;  // of the supports
  std::vector<Expression> body_force;     // of x and t, where it depends on t; otherwise part of loads
  std::vector<Expression> initial_u, initial_v;
  Law law;
  int grid_functions;
};

template <AxisBasis B, MaterialLaw Law>
class MaterialPointPhase final : public LagrangianPhase {
  static constexpr int Dim = Law::dim;
  static constexpr int per_cell = PointWeights<B, Dim>::per_cell;
  static constexpr int corners = Dim * per_cell;  // a cell's corner forces
  static constexpr std::size_t tensor = Dim * Dim;

 public:
  explicit MaterialPointPhase(PhaseParts<B, Law> parts)
      : s_(std::move(parts)),
        nodal_force_(s_.points, s_.weights, s_.dofs),
        grid_u_(static_cast<std::size_t>(Dim * s_.grid_functions), 0.0),
        grid_du_(grid_u_.size(), 0.0),
        stress_(tensor * points(), 0.0) {}

  // --- SemiDiscrete -------------------------------------------------------------------------------
  std::size_t size() const override { return s_.dofs.size(); }
  const Mass& mass() const override { return s_.mass; }
  bool history_dependent() const override { return Law::history_dependent; }

  void external_force(double t, Vec F) const override {
    s_.loads.evaluate(t, F);
    if (!s_.body_force.empty()) add_body_force(t, F);
  }

  bool internal_force(double t, ConstVec u, Vec R) const override {
    spread(t, u);
    const bool admissible = nodal_force_.gather(s_.points, s_.weights, [&](std::size_t p) {
      return s_.law.first_piola(s_.weights.gradient(grid_u_.data(), p));
    });
    nodal_force_.sum(R);
    return admissible;
  }

  // dP_ij = ∂P_ij/∂H_kl dH_kl
  void tangent(double t, ConstVec u, ConstVec du, Vec dR) const override {
    spread(t, u);
    for (std::size_t k = 0; k < size(); ++k) grid_du_[static_cast<std::size_t>(s_.dofs.free[k])] = du[k];
    nodal_force_.gather(s_.points, s_.weights, [&](std::size_t p) {
      const Moduli<Dim> A = s_.law.moduli(s_.weights.gradient(grid_u_.data(), p));
      const Tensor<Dim> dH = s_.weights.gradient(grid_du_.data(), p);
      Tensor<Dim> dP{};
      for (std::size_t ij = 0; ij < tensor; ++ij) {
        for (std::size_t kl = 0; kl < tensor; ++kl) dP[ij] += A[tensor * ij + kl] * dH[kl];
      }
      return dP;
    });
    nodal_force_.sum(dR);
  }

  // K_ai,bk = Σ_p V_p ∂N_a/∂x_j (∂P_ij/∂H_kl) ∂N_b/∂x_l
  SparseMatrix tangent_matrix(double t, ConstVec u) const override {
    spread(t, u);
    const auto add_point = [&](std::size_t p, CellMatrix<Dim, per_cell>& K) {
      const Moduli<Dim> A = s_.law.moduli(s_.weights.gradient(grid_u_.data(), p));
      for (int row = 0; row < corners; ++row) {
        for (int column = 0; column < corners; ++column) {
          const int a = row / Dim, i = row % Dim, b = column / Dim, k = column % Dim;
          for (int j = 0; j < Dim; ++j) {
            for (int l = 0; l < Dim; ++l) {
              K[row][column] += s_.points.volume[p] * s_.weights.dN(j, a, p) * A[tensor * (Dim * i + j) + Dim * k + l] *
                                s_.weights.dN(l, b, p);
            }
          }
        }
      }
    };
    return assemble_cells<B, Dim>(s_.points, s_.weights, s_.dofs, add_point, [](std::size_t, auto&) {}).free;
  }

  void commit(double t, ConstVec u) override {
    spread(t, u);
    for (std::size_t p = 0; p < points(); ++p) {
      const Tensor<Dim> sigma = s_.law.cauchy(s_.weights.gradient(grid_u_.data(), p));
      std::copy(sigma.begin(), sigma.end(), stress_.begin() + static_cast<std::ptrdiff_t>(tensor * p));
    }
  }

  void add_support_inertia(double t, double c, Vec Q) const override {
    if (s_.consistent.prescribed.nonZeros() == 0 || s_.mass.is_lumped()) return;
    for (std::size_t support = 0; support < s_.motions.size(); ++support) {
      if (!s_.motions[support].moves()) continue;
      const double pull = s_.motions[support].acceleration(t) + c * s_.motions[support].velocity(t);
      for (SparseMatrix::InnerIterator m(s_.consistent.prescribed, static_cast<Eigen::Index>(support)); m; ++m) {
        Q[static_cast<std::size_t>(m.row())] -= m.value() * pull;
      }
    }
  }

  double reaction_norm() const override {
    double sum = 0;
    for (std::size_t s = 0; s < s_.dofs.prescribed.size(); ++s) {
      const double reaction = nodal_force_.at(size() + s);
      sum += reaction * reaction;
    }
    return std::sqrt(sum);
  }

  // --- LagrangianPhase ----------------------------------------------------------------------------
  int dim() const override { return Dim; }
  std::size_t points() const override { return s_.points.size(); }
  std::vector<double> place(std::size_t p) const override {
    const Point<Dim> at = s_.points.place(p);
    return {at.begin(), at.end()};
  }
  ConstVec volumes() const override { return s_.points.volume; }
  double total_mass() const override {
    double sum = 0;
    for (const double m : s_.points.mass) sum += m;
    return sum;
  }

  void point_displacement(double t, ConstVec u, Vec out) const override {
    spread(t, u);
    gather(out, [&](std::size_t p) { return s_.weights.value(grid_u_.data(), p); });
  }
  void point_velocity(double t, ConstVec v, Vec out) const override {
    spread_free(v, grid_du_);
    for (std::size_t s = 0; s < s_.motions.size(); ++s) prescribed(grid_du_, s) = s_.motions[s].velocity(t);
    gather(out, [&](std::size_t p) { return s_.weights.value(grid_du_.data(), p); });
    for (std::size_t s = 0; s < s_.motions.size(); ++s) prescribed(grid_du_, s) = 0;
  }
  void point_strain(double t, ConstVec u, Vec out) const override {
    spread(t, u);
    gather(out, [&](std::size_t p) { return s_.weights.gradient(grid_u_.data(), p); });
  }
  ConstVec point_stress() const override { return stress_; }

  std::vector<double> initial_displacement(double t) const override {
    std::vector<double> held;
    for (const auto& motion : s_.motions) held.push_back(motion.displacement(t));
    return project(s_.initial_u, held);
  }
  std::vector<double> initial_velocity(double t) const override {
    std::vector<double> held;
    for (const auto& motion : s_.motions) held.push_back(motion.velocity(t));
    return project(s_.initial_v, held);
  }

  std::vector<PointArray> point_arrays() const override {
    constexpr double real = sizeof(double);
    return {{"place", Dim * real},
            {"mass", real},
            {"volume", real},
            {"first function", sizeof(int)},
            {"weights N", per_cell * real},
            {"gradients of N", Dim * per_cell * real},
            {"trial stress", tensor * real},
            {"stress", tensor * real}};
  }
  std::size_t supported_degrees_of_freedom() const override { return s_.dofs.prescribed.size(); }
  std::size_t occupied_cells() const override { return s_.points.cell.size(); }
  QuadratureReport quadrature() const override { return s_.quadrature; }
  double stiffening(double t, ConstVec u) const override {
    static_assert(Dim == 1, "a modulus is one number in one dimension only");
    if (!nonlinear()) return 1;
    spread(t, u);
    const double undeformed = s_.law.moduli({})[0];
    double largest = 0;
    for (std::size_t p = 0; p < points(); ++p) {
      const double modulus = s_.law.moduli(s_.weights.gradient(grid_u_.data(), p))[0];
      if (!std::isfinite(modulus)) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, modulus);
    }
    return largest / undeformed;
  }
  bool nonlinear() const override { return Law::finite_strain || Law::history_dependent; }

 private:
  double& prescribed(std::vector<double>& grid, std::size_t s) const {
    return grid[static_cast<std::size_t>(s_.dofs.prescribed[s])];
  }
  void spread_free(ConstVec u, std::vector<double>& grid) const {
    for_each_index(u.size(),
                   [u, to = grid.data(), number = s_.dofs.free.data()](std::size_t k) { to[number[k]] = u[k]; });
  }
  // The grid's displacements from the free unknowns and the supports at time t.
  void spread(double t, ConstVec u) const {
    spread_free(u, grid_u_);
    for (std::size_t s = 0; s < s_.motions.size(); ++s) prescribed(grid_u_, s) = s_.motions[s].displacement(t);
  }

  template <class Value>
  void gather(Vec out, const Value& value_at) const {
    for (std::size_t p = 0; p < points(); ++p) {
      const auto value = value_at(p);
      std::copy(value.begin(), value.end(), out.begin() + static_cast<std::ptrdiff_t>(value.size() * p));
    }
  }

  // F_i += Σ_p N_ip m_p b(x_p, t)
  void add_body_force(double t, Vec F) const {
    for (std::size_t p = 0; p < points(); ++p) {
      const Point<Dim> at = s_.points.place(p);
      for (int i = 0; i < Dim; ++i) {
        const double force = s_.points.mass[p] * s_.body_force[static_cast<std::size_t>(i)](at, t);
        for (int a = 0; a < per_cell; ++a) {
          const int dof = s_.dofs.number[static_cast<std::size_t>(Dim * s_.weights.function(p, a) + i)];
          if (s_.dofs.is_free(dof)) F[static_cast<std::size_t>(dof)] += force * s_.weights.N(a, p);
        }
      }
    }
  }

  // M_ff u_f = Σ_p m_p N_fp u_0(x_p) − M_fs u_s: the least-squares fit at the material points, whatever M the motion
  // uses.
  std::vector<double> project(const std::vector<Expression>& field, const std::vector<double>& held) const {
    std::vector<double> u(size(), 0.0);
    if (field.empty()) return u;
    for (std::size_t p = 0; p < points(); ++p) {
      const Point<Dim> at = s_.points.place(p);
      for (int i = 0; i < Dim; ++i) {
        const double moment = s_.points.mass[p] * field[static_cast<std::size_t>(i)](at, 0);
        for (int a = 0; a < per_cell; ++a) {
          const int dof = s_.dofs.number[static_cast<std::size_t>(Dim * s_.weights.function(p, a) + i)];
          if (s_.dofs.is_free(dof)) u[static_cast<std::size_t>(dof)] += moment * s_.weights.N(a, p);
        }
      }
    }
    if (!held.empty()) {
      const Eigen::Map<const Eigen::VectorXd> u_s(held.data(), static_cast<Eigen::Index>(held.size()));
      Eigen::Map<Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size())) -= s_.consistent.prescribed * u_s;
    }
    if (s_.mass.is_lumped()) {
      SparseCholesky(s_.consistent.free).solve(u, u);
    } else {
      s_.mass.solve(u, u);
    }
    return u;
  }

  PhaseParts<B, Law> s_;
  // Work arrays, sized once; evaluations of one phase are not for several threads at once.
  mutable NodalForce<B, Dim> nodal_force_;
  mutable std::vector<double> grid_u_, grid_du_;  // (Dim × functions of the grid); grid_du_ is 0 at supports
  std::vector<double> stress_;                    // Cauchy, committed, (P × tensor)
};

}  // namespace stillpoint
