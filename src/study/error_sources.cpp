#include "study/error_sources.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "study/refinement.hpp"

namespace stillpoint {

bool is_transient(const Problem& problem) { return !problem.solve.is_static() && !problem.stop.wants_equilibrium(); }

std::string source_of(Refinement refinement) {
  switch (refinement) {
    case Refinement::h:
      return "space";
    case Refinement::points:
      return "quadrature";
    case Refinement::motion:
      return "phases";
    default:
      return "time";
  }
}

std::vector<RefinedSource> other_sources(const Problem& problem, const std::vector<Refinement>& refine) {
  std::vector<RefinedSource> sources;
  const auto is_refined = [&](Refinement r) { return std::ranges::find(refine, r) != refine.end(); };
  const auto add = [&](Refinement r, double factor) { sources.push_back({source_of(r), refined(problem, r, factor)}); };
  const bool fills_bodies = std::ranges::all_of(problem.bodies, [](const BodySpec& body) { return body.file.empty(); });
  if (!is_refined(Refinement::h)) add(Refinement::h, 2);
  if (!is_refined(Refinement::points) && fills_bodies) add(Refinement::points, 2);
  if (is_transient(problem) && !is_refined(Refinement::step) && !is_refined(Refinement::rtol)) {
    if (problem.integrator.rtol) {
      add(Refinement::rtol, 10);
    } else {
      add(Refinement::step, 2);
    }
  }
  if (problem.phase.ends_by_motion() && problem.phase.max_motion > 0 && !is_refined(Refinement::motion))
    add(Refinement::motion, 2);
  if (problem.stop.wants_equilibrium() && problem.stop.residual > 0) {
    constexpr double tighter = 100, tightest = 1e-12;
    const double residual = std::max(tightest, problem.stop.residual / tighter);
    sources.push_back({"the relaxation's stop",
                       {{fmt::format("stop.residual={:.3g}", residual),
                         [residual](Problem& finer) { finer.stop.residual = residual; }}}});
  }
  return sources;
}

}  // namespace stillpoint
