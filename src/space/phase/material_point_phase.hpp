// Lagrangian phases for one basis and one kinematics: the semi-discrete system that the parts of a phase come to.
#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/phase_assembly.hpp"
#include "space/phase/phase_control.hpp"
#include "space/phase/phase_diagnosis.hpp"
#include "space/phase/phase_fields.hpp"
#include "space/phase/phase_shape.hpp"
#include "space/phase/phase_supports.hpp"
#include "space/phase/phase_tangents.hpp"
#include "space/phase/stage_end.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class MaterialPointPhase final : public LagrangianPhase {
  static constexpr int dim = dimensions(K);

 public:
  MaterialPointPhase(const Problem& problem, const PhaseBegin& begin)
      : LagrangianPhase({fields_, supports_, shape_, control_, diagnosis_}), all_(problem, begin) {
    info_ = all_.frame.account().describe(all_.frame.total_mass, all_.conditions.hold_by_springs());
    info_.of_small_strain = all_.frame.is_of_small_strain();
    if (all_.conditions.may_touch()) {
      info_.nonlinear = info_.may_touch = true;
      info_.stiffens = info_.stiffens || all_.frame.moves_on();
    }
    history_dependent_ = all_.frame.remembers || all_.conditions.remember();
    if (begin.carried && problem.present_stage)
      balance_begin_of_stage(*begin.carried, begin.t, problem.present_stage->ramp);
    loads_are_constant_ = all_.conditions.loads_are_constant();
    contact_ = all_.conditions.contact();
  }

  const Mass& mass() const override { return all_.inertia.mass(); }
  const Tangents& tangents() const override { return tangents_; }

  void external_force(double t, ConstVec u, Vec F) const override {
    for_each_index(F.size(), [F, constant = all_.constant_force.data()](std::size_t i) { F[i] = constant[i]; });
    const auto parts = all_.inertia.parts();
    all_.conditions.add_loads(parts, t, F);
    if (!all_.conditions.loads_follow()) return;
    const auto work = all_.force.borrow();
    all_.frame.unknowns.spread(t, u, work->u);
    all_.conditions.add_following_loads(parts, t, work->u.data(), F);
  }
  void add_support_inertia(double t, double c, Vec Q) const override { all_.inertia.add_moving_supports(t, c, Q); }

  std::unique_ptr<TrialState> make_trial() const override {
    auto trial = std::make_unique<PhaseTrial>(all_.force.borrow_trial());
    trial->of = this;
    trial->phase = all_.frame.phase;
    trial->reactions.assign(all_.frame.dofs().prescribed.size() + all_.conditions.other_reactions(), 0);
    return trial;
  }
  bool internal_force(double t, ConstVec u, Vec R, TrialState& any) const override {
    PhaseTrial& trial = own(any);
    std::vector<double>& grid_u = trial.arrays->u;
    trial.motion = all_.limit.spread_and_measure(t, u, grid_u);
    trial.t = t;
    trial.evaluated = false;
    trial.too_far = !all_.limit.allows(trial.motion, grid_u.data());
    if (trial.too_far) return false;
    trial.evaluated = all_.force.evaluate(trial, R, *all_.force.borrow());
    all_.conditions.add_force(t, grid_u.data(), R, trial.reactions);
    return trial.evaluated;
  }
  // Rigid bodies go their way as supports do.
  bool move_supports_on(double share) override {
    const bool starts_there = !all_.problem.initial_u.empty();
    if (starts_there) return false;
    const bool supports = all_.frame.unknowns.move_supports_on(share);
    return all_.conditions.move_rigid_bodies_on(share) || supports;
  }
  void commit(TrialState& any) override {
    PhaseTrial& trial = own(any);
    if (!history_dependent_) return;
    if (!std::exchange(trial.evaluated, false))
      throw std::logic_error("a trial state that was not evaluated since the last commit");
    all_.conditions.commit(trial.t, trial.arrays->u.data());
    if (all_.frame.remembers && trial.keeps_history) all_.force.commit(trial);
    all_.rest.observe(trial.reactions);
  }

  std::vector<double> initial_displacement(double t) const override {
    return project(all_.problem.initial_u, [t](const PrescribedMotion& of) { return of.displacement(t); });
  }
  std::vector<double> initial_velocity(double t) override {
    if (all_.frame.moves_on()) return all_.remap.begin_motion(t);
    std::vector<double> v = project(all_.problem.initial_v, [t](const PrescribedMotion& of) { return of.velocity(t); });
    all_.conditions.begin_motion(all_.inertia.parts(), t, v);
    return v;
  }

  // What is out of balance before the stage changes anything is no matter of the stage.
  std::unique_ptr<CarriedBody> hand_over(double t, ConstVec u, ConstVec v) override {
    PhaseFrame<B, K>& frame = all_.frame;
    const StageEnd<B, K> end(frame, all_.force);
    std::vector<TensorOf<K>> H;  // that the points have not taken into what they remember
    all_.rest.end_phase(t, u);
    if (!frame.moves_on()) {
      H = end.leave_single_phase(t, u);
    } else if (frame.is_of_small_strain()) {
      end.take_strains_in_place(t, u);
      const auto work = all_.force.borrow();
      frame.unknowns.spread(t, u, work->u);
      all_.conditions.end_phase_in_place(t, work->u.data());
    } else {
      all_.remap.end_phase(t, u, v, all_.limit.largest_motion(u));
    }
    std::unique_ptr<CarriedBodyOf<K>> carried;
    frame.with_points_of_all([&] {
      carried = std::make_unique<CarriedBodyOf<K>>(all_.problem, frame.body, frame.origin, frame.placed,
                                                   frame.is_of_small_strain(), frame.grid_moved, frame.phase, H);
    });
    all_.conditions.archive(StateArchive::saving(carried->conditions));
    carried->rest = all_.rest.record();
    if (!frame.moves_on()) return carried;
    all_.rest.wake();
    all_.begin_phase(t);
    carried->out_of_balance.assign(static_cast<std::size_t>(dim) * frame.functions_of_grid(), 0);
    const std::vector<double> Q = out_of_balance(t);
    for (std::size_t k = 0; k < Q.size(); ++k)
      carried->out_of_balance[static_cast<std::size_t>(frame.dofs().free[k])] = Q[k];
    return carried;
  }

  // Springs do not soften with the material.
  double stiffening(double t, ConstVec u) const override {
    if (!info_.stiffens) return 1;
    const double of_springs = all_.conditions.growth_of_springs();
    if (!info_.points_stiffen) return of_springs;
    const auto work = all_.force.borrow();
    all_.frame.unknowns.spread(t, u, work->u);
    const double of_points = all_.force.stiffening(*work);
    const bool springs_count = (all_.conditions.hold_by_springs() || info_.may_touch) && of_points <= of_springs;
    return springs_count ? of_springs : of_points;
  }

 private:
  // F − R when a phase begins, (n); empty if the state cannot be evaluated, which whoever evaluates it next refuses.
  std::vector<double> out_of_balance(double t) const {
    const std::vector<double> rest(size(), 0.0);
    std::vector<double> Q(size()), R(size());
    if (!MaterialPointPhase::internal_force(t, rest, R, *MaterialPointPhase::make_trial())) return {};
    MaterialPointPhase::external_force(t, rest, Q);
    for (std::size_t k = 0; k < Q.size(); ++k) Q[k] -= R[k];
    return Q;
  }
  // Lets the forces that the stage puts out of balance come on over the ramp: those by which F − R differs from what it
  // was before, which a support that is released had borne.
  void balance_begin_of_stage(const CarriedBody& carried, double t, double ramp) {
    if (!(ramp > 0)) return;
    std::vector<double> Q = out_of_balance(t);
    if (Q.empty()) return;
    const std::vector<double>& before = carried.out_of_balance;
    const auto& points = static_cast<const CarriedBodyOf<K>&>(carried);
    const std::vector<int> fields = points.fields_before(all_.problem, all_.frame.body.points, all_.frame.body.fields);
    const std::size_t of_field = static_cast<std::size_t>(dim * all_.frame.functions.count_of_field());
    for (std::size_t k = 0; k < Q.size() && !fields.empty(); ++k) {
      const auto unknown = static_cast<std::size_t>(all_.frame.dofs().free[k]);
      const int field = fields[unknown / of_field];
      const std::size_t then = static_cast<std::size_t>(std::max(field, 0)) * of_field + unknown % of_field;
      if (field >= 0 && then < before.size()) Q[k] -= before[then];
    }
    all_.conditions.let_fade(all_.inertia.parts(), t, t + ramp, Q);
  }
  PhaseTrial& own(TrialState& trial) const {
    const auto mine = dynamic_cast<PhaseTrial*>(&trial);
    if (!mine || mine->of != this || mine->phase != all_.frame.phase)
      throw std::logic_error("a trial state that was made for another phase");
    return *mine;
  }
  // The projection of a field, with what moving supports prescribe: of(motion) of each.
  template <class Of>
  std::vector<double> project(const std::vector<Expression>& field, const Of& of) const {
    const HeldUnknowns& supports = all_.frame.held();
    std::vector<double> held;
    for (std::size_t s = 0; s < supports.prescribed().size(); ++s) held.push_back(of(supports.motion(s)));
    return all_.inertia.project(field, held);
  }

  PhaseAssembly<B, K> all_;
  PhaseTangents<B, K> tangents_{all_};
  PhaseFieldsOf<B, K> fields_{all_};
  PhaseSupportsOf<B, K> supports_{all_};
  PhaseShapeOf<B, K> shape_{all_};
  PhaseControlOf<B, K> control_{all_};
  PhaseDiagnosisOf<B, K> diagnosis_{all_};
};

}  // namespace stillpoint
