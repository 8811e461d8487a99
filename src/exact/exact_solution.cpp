#include <stillpoint/exact_solution.hpp>

#include <algorithm>
#include <stdexcept>

#include "exact/known_solutions.hpp"

namespace stillpoint {
namespace {

/// A solution given by the scene's own formulas.
class FormulaSolution final : public ExactSolution {
 public:
  explicit FormulaSolution(const ExactSpec& exact) : exact_(exact) {}

  void displacement(std::span<const double> X, double t, std::span<double> u) const override {
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = exact_.u[i](X, t);
  }
  bool has_stress() const override { return !exact_.stress.empty(); }
  void stress(std::span<const double> X, double t, std::span<double> sigma) const override {
    for (std::size_t i = 0; i < sigma.size(); ++i) sigma[i] = exact_.stress[i](X, t);
  }

 private:
  const ExactSpec& exact_;
};

}  // namespace

std::unique_ptr<ExactSolution> exact_solution(const Problem& problem) {
  if (!problem.exact.known()) return nullptr;
  if (problem.exact.solution.empty()) return std::make_unique<FormulaSolution>(problem.exact);
  for (const KnownSolution& known : known_solutions())
    if (known.about.name == problem.exact.solution) return known.make(problem);
  throw std::invalid_argument("there is no exact solution '" + problem.exact.solution + "'");
}

const std::vector<KnownSolution>& known_solutions() {
  static const std::vector<KnownSolution> rows = {column_solution(),      lame_cylinder_solution(), kirsch_solution(),
                                                  strip_load_solution(),  elastica_solution(),      vortex_solution(),
                                                  radial_mode_solution(), torsion_solution(),       flexure_solution()};
  return rows;
}

}  // namespace stillpoint
