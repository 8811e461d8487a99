// The laws of a phase with each point's own change of volume, or with a mean that points share.
//
// Means over cells are computed within a block of points, including their forces. Means over splines take three passes
// over the points: the coefficients of J̄, take_means(); the laws, whose a/J̄ are summed; and the forces of these sums,
// add_shared_forces().
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "space/kernels/gather_scatter_bilinear.hpp"
#include "space/kernels/mean_dilatation.hpp"
#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

// Calls use(MeanDilatation) for a block of material m.
template <AxisBasis B, Kinematics K>
template <class Use>
auto MaterialPointPhase<B, K>::with_means(std::size_t m, [[maybe_unused]] const Block& block,
                                          [[maybe_unused]] const typename SplinePass<B, K>::Known& known,
                                          const Use& use) const {
  const bool finite = body_.materials[m]->info().finite_strain;
  if (means_over_splines()) {
    MeanDilatation<K, SplinePass<B, K>> mean({splines_, body_.points.volume.data(), known}, finite);
    return use(mean);
  }
  MeanOverCells<K> mean({body_.points, volume_share_.data() + block.first}, finite);
  return use(mean);
}

// Averages block.H for the law of material m; for means over splines take_means() has to come before.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::average_dilatation([[maybe_unused]] std::size_t m, [[maybe_unused]] Block& block) const {
  if constexpr (Dim > 1) {
    if (averages_dilatation()) with_means(m, block, {.means = &means_}, [&](auto& mean) { mean.average(block); });
  }
}

// Computes the coefficients of means for the displacement u over the grid's functions.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::take_means([[maybe_unused]] const double* u) const {
  if constexpr (Dim > 1) {
    if (!means_over_splines()) return;
    nodal_force_.visit(u, [this](std::size_t m, Block& block) {
      typename Block::Row J;
      ChangeOfVolume<K>::of_block(block, body_.materials[m]->info().finite_strain, J);
      add_means_of(block, J);
    });
    splines_.coefficients(means_);
  }
}

// Computes the derivative of the means' coefficients along du.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::take_rates_of_means([[maybe_unused]] const double* u,
                                                   [[maybe_unused]] const double* du) const {
  if constexpr (Dim > 1) {
    if (!means_over_splines()) return;
    const auto add_rates = [this](std::size_t m, Block& block) {
      typename Block::Row dJ;
      ChangeOfVolume<K>::rate(block, body_.materials[m]->info().finite_strain, dJ);
      add_means_of(block, dJ);
    };
    nodal_force_.template visit<false, true>(u, add_rates, nullptr, du);
    splines_.coefficients(rates_of_means_);
  }
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::add_means_of(const Block& block, typename Block::Row& x) const {
  const double* V = body_.points.volume.data() + block.first;
  for (std::size_t q = 0; q < block.count; ++q) x[q] *= V[q];
  splines_.add(block, x);
}

// Computes the coefficients of the shares, the laws' a/J̄ in the state u, which derivatives at finite strain need.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::take_shares([[maybe_unused]] const double* u, [[maybe_unused]] double dt) const {
  if constexpr (Dim > 1) {
    const auto finite = [](const auto& material) { return material->info().finite_strain; };
    if (!means_over_splines() || std::ranges::none_of(body_.materials, finite)) return;
    const auto add_shares = [&](std::size_t m, Block& block) {
      with_means(m, block, {.means = &means_}, [&](auto& mean) {
        mean.average(block, committed_averages_.data() + block.first, nullptr);
        body_.materials[m]->stress(block, body_.points.volume.data(), dt, scratch_history(m));
        mean.keep_stress(block);
      });
    };
    nodal_force_.template visit<true>(u, add_shares, committed_u_.data());
    splines_.coefficients(shares_);
  }
}

// Adds the forces of the shares that all blocks have summed in their stress() or tangent() under u. Returns false if
// they are not finite.
template <AxisBasis B, Kinematics K>
bool MaterialPointPhase<B, K>::add_shared_forces([[maybe_unused]] const double* u, [[maybe_unused]] Vec R,
                                                 [[maybe_unused]] Vec reactions) const {
  if constexpr (Dim > 1) {
    if (!means_over_splines()) return true;
    splines_.coefficients(rates_of_shares_);
    const SplinePass<B, K> pass(splines_, body_.points.volume.data(), {});
    const auto push = [&](std::size_t m, Block& block) {
      typename Block::Row share;
      pass.write_shares(block, rates_of_shares_, share);
      return ChangeOfVolume<K>::write_push(block, body_.materials[m]->info().finite_strain, share);
    };
    shared_forces_.resize(R.size() + dofs_->prescribed.size());
    const Vec forces = Vec(shared_forces_).first(R.size()), at_supports = Vec(shared_forces_).subspan(R.size());
    const bool finite = nodal_force_.template evaluate<false>(u, nullptr, std::cref(push), *dofs_, forces, at_supports);
    for_each_index(R.size(), [R, forces](std::size_t i) { R[i] += forces[i]; });
    for (std::size_t s = 0; s < std::min(reactions.size(), at_supports.size()); ++s) reactions[s] += at_supports[s];
    return finite;
  }
  return true;
}

// Prepares the means of a phase, and the effect of averaging in the committed state.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::begin_means() {
  if constexpr (Dim > 1) {
    if (!averages_dilatation()) return;
    if (means_over_splines()) {
      splines_.rebuild(grid_, body_.points);
      for (auto* coefficients : {&shares_, &rates_of_means_}) coefficients->assign(splines_.functions(), 0);
      take_means(committed_u_.data());
    } else {
      volume_share_ = CellSums<K>::volume_shares(body_.points);
    }
    committed_averages_.resize(body_.points.size());
    nodal_force_.visit(committed_u_.data(), [this](std::size_t m, Block& block) {
      with_means(m, block, {.means = &means_}, [&](auto& mean) {
        mean.average(block);
        mean.write_effect(block, committed_averages_.data() + block.first);
      });
    });
    if (!history_dependent_) return;
    scratch_history_.resize(body_.materials.size());
    for (std::size_t m = 0; m < body_.materials.size(); ++m)
      scratch_history_[m].resize(body_.materials[m]->info().history_size);
  }
}

// The averaging of the points' gradients under u over the grid's functions, which must outlive the result.
template <AxisBasis B, Kinematics K>
SharedDilatation<B, K> MaterialPointPhase<B, K>::shared_dilatation(const double* u) const {
  take_means(u);
  return {.over_cells = averages_dilatation() && !means_over_splines(),
          .splines = means_over_splines() ? &splines_ : nullptr,
          .means = means_};
}

// Sets block.VP = V P, as PointMaterial::stress() does.
template <AxisBasis B, Kinematics K>
template <bool Increments>
double MaterialPointPhase<B, K>::stress(std::size_t m, Block& block, double dt, double* history,
                                        [[maybe_unused]] double* averages) const {
  const PointMaterial<K>& law = *body_.materials[m];
  const double* V = body_.points.volume.data();
  if constexpr (Dim > 1) {
    if (averages_dilatation()) {
      return with_means(m, block, {.means = &means_}, [&](auto& mean) {
        if constexpr (Increments) {
          mean.average(block, committed_averages_.data() + block.first, averages ? averages + block.first : nullptr);
        } else {
          mean.average(block);
        }
        const double bad = law.stress(block, V, dt, history);
        mean.transform_stress(block);
        return bad;
      });
    }
  }
  return law.stress(block, V, dt, history);
}

// Sets block.VP = V δP; for means over splines take_means(), take_shares() and take_rates_of_means() have to come
// before.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::tangent(Tangent kind, std::size_t m, Block& block, double dt) const {
  const PointMaterial<K>& law = *body_.materials[m];
  const double* V = body_.points.volume.data();
  if constexpr (Dim > 1) {
    if (averages_dilatation()) {
      return with_means(m, block, {.means = &means_, .shares = &shares_, .rates_of_means = &rates_of_means_},
                        [&](auto& mean) {
                          mean.average(block, committed_averages_.data() + block.first, nullptr);
                          law.stress(block, V, dt, scratch_history(m));
                          mean.keep_stress(block);
                          mean.average_direction(block);
                          law.tangent(kind, block, V, dt);
                          mean.transform_tangent(block);
                        });
    }
  }
  law.tangent(kind, block, V, dt);
}

// A history that stress() may write and nothing reads.
template <AxisBasis B, Kinematics K>
double* MaterialPointPhase<B, K>::scratch_history(std::size_t m) const {
  return scratch_history_.empty() ? nullptr : scratch_history_[m].data();
}

}  // namespace stillpoint
