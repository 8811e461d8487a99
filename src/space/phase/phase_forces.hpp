// Forces of a phase: R(u), its tangent, and what is remembered of an accepted step.
#pragma once

#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
bool MaterialPointPhase<B, K>::internal_force(double t, ConstVec u, Vec R) const {
  spread(t, u, grid_u_);
  const double* V = body_.points.volume.data();
  if (history_dependent_) {
    last_t_ = t;
    const double dt = t - committed_t_;
    const auto stress = [&, V, dt](std::size_t m, Block& block) { return body_.materials[m]->stress(block, V, dt); };
    return nodal_force_.template evaluate<true>(grid_u_.data(), committed_u_.data(), stress, *dofs_, R);
  }
  const auto stress = [&, V](std::size_t m, Block& block) { return body_.materials[m]->stress(block, V, 0); };
  return nodal_force_.template evaluate<false>(grid_u_.data(), nullptr, stress, *dofs_, R);
}

// The derivatives of the reactions take their place until the next internal_force().
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::apply_tangent(Tangent kind, double t, ConstVec u, ConstVec du, Vec dR) const {
  spread(t, u, grid_u_);
  std::ranges::fill(grid_work_, 0.0);
  for (std::size_t k = 0; k < du.size(); ++k) grid_work_[static_cast<std::size_t>(dofs_->free[k])] = du[k];
  const double* V = body_.points.volume.data();
  const double dt = t - committed_t_;
  const auto answer = [&, V, dt](std::size_t m, Block& block) {
    body_.materials[m]->tangent(kind, block, V, dt);
    return 0.0;
  };
  nodal_force_.template evaluate<true, true>(grid_u_.data(), committed_u_.data(), answer, *dofs_, dR,
                                             grid_work_.data());
}

// K_ai,bk = Σ_p V_p G_a,i,c (∂P_c/∂H_d) G_b,k,d with H_c = Σ_a,i G_a,i,c u_a,i
template <AxisBasis B, Kinematics K>
SparseMatrix MaterialPointPhase<B, K>::assemble_tangent(Tangent kind, double t, ConstVec u) const {
  spread(t, u, grid_u_);
  std::ranges::transform(grid_u_, committed_u_, grid_work_.begin(), std::minus<>());
  const auto add_point = [&](std::size_t k, std::size_t p, CellMatrix<Dim, per_cell>& matrix) {
    const auto H = weights_.gradient(grid_u_.data(), k, p), dH = weights_.gradient(grid_work_.data(), k, p);
    const auto A = material_of(k).moduli(kind, H, dH, t - committed_t_, p);
    std::array<TensorOf<K>, Dim * per_cell> G{};
    const auto dN = weights_.dN(k, p);
    for (int a = 0; a < per_cell; ++a) {
      for (int i = 0; i < Dim; ++i) {
        for (int j = 0; j < Dim; ++j) G[Dim * a + i][Dim * i + j] = dN[per_cell * j + a];
      }
      if constexpr (K == Kinematics::axisymmetric) G[Dim * a][Dim * Dim] = dN[per_cell * Dim + a];
    }
    for (int row = 0; row < Dim * per_cell; ++row) {
      TensorOf<K> left{};  // V G A
      for (int c = 0; c < components; ++c) {
        if (G[row][c] == 0) continue;
        for (int d = 0; d < components; ++d) left[d] += body_.points.volume[p] * G[row][c] * A[components * c + d];
      }
      for (int column = 0; column < Dim * per_cell; ++column) {
        for (int d = 0; d < components; ++d) matrix[row][column] += left[d] * G[column][d];
      }
    }
  };
  return assemble_cells<B, K>(body_.points, weights_, *dofs_, add_point).free;
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::commit(double t, ConstVec u) {
  if (!history_dependent_) return;
  std::vector<double> R(size());
  internal_force(t, u, R);
  commit_last();
}

// What internal_force() was last evaluated at is in grid_u_, which every use fills anew.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::commit_last() {
  if (!history_dependent_) return;
  for (const auto& material : body_.materials) material->commit();
  committed_u_.swap(grid_u_);
  committed_t_ = last_t_;
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::add_support_inertia(double t, double c, Vec Q) const {
  if (consistent_.prescribed.nonZeros() == 0 || mass_->is_lumped()) return;
  for (std::size_t s = 0; s < boundary_.prescribed().size(); ++s) {
    const PrescribedMotion& motion = boundary_.motion_of(s);
    if (!motion.moves()) continue;
    const double pull = motion.acceleration(t) + c * motion.velocity(t);
    for (SparseMatrix::InnerIterator m(consistent_.prescribed, static_cast<Eigen::Index>(s)); m; ++m) {
      Q[static_cast<std::size_t>(m.row())] -= m.value() * pull;
    }
  }
}

template <AxisBasis B, Kinematics K>
double MaterialPointPhase<B, K>::reaction_norm() const {
  double sum = 0;
  for (const double reaction : nodal_force_.reactions()) sum += reaction * reaction;
  for (const WallContact& wall : boundary_.walls()) sum += wall.square_of_forces();
  return std::sqrt(sum);
}

template <AxisBasis B, Kinematics K>
double MaterialPointPhase<B, K>::stiffening(double t, ConstVec u) const {
  if (!stiffens()) return 1;
  const auto largest_bound = [&] {
    double largest = 0;
    nodal_force_.visit(grid_u_.data(), [&](std::size_t m, const Block& block) {
      const double bound = body_.materials[m]->stiffness_bound(block);
#pragma omp critical(stillpoint_stiffening)
      largest = bound <= largest ? largest : bound;
    });
    return largest;
  };
  if (!(undeformed_bound_ > 0)) {
    std::ranges::fill(grid_u_, 0.0);
    undeformed_bound_ = largest_bound();
  }
  spread(t, u, grid_u_);
  return largest_bound() / undeformed_bound_;
}
}  // namespace stillpoint
