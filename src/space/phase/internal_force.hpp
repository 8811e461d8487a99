// The internal force R(u) of a phase, its tangent, and the commit of an accepted step.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <functional>
#include <limits>
#include <mutex>
#include <vector>

#include "scene/point_sums.hpp"
#include "space/grid/shortest_side.hpp"
#include "space/kernels/elastic_cells.hpp"
#include "space/kernels/nodal_force.hpp"
#include "space/phase/matrix_of_means.hpp"
#include "space/phase/matrix_of_points.hpp"
#include "space/phase/phase_frame.hpp"
#include "space/phase/phase_trial.hpp"
#include "space/phase/point_laws.hpp"

namespace stillpoint {

/// Evaluations are const, and several threads may make them at the same time, each with work arrays of its own. u, du:
/// over the grid's functions, (functions × dim); R, dR: (n).
template <AxisBasis B, Kinematics K>
class InternalForce {
  static constexpr int dim = dimensions(K), per_cell = PointWeights<B, K>::per_cell;
  static constexpr int components = stillpoint::gradient_components(K);
  static constexpr bool has_elastic_cells =
      (K == Kinematics::plane || K == Kinematics::space) && std::same_as<B, BSpline<1>>;
  using Block = PointBlock<K>;
  using Answer = typename NodalForce<B, K>::Answer;

 public:
  struct Work : PointLaws<B, K>::Work {
    long phase = -1;  // that the arrays have the sizes of
    std::vector<double> u, du;
  };
  using Loan = typename WorkPool<Work>::Loan;

  /// frame: must outlive this object.
  explicit InternalForce(const PhaseFrame<B, K>& frame) : frame_(frame) {}

  // --- a phase begins ------------------------------------------------------------------------------
  /// Prepares for the points in their present order: blocks can be visited.
  void take_points() { points_.rebuild(frame_.body.points, frame_.weights, frame_.corner_sum); }
  /// As NodalForce::let_rest().
  void let_rest(const std::vector<char>& cells) { points_.let_rest(cells); }
  /// Prepares evaluations in the phase that begins at t.
  void begin_phase(double t) {
    committed_.u.resize(static_cast<std::size_t>(dim) * frame_.functions_of_grid());
    frame_.unknowns.spread_start(committed_.u);
    committed_.t = t;
    committed_.motion = 0;
    laws_.begin_phase();
    laws_.commit_averages(*borrow());
    take_elastic_moments();
    if (undeformed_bound_ == 0 && points_stiffen()) undeformed_bound_ = bound_at_rest();
  }

  /// The laws have yet to answer to the committed stresses: since the last commit they are others, or the stresses were
  /// given to them, and some may lie outside a yield surface.
  void take_new_materials() { materials_are_new_ = true; }

  const PointLaws<B, K>& laws() const { return laws_; }
  /// The loops over blocks of points.
  const NodalForce<B, K>& points() const { return points_; }
  const CommittedState& committed() const { return committed_; }
  /// Saves or restores the state of the last commit.
  void archive(const StateArchive& state) {
    state("committed_u", Vec(committed_.u));
    state("committed_t", committed_.t);
    state("materials_are_new", materials_are_new_);
    if (state.restores()) laws_.commit_averages(*borrow());
  }
  /// Work arrays of the present phase; those over the functions are 0 where no unknown is.
  Loan borrow() const {
    Loan work = works_.borrow();
    if (work->phase == frame_.phase && work->u.size() == committed_.u.size()) return work;
    work->phase = frame_.phase;
    work->u.assign(committed_.u.size(), 0);
    work->du.assign(committed_.u.size(), 0);
    laws_.prepare(*work);
    return work;
  }
  WorkPool<TrialArrays>::Loan borrow_trial() const {
    auto arrays = trials_.borrow();
    arrays->u.assign(committed_.u.size(), 0);
    size_histories(*arrays);
    arrays->holds_rest_of = -1;
    if (laws_.share_dilatation() && frame_.remembers) arrays->averages.resize(frame_.body.points.size());
    return arrays;
  }
  /// Histories of each material that the trials of a phase that has ended need no more.
  std::vector<std::vector<double>>& unused_histories() {
    TrialArrays& dead = trials_.first();
    size_histories(dead);
    return dead.history;
  }

  // --- R(u) and its commit ---------------------------------------------------------------------------
  /// Computes R at the displacements that the trial holds, and the trial's history. Returns false if some stress is not
  /// finite.
  bool evaluate(PhaseTrial& trial, Vec R, Work& work) const {
    const double* u = trial.arrays->u.data();
    const DegreesOfFreedom& dofs = frame_.dofs();
    laws_.take_means(u, work);
    trial.keeps_history = true;
    bool good = false;
    if (stands_as_committed(trial)) {
      trial.keeps_history = false;
      const auto answer = [this](std::size_t m, Block& block) {
        return laws_.law(m).committed_stress(block, laws_.volumes());
      };
      good = points_.template evaluate<false>(u, nullptr, answer, dofs, R, trial.reactions, work.nodal);
    } else if (frame_.remembers) {
      const double dt = trial.t - committed_.t;
      double* const averages = laws_.share_dilatation() ? trial.arrays->averages.data() : nullptr;
      const auto answer = [this, dt, history = trial.arrays->history.data(), averages, &work](std::size_t m,
                                                                                              Block& block) {
        return laws_.template stress<true>(m, block, dt, history[m].data(), averages, work);
      };
      const Answer at_rest = [this, history = trial.arrays->history.data()](std::size_t m, Block& block) {
        laws_.law(m).keep_history(block, history[m].data());
        return laws_.law(m).committed_stress(block, laws_.volumes());
      };
      const bool knows_rest = trial.arrays->holds_rest_of == frame_.phase && !points_.misses_forces_at_rest(work.nodal);
      good = points_.template evaluate<true>(u, committed_.u.data(), std::cref(answer), knows_rest ? nullptr : &at_rest,
                                             dofs, R, trial.reactions, work.nodal);
      trial.arrays->holds_rest_of = frame_.phase;
    } else if (elastic_cells_.empty()) {
      const Answer answer = [this, &work](std::size_t m, Block& block) {
        return laws_.template stress<false>(m, block, 0, nullptr, nullptr, work);
      };
      good = points_.template evaluate<false>(u, nullptr, answer,
                                              points_.misses_forces_at_rest(work.nodal) ? &answer : nullptr, dofs, R,
                                              trial.reactions, work.nodal);
    } else {
      good = points_.template evaluate_cells<false>(of_elastic_cells(u), dofs, R, trial.reactions, work.nodal);
    }
    heed_laws();
    return good && laws_.add_shared_forces(u, R, trial.reactions, work);
  }
  void commit(PhaseTrial& trial) {
    for (std::size_t m = 0; m < frame_.body.materials.size(); ++m)
      frame_.body.materials[m]->commit(trial.arrays->history[m]);
    committed_.u.swap(trial.arrays->u);
    if (laws_.share_dilatation()) committed_.averages.swap(trial.arrays->averages);
    committed_.t = trial.t;
    committed_.motion = trial.motion;
    materials_are_new_ = false;
  }

  // --- the tangent at work.u -------------------------------------------------------------------------
  /// dR = K du for the direction work.du.
  void apply(Tangent kind, double t, Vec dR, Work& work) const {
    const DegreesOfFreedom& dofs = frame_.dofs();
    const double *u = work.u.data(), *du = work.du.data();
    if (!elastic_cells_.empty()) {
      points_.template evaluate_cells<true>(of_elastic_cells(du), dofs, dR, {}, work.nodal);
      return;
    }
    const double dt = t - committed_.t;
    laws_.take_means(u, work);
    laws_.take_shares(u, dt, work);
    laws_.take_rates_of_means(u, du, work);
    const auto answer = [&](std::size_t m, Block& block) {
      laws_.tangent(kind, m, block, dt, work);
      return 0.0;
    };
    points_.template evaluate<true, true>(u, committed_.u.data(), std::cref(answer), dofs, dR, {}, work.nodal, du);
    heed_laws();
    laws_.add_shared_forces(u, dR, {}, work);
  }
  /// The tangent as a matrix, (n × n); from: as matrix_of_points(), which points that share their dilatation do not
  /// heed.
  SparseMatrix matrix(Tangent kind, double t, Work& work, const std::vector<double>* from = nullptr) const {
    const double dt = t - committed_.t;
    if constexpr (dim > 1) {
      if (laws_.share_dilatation()) {
        MatrixOfMeans<B, K> with_means(kind, dt, work.u.data(), frame_, laws_, committed_, work);
        return laws_.share_over_splines() ? with_means.over_splines() : with_means.over_cells();
      }
    }
    std::ranges::transform(work.u, committed_.u, work.du.begin(), std::minus<>());
    return matrix_of_points(frame_, kind, dt, work.u, work.du, from);
  }
  /// The largest stiffness bound of a point at work.u, as a frequency in its cell, over that when the run began.
  double stiffening(Work& work) const { return largest_bound(work) / undeformed_bound_; }

  /// The memory of elastic cells [bytes]; 0 if there are none.
  double bytes_of_elastic_cells() const { return elastic_cells_.empty() ? 0 : elastic_cells_.bytes(); }

 private:
  // What a law has met is thrown here, outside the parallel loops.
  void heed_laws() const {
    for (const auto& law : frame_.body.materials) law->throw_what_failed();
  }
  void size_histories(TrialArrays& arrays) const {
    arrays.history.resize(frame_.body.materials.size());
    for (std::size_t m = 0; m < arrays.history.size(); ++m)
      arrays.history[m].resize(frame_.body.materials[m]->info().history_size);
  }
  bool some_law_is_finite() const {
    return std::ranges::any_of(frame_.body.materials, [](const auto& law) { return law->info().finite_strain; });
  }
  bool points_stiffen() const {
    return some_law_is_finite() &&
           (!frame_.remembers ||
            std::ranges::any_of(frame_.body.materials, [](const auto& law) { return law->info().needs_pressure; }));
  }
  // In bilinear or trilinear cells with R(u) = K u, the points are needed only by their moments.
  void take_elastic_moments() {
    if constexpr (has_elastic_cells) {
      if (!moments_stand_in_for_points(frame_.problem, frame_.remembers || some_law_is_finite())) return;
      std::vector<typename ElasticCells<dim>::Moduli> moduli;
      for (std::size_t m = 0; m < frame_.body.materials.size(); ++m) {
        const auto p = static_cast<std::size_t>(frame_.body.points.material_begin[m]);
        const auto A = laws_.law(m).moduli(Tangent::elastic, {}, {}, 0, p);  // for xx, xy, …, row by row
        moduli.push_back({.normal = A[0], .cross = A[dim + 1], .shear = A[components + 1]});
      }
      elastic_cells_.rebuild(frame_.body.points, frame_.weights, std::move(moduli), laws_.share_dilatation());
    }
  }
  auto of_elastic_cells(const double* u) const {
    return [this, u](std::size_t begin, std::size_t end, double* corner) {
      return elastic_cells_.forces(u, begin, end, corner);
    };
  }

  // Whether the trial is at the beginning of a phase after the first, where the committed stresses still hold.
  bool stands_as_committed(const PhaseTrial& trial) const {
    const bool begins = !materials_are_new_ && frame_.remembers && frame_.phase > 0 &&
                        trial.t == frame_.held().start() && trial.t == committed_.t;
    return begins && !laws_.share_dilatation() &&
           std::ranges::all_of(frame_.body.materials, [](const auto& law) { return law->info().stress_stays; }) &&
           std::ranges::all_of(trial.arrays->u, [](double u) { return u == 0; });
  }

  // 1/(ρ h²) with the shortest side h of the block's cells: what makes a frequency of a modulus.
  double per_modulus(std::size_t m, const Block& block) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = block.first_cell; k < block.last_cell; ++k)
      shortest = std::min(shortest, shortest_side(frame_.grid, frame_.grid.cell_at(frame_.body.points.cell[k])));
    return 1 / (frame_.body.smallest_density[m] * shortest * shortest);
  }
  double largest_bound(Work& work) const {
    double largest = 0;
    std::mutex largest_is_written;
    laws_.take_means(work.u.data(), work);
    points_.visit(work.u.data(), [&](std::size_t m, Block& block) {
      laws_.average(m, block, work);
      const double bound = laws_.law(m).stiffness_bound(block) * per_modulus(m, block);
      const std::scoped_lock lock(largest_is_written);
      largest = bound <= largest ? largest : bound;
    });
    return largest_of_all(frame_.ranks, largest);
  }
  double bound_at_rest() const {
    const Loan work = borrow();
    std::ranges::fill(work->u, 0.0);
    return largest_bound(*work);
  }

  const PhaseFrame<B, K>& frame_;
  NodalForce<B, K> points_;
  CommittedState committed_;
  bool materials_are_new_ = false;
  PointLaws<B, K> laws_{frame_, points_, committed_};
  ElasticCells<has_elastic_cells ? dim : 2> elastic_cells_;  // for a linear body in bilinear or trilinear cells
  double undeformed_bound_ = 0;                              // largest_bound() of the points as placed [1/s²]
  WorkPool<Work> works_;
  WorkPool<TrialArrays> trials_;
};

}  // namespace stillpoint
