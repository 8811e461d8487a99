#include "study/reduced_body.hpp"

#include <stillpoint/static_solution.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/thread_team.hpp"
#include "output/point_fields.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/parts.hpp"
#include "study/rest_or_motion.hpp"
#include "study/setting.hpp"
#include "study/strength_reduction.hpp"

namespace stillpoint {
namespace {

// A phase that has strained its points by more bears what the ground does not.
constexpr double too_much_strain = 0.3;
// What less strength may add to that: a body that is pressed out of the way, until it is wide enough for what it bears,
// has fallen. Slopes near their factor are strained by 0.05 at rest.
constexpr double too_much_more = 0.1;

constexpr int newton_iterations = 12;  // in a load step: where they are not enough, a motion finds more at less cost

Scene weakened(const Scene& scene, double factor) {
  return changed(scene, [factor](Problem& problem) {
    problem = with_strength_over(std::move(problem), factor);
    problem.output.snapshots.clear();
    problem.output.fields_every = 0;
    problem.checkpoint = {};
  });
}

std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

SafetyVerdict verdict_of(RestOrMotion::End end) {
  switch (end) {
    case RestOrMotion::End::rests:
      return SafetyVerdict::rests;
    case RestOrMotion::End::moves:
      return SafetyVerdict::moves;
    default:
      return SafetyVerdict::undecided;
  }
}

}  // namespace

ReducedBody::ReducedBody(const Scene& scene, const SafetyOptions& options)
    : scene_(weakened(scene, options.from)),
      options_(options),
      simulation_(scene_, {.threads = options.threads, .interrupted = options.interrupted}) {
  simulation_.run();
  const Summary summary = simulation_.summary();
  first_ = {.factor = options.from, .evaluations = summary.rhs_evaluations, .wall_s = wall_.seconds()};
  if (summary.status == RunStatus::interrupted) {
    first_.reason = "interrupted by the user";
    return;
  }
  u_.assign(simulation_.u().begin(), simulation_.u().end());
  require_rest(summary);
  first_.verdict = SafetyVerdict::rests;
  first_.reason = summary.reason;
  phase().control().archive(StateArchive::saving(at_rest_));
  displacement_ = field("u", u_);
  plastic_strain_ = field("plastic_strain", u_);
}

void ReducedBody::require_rest(const Summary& summary) {
  const std::string with = fmt::format("with its strength divided by {:g} the body ", options_.from);
  if (summary.status != RunStatus::equilibrium)
    throw_scene_error(
        "", with + "does not come to an equilibrium, from which a factor of safety begins: " + summary.reason);
  if (!simulation_.loads_settled())
    throw_scene_error("",
                      "loads still change when the body has come to rest; expected loads that have come to their end");
  strain_ = largest_strain(phase(), t(), u_).strain;
  if (strain_ > too_much_strain)
    throw_scene_error("", fmt::format("{}rests only strained by {:.0f} % in a single phase, whose grid then bears what "
                                      "the ground does not; expected a smaller factor",
                                      with, 100 * strain_));
}

SafetyTrial ReducedBody::try_factor(double factor) {
  const ThreadScope scope(threads());
  const Stopwatch watch;
  Tried tried;
  if (uses_newton()) tried = by_newton(factor);
  if (tried.verdict != SafetyVerdict::rests) {
    const Tried before = std::exchange(tried, by_motion(factor));
    tried.evaluations += before.evaluations;
    if (tried.verdict != SafetyVerdict::rests && !before.reason.empty()) tried.reason += "; " + before.reason;
  }
  doubt_if_squeezed(tried);
  last_u_ = tried.u;
  last_displacement_ = difference(field("u", last_u_), displacement_);
  return {.factor = factor,
          .verdict = tried.verdict,
          .reason = tried.reason,
          .displacement = std::ranges::max(lengths_of(last_displacement_, static_cast<std::size_t>(scene_.dim))),
          .evaluations = tried.evaluations,
          .wall_s = watch.seconds()};
}

ReducedBody::Tried ReducedBody::by_newton(double factor) {
  begin(factor);
  Tried tried{.u = u_};
  const StaticReport report = newton(phase(), t(), tried.u,
                                     {.tolerance = residual(),
                                      .max_iterations = newton_iterations,
                                      .load_steps = 2,
                                      .max_load_step = 0.5,
                                      .min_load_step = 0.1});
  tried.verdict = report.converged ? SafetyVerdict::rests : SafetyVerdict::undecided;
  tried.reason = report.converged
                     ? "Newton's method: " + report.reason
                     : fmt::format("Newton's method finds no equilibrium beyond {:.4g} % of the change of strength",
                                   100 * report.load_factor);
  tried.evaluations = report.force_evaluations;
  return tried;
}

ReducedBody::Tried ReducedBody::by_motion(double factor) {
  begin(factor);
  long of_newton = 0;
  MotionLimits limits{.residual = residual(), .interrupted = options_.interrupted};
  if (uses_newton()) {
    limits.settles = [&](double now, Vec u) {  // in a single load step, which commits nothing unless it succeeds
      const StaticReport report =
          newton(phase(), now, u, {.tolerance = residual(), .max_iterations = newton_iterations, .min_load_step = 1});
      of_newton += report.force_evaluations;
      return report.converged;
    };
  }
  RestOrMotion found = rest_or_motion(phase(), t(), u_, limits);
  return {verdict_of(found.end), std::move(found.reason), std::move(found.u), found.evaluations + of_newton};
}

Mechanism ReducedBody::mechanism(double factor) {
  return {.dim = scene_.dim,
          .factor = factor,
          .grid = problem().grid,
          .positions = current_positions(phase(), t(), u_),
          .displacement = last_displacement_,
          .plastic_strain = difference(field("plastic_strain", last_u_), plastic_strain_),
          .stress = field("stress", last_u_)};
}

void ReducedBody::begin(double factor) {
  phase().control().archive(StateArchive::restoring(at_rest_));
  phase().control().change_materials(with_strength_over(problem(), factor / options_.from).materials);
}

void ReducedBody::doubt_if_squeezed(Tried& tried) {
  if (tried.verdict != SafetyVerdict::rests) return;
  const double strain = largest_strain(phase(), t(), tried.u).strain;
  if (!(strain > strain_ + too_much_more)) return;
  tried.verdict = SafetyVerdict::undecided;
  tried.reason = fmt::format(
      "at rest only strained by {:.0f} % in a single phase, whose grid then bears what the ground does not; {}",
      100 * strain, tried.reason);
}

LagrangianPhase& ReducedBody::phase() { return simulation_.parts().phase; }
const Problem& ReducedBody::problem() { return simulation_.parts().problem; }

double ReducedBody::residual() const {
  constexpr double otherwise = 1e-6;
  return scene_.stop.residual > 0 ? scene_.stop.residual : otherwise;
}

int ReducedBody::threads() {
  constexpr std::size_t few_points = 20'000;  // which one thread moves as quickly
  if (options_.threads > 0) return options_.threads;
  return phase().points() < few_points ? 1 : loop_threads();
}

// Newton's method knows no contact, and takes long where a factor of K is large.
bool ReducedBody::uses_newton() {
  constexpr std::size_t most_in_plane = 200'000, most_in_space = 15'000;  // unknowns
  return !phase().contact() && phase().size() <= (scene_.dim == 3 ? most_in_space : most_in_plane);
}

std::vector<double> ReducedBody::field(const std::string& name, ConstVec u) {
  return point_field(phase(), name, t(), u, std::vector<double>(u.size(), 0.0));
}

}  // namespace stillpoint
