// A row of a comparison: its names, and its evaluations relative to the Chebyshev estimate.
#include <stillpoint/compare.hpp>

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace stillpoint {

std::string to_string(ComparedStatus status) {
  constexpr std::array words = {"converged", "stalled", "unfinished", "inaccurate",
                                "diverged",  "refused", "interrupted"};  // in the order of ComparedStatus
  const auto k = static_cast<std::size_t>(status);
  return k < words.size() ? words[k] : "unknown";
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
