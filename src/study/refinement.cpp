#include "study/refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/longest_cell.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

constexpr std::array<std::pair<Refinement, std::string_view>, 5> names = {{{Refinement::h, "h"},
                                                                           {Refinement::points, "points"},
                                                                           {Refinement::step, "step"},
                                                                           {Refinement::rtol, "rtol"},
                                                                           {Refinement::motion, "motion"}}};

std::string times(const std::vector<int>& counts, double factor) {
  std::vector<long> finer;
  for (const int count : counts) finer.push_back(std::lround(count * factor));
  return fmt::format("[{}]", fmt::join(finer, ", "));
}

std::vector<std::string> more_points(const Problem& problem, double factor) {
  std::vector<std::string> set;
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    const std::string table = problem.bodies.size() > 1 ? fmt::format("body[{}]", k) : "body";
    if (!problem.bodies[k].file.empty())
      throw_scene_error(table + ".file",
                        "points of a file cannot be refined by the study; expected a body that is filled with points");
    set.push_back(fmt::format("{}.points_per_cell={}", table, times(problem.bodies[k].points_per_cell, factor)));
  }
  return set;
}

}  // namespace

std::string to_string(Refinement refinement) {
  return std::string(std::ranges::find(names, refinement, &std::pair<Refinement, std::string_view>::first)->second);
}

std::optional<Refinement> refinement_of(std::string_view name) {
  const auto found = std::ranges::find(names, name, &std::pair<Refinement, std::string_view>::second);
  return found == names.end() ? std::nullopt : std::optional(found->first);
}

std::vector<std::string> refined(const Problem& problem, Refinement refinement, double factor) {
  switch (refinement) {
    case Refinement::h:
      return {"grid.cells=" + times(problem.grid.cells, factor)};
    case Refinement::points:
      return more_points(problem, factor);
    case Refinement::step:
      if (problem.solve.is_static())
        throw_scene_error("solve.method", "a static solver takes no steps in time; expected \"relaxation\"");
      if (problem.integrator.step) return {fmt::format("integrator.step={:.17g}", *problem.integrator.step / factor)};
      return {fmt::format("integrator.step_fraction={:.17g}", problem.integrator.step_fraction / factor)};
    case Refinement::rtol:
      if (!problem.integrator.rtol)
        throw_scene_error("integrator", "there is no rtol to refine; expected integrator.rtol");
      return {fmt::format("integrator.rtol={:.17g}", *problem.integrator.rtol / factor)};
    default:
      if (!problem.phase.ends_by_motion() || problem.phase.max_motion == 0)
        throw_scene_error("phase", "there is no max_motion to refine; expected phase.max_motion above 0");
      return {fmt::format("phase.max_motion={:.17g}", problem.phase.max_motion / factor)};
  }
}

double size_of(const Problem& problem, Refinement refinement, double step) {
  switch (refinement) {
    case Refinement::h:
      return longest_cell(problem.grid);
    case Refinement::points:
      return 1.0 / std::ranges::min(problem.bodies.front().points_per_cell);
    case Refinement::step:
      return step;
    case Refinement::rtol:
      return *problem.integrator.rtol;
    default:
      return problem.phase.max_motion;
  }
}

}  // namespace stillpoint
