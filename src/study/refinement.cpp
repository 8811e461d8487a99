#include "study/refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/grid_lines.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

constexpr std::array<std::pair<Refinement, std::string_view>, 5> names = {{{Refinement::h, "h"},
                                                                           {Refinement::points, "points"},
                                                                           {Refinement::step, "step"},
                                                                           {Refinement::rtol, "rtol"},
                                                                           {Refinement::motion, "motion"}}};

std::vector<int> times(const std::vector<int>& counts, double factor) {
  std::vector<int> finer;
  for (const int count : counts) finer.push_back(static_cast<int>(std::lround(count * factor)));
  return finer;
}

// The piece with more cells, whose lines remain where the factor is whole: the ratio q of neighbouring lengths becomes
// q^(n/n'), with n and n' cells before and after.
GridPiece refined(GridPiece piece, double factor) {
  const int cells = static_cast<int>(std::lround(piece.cells * factor));
  if (piece.ratio != 1)
    piece.ratio = std::pow(piece.ratio, (cells - 1.0) * piece.cells / (static_cast<double>(cells) * (piece.cells - 1)));
  piece.cells = cells;
  return piece;
}

std::string text_of(const GridPiece& piece) {
  const std::string row = fmt::format("{}, {}, {}", piece.from, piece.to, piece.cells);
  return piece.ratio == 1 ? fmt::format("[{}]", row) : fmt::format("[{}, {}]", row, piece.ratio);
}

Settings more_cells(const GridSpec& grid, double factor) {
  if (!grid.is_by_pieces()) {
    const std::vector<int> cells = times(grid.cells, factor);
    return {{fmt::format("grid.cells=[{}]", fmt::join(cells, ", ")),
             [cells](Problem& finer) { finer.grid.cells = cells; }}};
  }
  Settings settings;
  for (std::size_t axis = 0; axis < grid.cells.size(); ++axis) {
    std::vector<GridPiece> pieces;
    std::vector<std::string> rows;
    for (const GridPiece& piece : grid.pieces.at(axis))
      rows.push_back(text_of(pieces.emplace_back(refined(piece, factor))));
    settings.push_back({fmt::format("grid.{}=[{}]", "xyz"[axis], fmt::join(rows, ", ")),
                        [axis, pieces](Problem& finer) { finer.grid.pieces.at(axis) = pieces; }});
  }
  return settings;
}

Settings more_points(const Problem& problem, double factor) {
  Settings settings;
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    const std::string table = problem.bodies.size() > 1 ? fmt::format("body[{}]", k) : "body";
    if (!problem.bodies[k].file.empty())
      throw_scene_error(table + ".file",
                        "points of a file cannot be refined by the study; expected a body that is filled with points");
    const std::vector<int> points = times(problem.bodies[k].points_per_cell, factor);
    settings.push_back({fmt::format("{}.points_per_cell=[{}]", table, fmt::join(points, ", ")),
                        [k, points](Problem& finer) { finer.bodies[k].points_per_cell = points; }});
  }
  return settings;
}

}  // namespace

std::string to_string(Refinement refinement) {
  return std::string(std::ranges::find(names, refinement, &std::pair<Refinement, std::string_view>::first)->second);
}

std::optional<Refinement> refinement_of(std::string_view name) {
  const auto found = std::ranges::find(names, name, &std::pair<Refinement, std::string_view>::second);
  return found == names.end() ? std::nullopt : std::optional(found->first);
}

Settings refined(const Problem& problem, Refinement refinement, double factor) {
  const auto one = [](const std::string& key, double value, auto&& apply) -> Settings {
    return {{fmt::format("{}={:.17g}", key, value), [value, apply](Problem& finer) { apply(finer, value); }}};
  };
  switch (refinement) {
    case Refinement::h:
      return more_cells(problem.grid, factor);
    case Refinement::points:
      return more_points(problem, factor);
    case Refinement::step:
      if (problem.solve.is_static())
        throw_scene_error("solve.method", "a static solver takes no steps in time; expected \"relaxation\"");
      if (problem.integrator.step)
        return one("integrator.step", *problem.integrator.step / factor,
                   [](Problem& finer, double step) { finer.integrator.step = step; });
      return one("integrator.step_fraction", problem.integrator.step_fraction / factor,
                 [](Problem& finer, double share) { finer.integrator.step_fraction = share; });
    case Refinement::rtol:
      if (!problem.integrator.rtol)
        throw_scene_error("integrator", "there is no rtol to refine; expected integrator.rtol");
      return one("integrator.rtol", *problem.integrator.rtol / factor,
                 [](Problem& finer, double rtol) { finer.integrator.rtol = rtol; });
    default:
      if (!problem.phase.ends_by_motion() || problem.phase.max_motion == 0)
        throw_scene_error("phase", "there is no max_motion to refine; expected phase.max_motion above 0");
      return one("phase.max_motion", problem.phase.max_motion / factor,
                 [](Problem& finer, double motion) { finer.phase.max_motion = motion; });
  }
}

double size_of(const Problem& problem, Refinement refinement, double step) {
  switch (refinement) {
    case Refinement::h:
      return longest_mean_cell(problem.grid);
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
