// The share of damping and inertia in what a driven body is felt to bear.
//
// The work of supports, walls and loads on a body goes into its material but for ∫ Q·v dt, the work of the
// out-of-balance force Q = F − R of the free unknowns, M a = Q + D: damping takes it, or inertia, that which light
// nodes were given included, whose kinetic energy is lost from phase to phase. By virtual work along the motion that
// drives the body
//
//   share = |∫ Q·v dt| / W,   W = Σ |∫ R_s·v_s dt|  of the supports and walls that move, and of driven loads,
//                                 + |∫ F·v dt|      of the loads, which drive what falls
//
// is the mean share of damping and inertia in what these feel. A pile that is pushed into clay at 0.1 m/s with a local
// damping of α = 0 to 0.7 does between 8 and 49 times s_u, and 8 without this share, whatever α.
#include <stillpoint/damping.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "plan/catalogue.hpp"
#include "scene/driven_motion.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

// A note on the share; empty: there is nothing to say.
std::string note_on_rate_share(std::optional<double> share, const Problem& problem) {
  constexpr double negligible = 0.05;
  if (!(share.value_or(0) > negligible) || is_undamped(problem.damping.strategy)) return "";
  const StrategyInfo* strategy = catalogue().strategy(problem.damping.strategy);
  const std::string less = strategy && strategy->is_local
                               ? fmt::format(", or less than damping.alpha = {:g}", problem.damping.alpha)
                           : strategy && strategy->takes("c") ? ", or a smaller damping.c"
                                                              : "";
  const bool rests = problem.phase.rest > 0;
  return fmt::format(
      "damping and inertia{} took {:.2g} % of the work of what drives the body: reactions and driven loads may be off "
      "by "
      "as much on average; expected a slower motion{}{}",
      rests ? ", and parts that rest," : "", 100 * *share, less,
      rests ? fmt::format(", or less than phase.rest = {:g}", problem.phase.rest) : "");
}

class RateShare : public Watcher {
 public:
  /// Watches if something drives the body. The run outlives this object.
  explicit RateShare(const RunState& run);

  /// Takes a sample at each step at first, at every 64th later.
  void observe(RunState& run) override {
    if (watches_ && run.steps() >= next_) sample(run.t, run.steps(), *run.motion);
  }
  void fill(Summary& summary, const RunState& run) override;
  void archive(const StateArchive& state, RunState& run) override;

 private:
  void sample(double t, long steps, PhaseMotion& motion);
  double work_of_driving(double t, const RelaxationSystem& system) const;

  const LagrangianPhase& phase_;
  bool watches_ = false;
  long next_ = 1, samples_ = 0;
  double t_ = 0, power_ = 0, load_power_ = 0;  // time, Q·v and F·v [W] at the last sample
  double unbalanced_ = 0;                      // ∫ Q·v dt [J]
  double driving_ = 0;                         // W but for the present stroke [J]
  double of_stroke_ = 0, of_loads_ = 0;        // work in that stroke so far, of what moves and of the loads [J]
  std::vector<double> Q_;                      // (n) [N]
};

RateShare::RateShare(const RunState& run) : phase_(*run.model.phase), watches_(is_driven(run.scene)) {}

// Reactions shake about their mean, so that signs are taken off strokes of many samples.
void RateShare::sample(double t, long steps, PhaseMotion& motion) {
  constexpr long longest_interval = 64, samples_a_stroke = 64;
  next_ = steps + std::clamp(steps / longest_interval, 1L, longest_interval);
  const ConstVec v = motion.v();
  motion.evaluate(t);
  Q_.resize(v.size());
  motion.system.last_out_of_balance(t, Q_);
  const double power = sum_over(v.size(), [Q = Q_.data(), v = v.data()](std::size_t i) { return Q[i] * v[i]; });
  const ConstVec F = motion.system.last().F.span();
  const double loads = sum_over(v.size(), [F = F.data(), v = v.data()](std::size_t i) { return F[i] * v[i]; });
  unbalanced_ += 0.5 * (power_ + power) * (t - t_);
  of_loads_ += 0.5 * (load_power_ + loads) * (t - t_);
  of_stroke_ += work_of_driving(t, motion.system);
  if (++samples_ % samples_a_stroke == 0) {
    driving_ += std::abs(of_stroke_) + std::abs(of_loads_);
    of_stroke_ = of_loads_ = 0;
  }
  power_ = power;
  load_power_ = loads;
  t_ = t;
}

// The work since the last sample. Displacements of supports are known at any time, whenever the phase began.
double RateShare::work_of_driving(double t, const RelaxationSystem& system) const {
  const ConstVec reactions = system.last().trial->reactions;
  const std::vector<double> now = phase_.supports().support_displacements(t),
                            before = phase_.supports().support_displacements(t_);
  double work = sum_over(std::min(reactions.size(), now.size()),
                         [&](std::size_t s) { return reactions[s] * (now[s] - before[s]); });
  for (const WallReaction& wall : phase_.supports().wall_reactions(t)) work += wall.power * (t - t_);
  return work;
}

// There is no share if nothing is driven, or what drives did no work.
void RateShare::fill(Summary& summary, const RunState& run) {
  const double driving = driving_ + std::abs(of_stroke_) + std::abs(of_loads_);
  if (watches_ && driving > 0) summary.rate_share = std::abs(unbalanced_) / driving;
  add_note(summary, note_on_rate_share(summary.rate_share, run.scene));
}

void RateShare::archive(const StateArchive& state, RunState&) {
  state("next", next_, "samples", samples_, "t", t_, "power", power_, "unbalanced", unbalanced_, "driving", driving_,
        "of_stroke", of_stroke_, "load_power", load_power_, "of_loads", of_loads_);
}

}  // namespace

std::unique_ptr<Watcher> watch_rate_share(const RunState& run) { return std::make_unique<RateShare>(run); }

}  // namespace stillpoint
