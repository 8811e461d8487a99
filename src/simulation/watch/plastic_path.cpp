// Plastic flow, and sliding with friction, depend on the way to rest: this tells if a body yielded and slid along the
// way on which a slowly growing load takes it.
//
// A motion is a slow path itself, that of the load R(t) which its internal forces bear. If R keeps the direction of the
// loads F and grows, a ramp of them does the same, however fast it was. So two figures tell how far a motion was from
// one, with Q = F − R the out-of-balance force, Q_⊥ its part normal to F, and κ = Σ_p V_p γᵖ_p the plastic strain of
// all points:
//
//   overshoot         ∫_{Q·v<0} dκ / ∫ dκ: the share that yielded while inertia carried the body on against forces that
//                     held it back already. It grows with the settlement that is too much: on three bodies that yield,
//                     by twelve strategies, it ranks them as the difference from a slow ramp does, which neither the
//                     energy that damping takes, nor the largest kinetic energy or strain energy beside the last one
//                     do.
//   unbalanced work   ∫ r dκ / ∫ dκ · W_p/W: how far off the direction of the loads the body yielded, and how much that
//                     matters,  r = ‖Q_⊥‖/‖F‖,  W_p = Σ_p V_p √J₂ γᵖ,  W the largest ½ (|F·u| + |R·u|) + |R_s·u_s| on
//                     the way, of loads and supports: at rest W = ∫ σ : ε dV, and W_p/W is the plastic share of it.
//
// Where bodies slide with friction it is ∫ r dD/D that tells, with D = Σ A |τ| |Δa| what has gone into slip.
//
// All are 0 of a slow ramp and of an elastic body that nothing rubs. The first sees nothing of a body that yields along
// another way without going too far: under a sudden load stresses run ahead of it in waves.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

// The share of the time between two samples in which the power is negative, if it changes linearly.
double share_below_zero(double before, double after) {
  if (before >= 0 && after >= 0) return 0;
  if (before <= 0 && after <= 0) return 1;
  return std::min(before, after) / (std::min(before, after) - std::max(before, after));
}

// √J₂ of a stress; components that it does not have are 0.
double root_J2(ConstVec stress) {
  std::array<double, 6> s{};  // in space all of them
  std::copy_n(stress.begin(), std::min(stress.size(), s.size()), s.begin());
  const double p = (s[0] + s[1] + s[2]) / 3, x = s[0] - p, y = s[1] - p, z = s[2] - p;
  return std::sqrt(0.5 * (x * x + y * y + z * z) + s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
}

// A note on the overshoot; empty: there is nothing to say.
std::string note_on_overshoot(std::optional<double> overshoot) {
  constexpr double negligible = 0.005;  // with it columns of ground in scripts/map_random.py settle 1 % too much
  if (!(overshoot.value_or(0) > negligible)) return "";
  return fmt::format(
      "{:.0f} % of the plastic strain came about while inertia carried the body on against its forces: under a load "
      "that grows slowly it yields less; expected a ramp of the load, such as a factor min(t/T, 1), or more damping",
      100 * *overshoot);
}

// The ramp under which a body of this model goes slowly.
std::string slow_ramp(const Model& model) {
  constexpr int periods = 20;
  std::string ramp =
      fmt::format("a ramp of the load, such as a factor min(t/T, 1) with T = {} longest periods", periods);
  if (model.omega_1) ramp += fmt::format(", {:.3g} s", periods * 2 * std::numbers::pi / *model.omega_1);
  return ramp;
}

// D: what went into slip, of which `unbalanced` out of balance; energy: the largest kinetic one [J].
std::string note_on_sliding(double D, double unbalanced, double energy, const Model& model) {
  // Blocks on an incline and between platens under sudden loads have 0.12 to 0.6 and end 1 to 6 % off a slow ramp's
  // places, under ramps 0.004 to 0.015.
  constexpr double negligible = 0.05, small = 0.01;
  if (!(unbalanced > negligible * D) || !(unbalanced > small * energy)) return "";
  return fmt::format(
      "{:.2g} % of the work of friction was done out of balance: under a load that grows slowly bodies slide less or "
      "elsewhere, and places and forces may differ by some per cent; expected {}",
      100 * unbalanced / D, slow_ramp(model));
}

std::string note_on_unbalanced_work(std::optional<double> unbalanced_work, const Model& model) {
  // Columns of ground in scripts/map_random.py, put on at once, that end more than 1 % off a slow ramp have 0.0085 and
  // more (23 of 110 viscous, 16 of 107 auto), by a static solver 0.04 and more (12 of 100).
  const double negligible = model.static_method ? 0.03 : 0.005;
  if (!(unbalanced_work.value_or(0) > negligible)) return "";
  const std::string ramp = (model.static_method ? "solve.method = \"relaxation\" and " : "") + slow_ramp(model);
  return fmt::format(
      "{:.2g} % of the work of the loads went into plastic flow out of balance: under a load that grows slowly the "
      "body may yield along another way, and its displacement differ by 1 % and more; expected {}",
      100 * *unbalanced_work, ramp);
}

class PlasticPath : public Watcher {
 public:
  /// Watches if anything can yield here, or slide with friction, and equilibrium is asked for. The run outlives this
  /// object.
  explicit PlasticPath(const RunState& run);

  /// Takes 32 samples in a period of the body. With a static solver, which yields all at once, it takes one at the
  /// beginning and one at the end.
  void observe(RunState& run) override {
    if (watches_ && run.t >= next_) sample(run);
  }
  void end_phase(RunState& run, bool is_last) override;
  void fill(Summary& summary, const RunState& run) override;
  void fill_state(Summary& summary, RunState& run) override;
  void archive(const StateArchive& state, RunState& run) override;

 private:
  void sample(RunState& run);
  std::optional<double> overshoot() const;
  std::optional<double> unbalanced_work(double t, ConstVec u) const;
  double plastic_work(double t, ConstVec u) const;
  double across_loads(double t, const RelaxationSystem& system);
  double work(double t, const PhaseMotion& motion) const;

  /// Of what only grows: how much came about while Q·v < 0, and ∫ r.
  struct Grown {
    double first = 0, last = 0, against = 0, unbalanced = 0;
    void take(double now, double share_against, double imbalance) {
      against += share_against * (now - last);
      unbalanced += imbalance * (now - last);
      last = now;
    }
  };

  const Model& model_;
  const GivingWay& giving_way_;
  bool yields_, rubs_, watches_;
  double interval_ = 0, next_ = 0;      // time between samples, and that of the next one [s]
  double imbalance_ = 0, power_ = 0;    // r and Q·v at the last sample
  Grown yielded_, slid_;                // κ [m³], D [J]
  double earlier_work_ = 0, work_ = 0;  // W of the phases before, the largest W so far [J]
  double energy_ = 0;                   // the largest kinetic energy so far [J]
  bool begun_ = false;
  std::vector<double> Q_;  // (n) [N]
};

PlasticPath::PlasticPath(const RunState& run)
    : model_(run.model),
      giving_way_(run.giving_way),
      yields_(giving_way_.yields() && run.scene.stop.wants_equilibrium()),
      rubs_(run.scene.rubs() && run.scene.may_touch() && run.scene.stop.wants_equilibrium() && !model_.static_method),
      watches_(yields_ || rubs_) {
  if (!watches_) return;
  constexpr double samples_a_period = 32, periods_of_the_shortest = 100;  // the latter if the longest is not known
  const double period =
      2 * std::numbers::pi * (model_.omega_1 ? 1 / *model_.omega_1 : periods_of_the_shortest / model_.omega_max);
  interval_ = model_.static_method ? std::numeric_limits<double>::infinity() : period / samples_a_period;
  next_ = model_.t;
}

// With a static solver each share of its loads is there at once, and what yields under it does so out of balance with
// this share. At its start supports may stand at the end of their way beside a body that has not followed: that is
// no balance, and no work of theirs.
void PlasticPath::sample(RunState& run) {
  if (!run.options.stops) return;
  const Measurements::Figures& measured = run.measured.all();
  const double residual = measured.residual, power = measured.power;
  energy_ = std::max(energy_, measured.kinetic_energy);
  RelaxationSystem& system = run.motion->system;
  const double yielded = giving_way_.plastic_strain(), slid = rubs_ ? model_.phase->supports().friction_work() : 0,
               imbalance = model_.static_method ? std::min(residual, 1.0) / run.scene.solve.load_steps
                                                : residual * across_loads(run.t, system);
  const bool begins = !std::exchange(begun_, true);
  if (begins) {
    yielded_.first = yielded_.last = yielded;
    slid_.first = slid_.last = slid;
  } else {
    const double against = share_below_zero(power_, power), mean = 0.5 * (imbalance_ + imbalance);
    yielded_.take(yielded, against, mean);
    slid_.take(slid, against, mean);
  }
  imbalance_ = imbalance;
  power_ = power;
  if (yields_ && (!begins || !model_.static_method)) work_ = std::max(work_, earlier_work_ + work(run.t, *run.motion));
  next_ = run.t + interval_;
}

void PlasticPath::end_phase(RunState& run, bool is_last) {
  if (!watches_) return;
  if (is_last) return sample(run);
  if (!yields_) return;
  run.measured.all();
  earlier_work_ += work(run.t, *run.motion);
  work_ = std::max(work_, earlier_work_);
}

void PlasticPath::fill(Summary& summary, const RunState&) {
  summary.plastic_overshoot = overshoot();
  add_note(summary, note_on_overshoot(summary.plastic_overshoot));
}

void PlasticPath::fill_state(Summary& summary, RunState& run) {
  if (yields_) summary.unbalanced_plastic_work = unbalanced_work(run.t, run.motion->u());
  add_note(summary, note_on_unbalanced_work(summary.unbalanced_plastic_work, model_));
  add_note(summary, note_on_sliding(slid_.last - slid_.first, slid_.unbalanced, energy_, model_));
}

// Empty: nothing has yielded.
std::optional<double> PlasticPath::overshoot() const {
  if (model_.static_method || !(yielded_.last > yielded_.first)) return std::nullopt;
  return yielded_.against / (yielded_.last - yielded_.first);
}

std::optional<double> PlasticPath::unbalanced_work(double t, ConstVec u) const {
  if (!(yielded_.last > yielded_.first) || !(work_ > 0)) return std::nullopt;
  return yielded_.unbalanced / (yielded_.last - yielded_.first) * plastic_work(t, u) / work_;
}

double PlasticPath::plastic_work(double t, ConstVec u) const {
  const LagrangianPhase& phase = *model_.phase;
  const auto n = static_cast<std::size_t>(phase.info().stress_components);
  const std::vector<double>& volumes = giving_way_.volumes();
  std::vector<double> stress(n * volumes.size()), strain(volumes.size());
  phase.fields().point_stress(t, u, stress);
  phase.fields().point_history(plastic_strain_name, strain);
  return sum_over(volumes.size(), [&](std::size_t p) {
    return strain[p] > 0 ? volumes[p] * strain[p] * root_J2(ConstVec(stress).subspan(n * p, n)) : 0.0;
  });
}

// ‖Q_⊥‖/‖Q‖
double PlasticPath::across_loads(double t, const RelaxationSystem& system) {
  const ConstVec F = system.last().F.span();
  Q_.resize(F.size());
  system.last_out_of_balance(t, Q_);
  const auto product = [](ConstVec x, ConstVec y) {
    return sum_over(x.size(), [=](std::size_t i) { return x[i] * y[i]; });
  };
  const double FF = product(F, F), FQ = product(F, Q_), QQ = product(Q_, Q_);
  return FF > 0 && QQ > 0 ? std::sqrt(std::max(0.0, 1 - FQ / FF * FQ / QQ)) : 1;
}

// ½ (|F·u| + |R·u|) + |R_s·u_s|, since the phase began
double PlasticPath::work(double t, const PhaseMotion& motion) const {
  const ConstVec reactions = motion.system.last().trial->reactions;
  const std::vector<double> moved = model_.phase->supports().support_displacements(t);
  const double of_supports = sum_over(moved.size(), [&](std::size_t s) { return reactions[s] * moved[s]; });
  return 0.5 * motion.norms.work_scale(motion.u_vector) + std::abs(of_supports);
}

void PlasticPath::archive(const StateArchive& state, RunState&) {
  state("next", next_, "imbalance", imbalance_, "power", power_, "first", yielded_.first, "last", yielded_.last,
        "against", yielded_.against, "unbalanced", yielded_.unbalanced, "earlier_work", earlier_work_, "work", work_,
        "begun", begun_);
  state("first_slid", slid_.first, "last_slid", slid_.last, "slid_unbalanced", slid_.unbalanced, "energy", energy_);
}

}  // namespace

std::unique_ptr<Watcher> watch_plastic_path(const RunState& run) { return std::make_unique<PlasticPath>(run); }

}  // namespace stillpoint
