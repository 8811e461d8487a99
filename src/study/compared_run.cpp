// A row of a comparison: its names, and its evaluations relative to the Chebyshev estimate.
#include <stillpoint/compare.hpp>

#include <cmath>

#include <fmt/format.h>

namespace stillpoint {

std::string to_string(ComparedStatus status) {
  switch (status) {
    case ComparedStatus::converged:
      return "converged";
    case ComparedStatus::stalled:
      return "stalled";
    case ComparedStatus::unfinished:
      return "unfinished";
    case ComparedStatus::inaccurate:
      return "inaccurate";
    case ComparedStatus::diverged:
      return "diverged";
    case ComparedStatus::refused:
      return "refused";
    case ComparedStatus::interrupted:
      return "interrupted";
  }
  return "unknown";
}

std::string ComparedRun::label() const {
  std::string text = mass.empty() ? strategy : strategy + ":" + mass;
  if (!integrator.empty() && integrator != IntegratorSpec{}.method) text += ", " + integrator;
  if (step_fraction) text += fmt::format(" {:g}", *step_fraction);
  if (rtol) text += fmt::format(" rtol {:g}", *rtol);
  return text;
}

std::optional<double> Comparison::over_chebyshev_estimate(const ComparedRun& run) const {
  if (!chebyshev_estimate || run.evaluations == 0) return std::nullopt;
  return static_cast<double>(run.evaluations) / *chebyshev_estimate;
}

double chebyshev_estimate(double kappa, double error) { return 0.5 * std::sqrt(kappa) * std::log(2 / error); }

}  // namespace stillpoint
