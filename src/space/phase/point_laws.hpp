// The laws of the points, block by block, with each point's own change of volume or with a mean that points share.
//
// Means over cells are computed within a block of points, including their forces. Means over splines take three passes
// over the points: the coefficients of J̄, take_means(); the laws, whose a/J̄ are summed; and the forces of these sums,
// add_shared_forces().
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <vector>

#include "scene/point_sums.hpp"
#include "space/kernels/mean_dilatation.hpp"
#include "space/kernels/nodal_force.hpp"
#include "space/kernels/spline_means.hpp"
#include "space/phase/law_gradients.hpp"
#include "space/phase/phase_frame.hpp"
#include "space/phase/phase_trial.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class PointLaws {
  static constexpr int dim = dimensions(K);
  using Block = PointBlock<K>;
  using Pass = SplinePass<B, K>;

 public:
  struct Work {
    typename SplineMeans<B, K>::Sums sums;
    // Coefficients of means over splines: of the state, its shares, and their derivatives.
    std::vector<double> means, shares, rates_of_means, rates_of_shares;
    std::vector<double> shared_forces;                // (n + supports)
    std::vector<std::vector<double>> unread_history;  // of each material, that stress() writes and nothing reads
    typename NodalForce<B, K>::Work nodal;
  };

  /// The arguments must outlive this object. committed: its `averages` are set here.
  PointLaws(const PhaseFrame<B, K>& frame, const NodalForce<B, K>& points, CommittedState& committed)
      : frame_(frame), points_(points), committed_(committed) {}

  bool share_dilatation() const { return averages_dilatation(frame_.problem); }
  bool share_over_splines() const { return means_over_splines(frame_.problem); }

  /// Prepares the means of a phase.
  void begin_phase() {
    if constexpr (dim > 1) {
      if (!share_dilatation()) return;
      if (share_over_splines()) {
        splines_.rebuild(frame_.grid, frame_.body.points, frame_.ranks);
      } else {
        volume_share_ = CellSums<K>::volume_shares(frame_.body.points);
      }
    }
  }
  /// Sets the effect of averaging in the committed state.
  void commit_averages(Work& work) {
    if constexpr (dim > 1) {
      if (!share_dilatation()) return;
      take_means(committed_.u.data(), work);
      committed_.averages.resize(frame_.body.points.size());
      points_.visit(committed_.u.data(), [&](std::size_t m, Block& block) {
        with_means(m, block, {.means = &work.means}, work, [&](auto& mean) {
          mean.average(block);
          mean.write_effect(block, committed_.averages.data() + block.first);
        });
      });
    }
  }
  /// Gives work arrays their sizes in the present phase.
  void prepare(Work& work) const {
    if (!share_dilatation()) return;
    if (share_over_splines()) {
      splines_.resize(work.sums);
      for (auto* coefficients : {&work.shares, &work.rates_of_means}) coefficients->assign(splines_.functions(), 0);
    }
    if (!frame_.remembers) return;
    work.unread_history.resize(frame_.body.materials.size());
    for (std::size_t m = 0; m < work.unread_history.size(); ++m)
      work.unread_history[m].resize(frame_.body.materials[m]->info().history_size);
  }

  /// Averages block.H for the law of material m; for means over splines take_means() has to come before.
  void average(std::size_t m, Block& block, Work& work) const {
    if constexpr (dim > 1) {
      if (share_dilatation())
        with_means(m, block, {.means = &work.means}, work, [&](auto& mean) { mean.average(block); });
    }
  }
  /// Computes the coefficients of means for the displacement u over the grid's functions.
  void take_means(const double* u, Work& work) const {
    if constexpr (dim > 1) {
      if (!share_over_splines()) return;
      points_.visit(u, [&](std::size_t m, Block& block) {
        typename Block::Row J;
        ChangeOfVolume<K>::of_block(block, is_finite(m), J);
        add_means_of(block, J, work);
      });
      splines_.coefficients(work.sums, work.means);
    }
  }
  /// Computes the derivative of the means' coefficients along du.
  void take_rates_of_means(const double* u, const double* du, Work& work) const {
    if constexpr (dim > 1) {
      if (!share_over_splines()) return;
      const auto add_rates = [&](std::size_t m, Block& block) {
        typename Block::Row dJ;
        ChangeOfVolume<K>::rate(block, is_finite(m), dJ);
        add_means_of(block, dJ, work);
      };
      points_.template visit<false, true>(u, std::cref(add_rates), nullptr, du);
      splines_.coefficients(work.sums, work.rates_of_means);
    }
  }
  /// Computes the coefficients of the shares, the laws' a/J̄ in the state u, which derivatives at finite strain need.
  void take_shares(const double* u, double dt, Work& work) const {
    if constexpr (dim > 1) {
      const auto finite = [](const auto& material) { return material->info().finite_strain; };
      if (!share_over_splines() || std::ranges::none_of(frame_.body.materials, finite)) return;
      const auto add_shares = [&](std::size_t m, Block& block) {
        with_means(m, block, {.means = &work.means}, work, [&](auto& mean) {
          mean.average(block, committed_.averages.data() + block.first, nullptr);
          law(m).stress(block, volumes(), dt, unread_history(m, work));
          mean.keep_stress(block);
        });
      };
      points_.template visit<true>(u, std::cref(add_shares), committed_.u.data());
      splines_.coefficients(work.sums, work.shares);
    }
  }

  /// Sets block.VP = V P, as PointMaterial::stress() does.
  template <bool Increments>
  double stress(std::size_t m, Block& block, double dt, double* history, [[maybe_unused]] double* averages,
                [[maybe_unused]] Work& work) const {
    if constexpr (dim > 1) {
      if (share_dilatation()) {
        return with_means(m, block, {.means = &work.means}, work, [&](auto& mean) {
          if constexpr (Increments) {
            mean.average(block, committed_.averages.data() + block.first, averages ? averages + block.first : nullptr);
          } else {
            mean.average(block);
          }
          const double bad = law(m).stress(block, volumes(), dt, history);
          mean.transform_stress(block);
          return bad;
        });
      }
    }
    return law(m).stress(block, volumes(), dt, history);
  }
  /// Sets block.VP = V δP; for means over splines take_means(), take_shares() and take_rates_of_means() have to come
  /// before.
  void tangent(Tangent kind, std::size_t m, Block& block, double dt, [[maybe_unused]] Work& work) const {
    if constexpr (dim > 1) {
      if (share_dilatation()) {
        return with_means(m, block,
                          {.means = &work.means, .shares = &work.shares, .rates_of_means = &work.rates_of_means}, work,
                          [&](auto& mean) {
                            mean.average(block, committed_.averages.data() + block.first, nullptr);
                            law(m).stress(block, volumes(), dt, unread_history(m, work));
                            mean.keep_stress(block);
                            mean.average_direction(block);
                            law(m).tangent(kind, block, volumes(), dt);
                            mean.transform_tangent(block);
                          });
      }
    }
    law(m).tangent(kind, block, volumes(), dt);
  }
  /// Adds the forces of the shares that all blocks have summed in their stress() or tangent() under u. Returns false if
  /// they are not finite.
  bool add_shared_forces(const double* u, Vec R, Vec reactions, Work& work) const {
    if constexpr (dim > 1) {
      if (!share_over_splines()) return true;
      splines_.coefficients(work.sums, work.rates_of_shares);
      const Pass pass(splines_, volumes(), {}, nullptr);
      const auto push = [&](std::size_t m, Block& block) {
        typename Block::Row share;
        pass.write_shares(block, work.rates_of_shares, share);
        return ChangeOfVolume<K>::write_push(block, is_finite(m), share);
      };
      work.shared_forces.resize(R.size() + frame_.dofs().prescribed.size());
      const Vec forces = Vec(work.shared_forces).first(R.size()),
                at_supports = Vec(work.shared_forces).subspan(R.size());
      const bool finite =
          points_.template evaluate<false>(u, nullptr, std::cref(push), frame_.dofs(), forces, at_supports, work.nodal);
      for_each_index(R.size(), [R, forces](std::size_t i) { R[i] += forces[i]; });
      for (std::size_t s = 0; s < std::min(reactions.size(), at_supports.size()); ++s) reactions[s] += at_supports[s];
      return finite;
    }
    return true;
  }

  /// The averaging of the points' gradients under u over the grid's functions.
  SharedDilatation<B, K> shared_dilatation(const double* u, Work& work) const {
    take_means(u, work);
    return {.over_cells = share_dilatation() && !share_over_splines(),
            .splines = share_over_splines() ? &splines_ : nullptr,
            .means = work.means};
  }
  /// The arrays that are stored for each point.
  std::vector<PointArray> arrays() const {
    constexpr double real = sizeof(double);
    std::vector<PointArray> arrays;
    if (!share_dilatation()) return arrays;
    if (share_over_splines()) {
      std::ranges::copy(SplineMeans<B, K>::arrays(), std::back_inserter(arrays));
    } else {
      arrays.push_back({"share of the cell's volume", real});
    }
    arrays.push_back({"change of volume, averaged", (frame_.remembers ? 2 : 1) * real});
    double history = 0;
    for (const auto& material : frame_.body.materials)
      history += frame_.remembers ? static_cast<double>(material->info().history_size) : 0;
    const auto points = static_cast<double>(frame_.body.numbers());
    if (history > 0) arrays.push_back({"history, of tangents", history * real / points});
    return arrays;
  }

  const SplineMeans<B, K>& splines() const { return splines_; }
  const std::vector<double>& volume_share() const { return volume_share_; }
  const PointMaterial<K>& law(std::size_t m) const { return *frame_.body.materials[m]; }
  bool is_finite(std::size_t m) const { return law(m).info().finite_strain; }
  const double* volumes() const { return frame_.body.points.volume.data(); }
  /// A history that stress() may write and nothing reads.
  double* unread_history(std::size_t m, Work& work) const {
    return work.unread_history.empty() ? nullptr : work.unread_history[m].data();
  }

 private:
  // Calls use(MeanDilatation) for a block of material m.
  template <class Use>
  auto with_means(std::size_t m, [[maybe_unused]] const Block& block,
                  [[maybe_unused]] const typename Pass::Known& known, [[maybe_unused]] Work& work,
                  const Use& use) const {
    if (share_over_splines()) {
      MeanDilatation<K, Pass> mean({splines_, volumes(), known, &work.sums}, is_finite(m));
      return use(mean);
    }
    MeanOverCells<K> mean({frame_.body.points, volume_share_.data() + block.first}, is_finite(m));
    return use(mean);
  }
  void add_means_of(const Block& block, typename Block::Row& x, Work& work) const {
    const double* V = volumes() + block.first;
    for (std::size_t q = 0; q < block.count; ++q) x[q] *= V[q];
    splines_.add(block, x, work.sums);
  }

  const PhaseFrame<B, K>& frame_;
  const NodalForce<B, K>& points_;
  CommittedState& committed_;
  std::vector<double> volume_share_;  // V/W of each point in its cell, with means over cells
  SplineMeans<B, K> splines_;
};

}  // namespace stillpoint
