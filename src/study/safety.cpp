#include <stillpoint/safety.hpp>
#include <stillpoint/simulation.hpp>
#include <stillpoint/state_archive.hpp>
#include <stillpoint/static_solution.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <omp.h>

#include "base/stop_request.hpp"
#include "base/stopwatch.hpp"
#include "output/point_fields.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/parts.hpp"
#include "simulation/thread_choice.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "study/rest_or_motion.hpp"
#include "study/setting.hpp"
#include "study/strength_reduction.hpp"

namespace stillpoint {
namespace {

// Unknowns for which a factor of K is quick to have.
constexpr std::size_t most_for_newton_in_plane = 200'000, most_for_newton_in_space = 15'000;

double largest_length(ConstVec vectors, std::size_t dim) {
  double largest = 0;
  for (std::size_t p = 0; p < vectors.size(); p += dim) {
    double square = 0;
    for (std::size_t d = 0; d < dim; ++d) square += vectors[p + d] * vectors[p + d];
    largest = std::max(largest, square);
  }
  return std::sqrt(largest);
}

std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

/// The body with the strength of the first factor, and what it does with less.
class ReducedBody {
 public:
  /// Throws SceneError if it does not come to rest.
  ReducedBody(const Scene& scene, const SafetyOptions& options)
      : scene_(changed(scene,
                       [&](Problem& problem) {
                         problem = with_strength_over(std::move(problem), options.from);
                         problem.output.snapshots.clear();
                         problem.output.fields_every = 0;
                         problem.checkpoint = {};
                       })),
        options_(options),
        simulation_(scene_, {.threads = options.threads, .interrupted = options.interrupted}) {
    simulation_.run();
    const Summary summary = simulation_.summary();
    first_ = {.factor = options.from, .evaluations = summary.rhs_evaluations, .wall_s = wall_.seconds()};
    if (summary.status == RunStatus::interrupted) {
      first_.reason = "interrupted by the user";
      return;
    }
    if (summary.status != RunStatus::equilibrium)
      throw_scene_error("",
                        fmt::format("with a strength over {:g} the body does not come to an equilibrium, from which "
                                    "a factor of safety begins: {}",
                                    options.from, summary.reason));
    if (!simulation_.loads_settled())
      throw_scene_error(
          "", "loads still change when the body has come to rest; expected loads that have come to their end");
    u_.assign(simulation_.u().begin(), simulation_.u().end());
    if (const double strain = largest_strain(u_); strain > too_much)
      throw_scene_error("",
                        fmt::format("with a strength over {:g} the body rests only strained by {:.0f} % in a single "
                                    "phase, whose grid then bears what the ground does not; expected a smaller factor",
                                    options.from, 100 * strain));
    first_.verdict = SafetyVerdict::rests;
    first_.reason = summary.reason;
    phase().control().archive(StateArchive::saving(at_rest_));
    points_ = field("u", u_);
    plastic_strain_ = plastic_strain(u_);
  }

  const SafetyTrial& first() const { return first_; }
  std::vector<std::string> notes() { return simulation_.summary().notes; }

  /// The body with its strength over `factor`, from the equilibrium with the first one.
  SafetyTrial try_factor(double factor) {
    const ThreadScope scope(threads());
    const Stopwatch watch;
    SafetyTrial trial{.factor = factor};
    std::string of_newton;
    if (uses_newton()) {
      begin(factor);
      std::vector<double> u = u_;
      // Where it does not find an equilibrium soon, a motion does so at less cost.
      const StaticReport report = newton(
          phase(), t(), u,
          {.tolerance = residual(), .max_iterations = 12, .load_steps = 2, .max_load_step = 0.5, .min_load_step = 0.1});
      trial.evaluations += report.force_evaluations;
      of_newton = "Newton's method: " + report.reason;
      if (report.converged) {
        trial.verdict = SafetyVerdict::rests;
        trial.reason = of_newton;
        look(u, trial);
        doubt_if_squeezed(u, trial);
        trial.wall_s = watch.seconds();
        return trial;
      }
    }
    begin(factor);
    MotionLimits limits{.residual = residual(), .interrupted = options_.interrupted};
    if (uses_newton()) limits.settles = [&](double now, Vec u) { return settles(now, u, trial); };
    const RestOrMotion found = rest_or_motion(phase(), t(), u_, limits);
    trial.evaluations += found.evaluations;
    trial.verdict = found.end == RestOrMotion::End::rests   ? SafetyVerdict::rests
                    : found.end == RestOrMotion::End::moves ? SafetyVerdict::moves
                                                            : SafetyVerdict::undecided;
    trial.reason = found.reason;
    if (trial.verdict != SafetyVerdict::rests && !of_newton.empty()) trial.reason += "; " + of_newton;
    look(found.u, trial);
    doubt_if_squeezed(found.u, trial);
    trial.wall_s = watch.seconds();
    return trial;
  }

  /// What the last trial left.
  Mechanism mechanism(double factor) {
    Mechanism m{.dim = scene_.dim, .factor = factor, .grid = scene_.grid};
    m.positions = positions_at_rest();
    m.displacement = last_displacement_;
    m.plastic_strain = difference(plastic_strain(last_u_), plastic_strain_);
    m.stress = field("stress", last_u_);
    return m;
  }

 private:
  LagrangianPhase& phase() { return simulation_.parts().phase; }
  double t() const { return simulation_.t(); }
  int threads() {
    constexpr std::size_t few_points = 20'000;  // which one thread moves as quickly
    if (options_.threads > 0) return options_.threads;
    return phase().points() < few_points ? 1 : omp_get_max_threads();
  }
  double residual() const {
    constexpr double otherwise = 1e-6;
    return scene_.stop.residual > 0 ? scene_.stop.residual : otherwise;
  }
  bool uses_newton() {
    const std::size_t most = scene_.dim == 3 ? most_for_newton_in_space : most_for_newton_in_plane;
    return !phase().contact() && phase().size() <= most;
  }

  void begin(double factor) {
    phase().control().archive(StateArchive::restoring(at_rest_));
    const Problem& problem = scene_;
    phase().control().change_materials(with_strength_over(problem, factor / options_.from).materials);
  }

  static constexpr double too_much = 0.3;  // strain in a phase; slopes near their factor are strained by 0.05 at rest

  // The largest component of ∂u/∂x at the points, since the phase began.
  double largest_strain(ConstVec u) {
    double largest = 0;
    for (const double component : field("strain", u)) largest = std::max(largest, std::abs(component));
    return largest;
  }
  // A grid that is squeezed bears loads that the material does not: such a rest is none.
  void doubt_if_squeezed(ConstVec u, SafetyTrial& trial) {
    if (trial.verdict != SafetyVerdict::rests) return;
    const double strain = largest_strain(u);
    if (!(strain > too_much)) return;
    trial.verdict = SafetyVerdict::undecided;
    trial.reason = fmt::format(
        "at rest only strained by {:.0f} % in a single phase, whose grid then bears what the ground "
        "does not; {}",
        100 * strain, trial.reason);
  }

  // In a single load step, which commits nothing unless it succeeds.
  bool settles(double now, Vec u, SafetyTrial& trial) {
    const StaticReport report =
        newton(phase(), now, u, {.tolerance = residual(), .max_iterations = 12, .min_load_step = 1});
    trial.evaluations += report.force_evaluations;
    return report.converged;
  }

  std::vector<double> field(const std::string& name, ConstVec u) {
    return point_field(phase(), name, t(), u, std::vector<double>(u.size(), 0.0));
  }
  // Points of laws without one have none.
  std::vector<double> plastic_strain(ConstVec u) { return field("plastic_strain", u); }
  std::vector<double> positions_at_rest() { return current_positions(phase(), t(), u_); }

  void look(const std::vector<double>& u, SafetyTrial& trial) {
    last_u_ = u;
    last_displacement_ = difference(field("u", u), points_);
    trial.displacement = largest_length(last_displacement_, static_cast<std::size_t>(scene_.dim));
  }

  const Stopwatch wall_;
  Scene scene_;  // with the strength of the first factor
  const SafetyOptions& options_;
  Simulation simulation_;
  SafetyTrial first_;
  SavedState at_rest_;
  std::vector<double> u_, points_, plastic_strain_;  // at rest
  std::vector<double> last_u_, last_displacement_;
};

void check(const SafetyOptions& options) {
  const auto refuse_if = [](bool condition, const std::string& message) {
    if (condition) throw std::invalid_argument(message);
  };
  refuse_if(!(options.from > 0) || !std::isfinite(options.from),
            fmt::format("from: expected a factor above 0, found {}", options.from));
  refuse_if(!(options.to > options.from) || !std::isfinite(options.to),
            fmt::format("to: expected a factor above {:g}, found {}", options.from, options.to));
  refuse_if(!(options.width > 0), fmt::format("width: expected more than 0, found {}", options.width));
}

void check(const Scene& scene) {
  const auto reducible = [](const auto& entry) { return has_reducible_strength(entry.second); };
  if (std::ranges::none_of(scene.materials, reducible))
    throw_scene_error("material",
                      "no material has a strength that a factor could reduce; expected the law \"mohr-coulomb\" or "
                      "\"drucker-prager\"");
  if (!scene.solve.is_static() && !scene.stop.wants_equilibrium())
    throw_scene_error("stop",
                      "a factor of safety begins at an equilibrium, which this scene does not ask for; expected "
                      "stop.residual or stop.distance");
}

/// The factor to try next; empty: the bracket is narrow enough, or what is undecided keeps it from becoming so.
std::optional<double> next_factor(const SafetyStudy& study, const SafetyOptions& options) {
  if (!study.factor_low) return std::nullopt;
  const double low = *study.factor_low;
  if (!study.factor_high) {
    const bool tried =
        std::ranges::any_of(study.trials, [&](const SafetyTrial& one) { return one.factor >= options.to; });
    if (!tried) return options.to;
  }
  const double high = study.factor_high.value_or(options.to);
  if (low >= high || high - low <= options.width) return std::nullopt;
  // Between the bracket's ends and what is undecided between them
  std::vector<double> known = {low, high};
  for (const SafetyTrial& trial : study.trials)
    if (trial.verdict == SafetyVerdict::undecided && trial.factor > low && trial.factor < high)
      known.push_back(trial.factor);
  std::ranges::sort(known);
  const double above_low = known[1] - known[0], below_high = known.back() - known[known.size() - 2];
  constexpr double finest = 1.0 / 8;  // of the width
  if (std::max(above_low, below_high) <= finest * options.width) return std::nullopt;
  return above_low >= below_high ? (known[0] + known[1]) / 2 : (known.back() + known[known.size() - 2]) / 2;
}

void take(const SafetyTrial& trial, SafetyStudy& study) {
  study.trials.push_back(trial);
  if (trial.verdict == SafetyVerdict::rests)
    study.factor_low = std::max(study.factor_low.value_or(trial.factor), trial.factor);
  if (trial.verdict == SafetyVerdict::moves)
    study.factor_high = std::min(study.factor_high.value_or(trial.factor), trial.factor);
}

}  // namespace

std::string to_string(SafetyVerdict verdict) {
  switch (verdict) {
    case SafetyVerdict::rests:
      return "rests";
    case SafetyVerdict::moves:
      return "moves";
    default:
      return "undecided";
  }
}

bool SafetyStudy::is_found() const {
  constexpr double rounding = 1e-12;
  return factor_low && factor_high && *factor_high - *factor_low <= width * (1 + rounding);
}

SafetyStudy safety(const Scene& scene, const SafetyOptions& options) {
  check(options);
  check(scene);
  const Stopwatch wall;
  SafetyStudy study{.scene = scene.name,
                    .title = scene.title,
                    .scene_text = scene.text,
                    .overrides = scene.overrides,
                    .width = options.width};
  const int total = 2 + static_cast<int>(std::ceil(std::log2((options.to - options.from) / options.width)));
  const auto tell = [&](const std::string& doing) {
    if (options.progress)
      options.progress({static_cast<int>(study.trials.size()),
                        std::max(total, static_cast<int>(study.trials.size()) + 1), doing, wall.seconds()});
  };
  const auto is_interrupted = [&] { return options.interrupted && options.interrupted(); };
  tell(fmt::format("the equilibrium with the factor {:g}", options.from));
  ReducedBody body(scene, options);
  take(body.first(), study);
  study.notes = body.notes();
  const StopScope scope(is_interrupted);
  try {
    for (std::optional<double> factor = next_factor(study, options); factor && !is_interrupted();
         factor = next_factor(study, options)) {
      tell(fmt::format("factor {:.4g}", *factor));
      const SafetyTrial trial = body.try_factor(*factor);
      if (is_interrupted() && trial.verdict == SafetyVerdict::undecided) break;
      take(trial, study);
      if (study.factor_high == trial.factor) study.mechanism = body.mechanism(trial.factor);
    }
  } catch (const Stopped&) {
  }
  study.interrupted = is_interrupted();
  study.wall_s = wall.seconds();
  return study;
}

}  // namespace stillpoint
