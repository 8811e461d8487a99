// Forces of a phase: R(u), its tangent, and the commit of an accepted step.
#pragma once

#include "space/materials/moduli_of.hpp"
#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::external_force(double t, ConstVec u, Vec F) const {
  for_each_index(F.size(), [F, constant = constant_force_.data()](std::size_t i) { F[i] = constant[i]; });
  conditions_.add_loads(parts(), t, F);
  if (!conditions_.loads_follow()) return;
  spread(t, u, grid_u_);
  conditions_.add_following_loads(parts(), t, grid_u_.data(), F);
}

template <AxisBasis B, Kinematics K>
SparseMatrix MaterialPointPhase<B, K>::of_loads(double t, ConstVec u) const {
  spread(t, u, grid_u_);
  return conditions_.tangent_of_loads(parts(), t, grid_u_.data());
}

// Successive phases use the same arrays, whose memory pages are already mapped.
template <AxisBasis B, Kinematics K>
std::unique_ptr<TrialState> MaterialPointPhase<B, K>::make_trial() const {
  auto trial = std::make_unique<Trial>();
  trial->of = this;
  trial->phase = phase_;
  trial->reactions.assign(dofs_->prescribed.size() + conditions_.springs(), 0);
  if (!spare_) spare_ = std::make_shared<TrialArrays>();
  trial->arrays = spare_.use_count() == 1 ? spare_ : std::make_shared<TrialArrays>();
  trial->arrays->u.assign(grid_u_.size(), 0);
  trial->arrays->history.resize(body_.materials.size());
  for (std::size_t m = 0; m < body_.materials.size(); ++m) {
    trial->arrays->history[m].resize(body_.materials[m]->info().history_size);
  }
  if (averages_dilatation() && history_dependent_) trial->arrays->averages.resize(body_.points.size());
  return trial;
}

// In bilinear or trilinear cells with R(u) = K u, the points are needed only by their moments.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::take_elastic_moments() {
  if constexpr (has_elastic_cells) {
    if (info_.nonlinear || updated_lagrangian() || problem_.geostatic) return;
    std::vector<typename ElasticCells<Dim>::Moduli> moduli;
    for (std::size_t m = 0; m < body_.materials.size(); ++m) {
      const auto p = static_cast<std::size_t>(body_.points.material_begin[m]);
      const auto A = body_.materials[m]->moduli(Tangent::elastic, {}, {}, 0, p);  // for xx, xy, …, row by row
      moduli.push_back({.normal = A[0], .cross = A[Dim + 1], .shear = A[components + 1]});
    }
    elastic_cells_.rebuild(body_.points, weights_, std::move(moduli), averages_dilatation());
  }
}

template <AxisBasis B, Kinematics K>
auto MaterialPointPhase<B, K>::of_elastic_cells(const std::vector<double>& grid_u) const {
  return [this, u = grid_u.data()](std::size_t begin, std::size_t end, double* corner) {
    return elastic_cells_.forces(u, begin, end, corner);
  };
}

// Whether u is the beginning of a phase after the first, and the committed stresses of the points still hold.
template <AxisBasis B, Kinematics K>
bool MaterialPointPhase<B, K>::stands_as_committed(double t, const std::vector<double>& grid_u) const {
  const bool begins = history_dependent_ && phase_ > 0 && t == held_.start() && t == committed_t_;
  return begins && !averages_dilatation() &&
         std::ranges::all_of(body_.materials, [](const auto& law) { return law->info().stress_stays; }) &&
         std::ranges::all_of(grid_u, [](double u) { return u == 0; });
}

template <AxisBasis B, Kinematics K>
bool MaterialPointPhase<B, K>::internal_force(double t, ConstVec u, Vec R, TrialState& any) const {
  Trial& trial = own(any);
  std::vector<double>& grid_u = trial.arrays->u;
  trial.motion = spread_and_measure(t, u, grid_u);
  trial.t = t;
  trial.evaluated = false;
  trial.too_far = !is_within_phase(trial.motion, grid_u.data());
  if (trial.too_far) return false;
  take_means(grid_u.data());
  trial.keeps_history = true;
  if (stands_as_committed(t, grid_u)) {
    trial.keeps_history = false;
    const auto answer = [this](std::size_t m, Block& block) {
      return body_.materials[m]->committed_stress(block, body_.points.volume.data());
    };
    trial.evaluated = nodal_force_.template evaluate<false>(grid_u.data(), nullptr, answer, *dofs_, R, trial.reactions);
  } else if (history_dependent_) {
    const double dt = t - committed_t_;
    double* const averages = averages_dilatation() ? trial.arrays->averages.data() : nullptr;
    const auto answer = [this, dt, history = trial.arrays->history.data(), averages](std::size_t m, Block& block) {
      return stress<true>(m, block, dt, history[m].data(), averages);
    };
    trial.evaluated = nodal_force_.template evaluate<true>(grid_u.data(), committed_u_.data(), std::cref(answer),
                                                           *dofs_, R, trial.reactions);
  } else if (elastic_cells_.empty()) {
    const auto answer = [this](std::size_t m, Block& block) { return stress<false>(m, block, 0, nullptr, nullptr); };
    trial.evaluated = nodal_force_.template evaluate<false>(grid_u.data(), nullptr, answer, *dofs_, R, trial.reactions);
  } else {
    trial.evaluated = nodal_force_.template evaluate_cells<false>(of_elastic_cells(grid_u), *dofs_, R, trial.reactions);
  }
  if (trial.evaluated) trial.evaluated = add_shared_forces(grid_u.data(), R, trial.reactions);
  conditions_.add_springs(t, grid_u.data(), R, trial.reactions);
  return trial.evaluated;
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::commit(TrialState& any) {
  Trial& trial = own(any);
  if (!history_dependent_) return;
  if (!trial.evaluated) throw std::logic_error("a trial state that was not evaluated since the last commit");
  trial.evaluated = false;
  if (!trial.keeps_history) return;
  for (std::size_t m = 0; m < body_.materials.size(); ++m) body_.materials[m]->commit(trial.arrays->history[m]);
  committed_u_.swap(trial.arrays->u);
  if (averages_dilatation()) committed_averages_.swap(trial.arrays->averages);
  committed_t_ = trial.t;
  committed_motion_ = trial.motion;
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::apply(Tangent kind, double t, ConstVec u, ConstVec du, Vec dR) const {
  if (kind == Tangent::stable) throw std::logic_error("the stable tangent is a matrix alone");
  spread(t, u, grid_u_);
  std::ranges::fill(grid_du_, 0.0);
  for (std::size_t k = 0; k < du.size(); ++k) grid_du_[static_cast<std::size_t>(dofs_->free[k])] = du[k];
  dofs_->extend(grid_du_.data());
  if (!elastic_cells_.empty()) {
    nodal_force_.template evaluate_cells<true>(of_elastic_cells(grid_du_), *dofs_, dR, {});
    return conditions_.add_springs_product(grid_du_.data(), dR);
  }
  const double dt = t - committed_t_;
  take_means(grid_u_.data());
  take_shares(grid_u_.data(), dt);
  take_rates_of_means(grid_u_.data(), grid_du_.data());
  const auto answer = [this, kind, dt](std::size_t m, Block& block) {
    tangent(kind, m, block, dt);
    return 0.0;
  };
  nodal_force_.template evaluate<true, true>(grid_u_.data(), committed_u_.data(), std::cref(answer), *dofs_, dR, {},
                                             grid_du_.data());
  add_shared_forces(grid_u_.data(), dR, {});
  conditions_.add_springs_product(grid_du_.data(), dR);
}

// The stiffness K_ai,bk = Σ_p V_p G_a,i,c (∂P_c/∂H_d) G_b,k,d with H_c = Σ_a,i G_a,i,c u_a,i.
template <AxisBasis B, Kinematics K>
SparseMatrix MaterialPointPhase<B, K>::matrix(Tangent kind, double t, ConstVec u) const {
  spread(t, u, grid_u_);
  std::ranges::transform(grid_u_, committed_u_, grid_du_.begin(), std::minus<>());
  const auto add_point = [&](std::size_t k, std::size_t p, CellMatrix<Dim, per_cell>& matrix) {
    const auto H = weights_.gradient(grid_u_.data(), k, p), dH = weights_.gradient(grid_du_.data(), k, p);
    const auto A = moduli_of(material_of(k), kind, H, dH, t - committed_t_, p);
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
  SparseMatrix matrix = averages_dilatation()
                            ? matrix_of_means(kind, t - committed_t_)
                            : assemble_cells<B, K>(grid_, body_.points, weights_, *dofs_, add_point).free;
  conditions_.add_springs_matrix(matrix);
  return matrix;
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::add_support_inertia(double t, double c, Vec Q) const {
  if (mass_->is_lumped()) return;
  for (std::size_t s = 0; s < held_.prescribed().size(); ++s) {
    const PrescribedMotion& motion = held_.motion(s);
    if (!motion.moves()) continue;
    const double driven = motion.acceleration(t) + c * motion.velocity(t);
    for (SparseMatrix::InnerIterator m(consistent_->prescribed, static_cast<Eigen::Index>(s)); m; ++m) {
      Q[static_cast<std::size_t>(m.row())] -= m.value() * driven;
    }
  }
}

template <AxisBasis B, Kinematics K>
double MaterialPointPhase<B, K>::stiffening(double t, ConstVec u) const {
  if (!info_.stiffens) return 1;
  if (history_dependent_) return conditions_.growth_of_springs();
  const auto largest_bound = [&] {
    double largest = 0;
    take_means(grid_u_.data());
    nodal_force_.visit(grid_u_.data(), [&](std::size_t m, Block& block) {
      average_dilatation(m, block);
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
  const double stiffening = largest_bound() / undeformed_bound_;
  // Springs do not soften with the material.
  if (!conditions_.hold_by_springs() || stiffening > conditions_.growth_of_springs()) return stiffening;
  return std::isnan(stiffening) ? stiffening : conditions_.growth_of_springs();
}

}  // namespace stillpoint
