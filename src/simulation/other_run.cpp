#include "simulation/other_run.hpp"

#include <stillpoint/simulation.hpp>
#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "geometry/polygon.hpp"
#include "plan/catalogue.hpp"
#include "scene/body_solid.hpp"
#include "scene/grid_lines.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/advice/placed_points.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {
namespace {

constexpr const char* initial_from = "initial.from";

std::string names_of(const std::vector<BodySpec>& bodies) {
  std::vector<std::string> names;
  for (const BodySpec& body : bodies) names.push_back(body.name.empty() ? "one without a name" : in_quotes(body.name));
  return fmt::format("{}", fmt::join(names, ", "));
}

// What the other run has and this scene lacks would be gone in silence, and with a name that is misspelt a body would
// begin anew beside it. A body that a stage adds again may be gone before.
void refuse_lost_bodies(const Problem& other, const Problem& problem, const std::vector<std::size_t>& numbers) {
  std::vector<BodySpec> lost;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const BodySpec& body = other.bodies[k];
    const bool comes_later = !body.name.empty() && std::ranges::find(problem.later_bodies, body.name,
                                                                     &BodySpec::name) != problem.later_bodies.end();
    if (numbers[k] == CarriedBody::not_taken && !comes_later) lost.push_back(body);
  }
  if (lost.empty()) return;
  throw_scene_error(initial_from,
                    fmt::format("this scene lacks bodies of the other run: {}; it begins with {}; expected all bodies "
                                "of the other run under their names, of which a [[stage]] may remove some",
                                names_of(lost), names_of(problem.bodies)));
}

// Bodies without names are the same in their order, if there are as many. Throws SceneError for a name that is not
// there.
std::vector<std::size_t> numbers_of(const Problem& other, const Problem& problem) {
  const auto has_no_name = [](const BodySpec& body) { return body.name.empty(); };
  const bool by_order =
      std::ranges::all_of(other.bodies, has_no_name) && std::ranges::all_of(problem.bodies, has_no_name);
  std::vector<std::size_t> numbers;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < other.bodies.size(); ++k) {
    names.push_back(other.bodies[k].name);
    const auto same = by_order
                          ? problem.bodies.begin() + static_cast<std::ptrdiff_t>(std::min(k, problem.bodies.size()))
                          : std::ranges::find(problem.bodies, other.bodies[k].name, &BodySpec::name);
    const bool is_taken = same != problem.bodies.end() && (by_order || !other.bodies[k].name.empty());
    numbers.push_back(is_taken ? same->number : CarriedBody::not_taken);
  }
  if (by_order && other.bodies.size() != problem.bodies.size())
    throw_scene_error(initial_from,
                      fmt::format("the other run has {} bodies without names, and this scene {}; expected as many, or "
                                  "names",
                                  other.bodies.size(), problem.bodies.size()));
  if (std::ranges::all_of(numbers, [](std::size_t number) { return number == CarriedBody::not_taken; }))
    throw_scene_error(initial_from, fmt::format("no body of this scene has the name of one of the other run: {}",
                                                fmt::join(names, ", ")));
  refuse_lost_bodies(other, problem, numbers);
  return numbers;
}

// A law without history knows no stress but that of its own deformation.
void refuse_other_laws(const Problem& other, const Problem& problem, const std::vector<std::size_t>& numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto taken = std::ranges::find(problem.bodies, numbers[k], &BodySpec::number);
    if (taken == problem.bodies.end()) continue;
    const MaterialSpec &before = other.materials.at(other.bodies[k].material),
                       &now = problem.materials.at(taken->material);
    if (catalogue().law(now.law)->history_dependent || (before.law == now.law && before.undrained == now.undrained))
      continue;
    throw_scene_error(
        fmt::format("material.{}.law", now.name),
        fmt::format("'{}' is a law without history, whose stress follows from its own deformation alone: it "
                    "cannot take over the stress of '{}'{} in {}",
                    now.law, before.law, before.law == now.law ? before.undrained ? ", undrained," : ", drained," : "",
                    problem.initial_from.string()));
  }
}

// The points' volumes and masses are those of the other run.
void refuse_other_thickness(const Problem& other, const Problem& problem, const std::vector<std::size_t>& numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto taken = std::ranges::find(problem.bodies, numbers[k], &BodySpec::number);
    if (taken == problem.bodies.end() || taken->area == other.bodies[k].area) continue;
    throw_scene_error(
        fmt::format("body[{}].{}", taken - problem.bodies.begin(), problem.dim == 1 ? "area" : "thickness"),
        fmt::format("must be that of the other run, {}, whose points the body takes over, not {}", other.bodies[k].area,
                    taken->area));
  }
}

// Whether a body fills another part of space: by the boxes around the shapes, to half a cell of this grid, and in the
// plane by their areas.
bool has_other_shape(const BodySpec& before, const BodySpec& now, const Problem& problem) {
  constexpr double like = 0.01;
  for (std::size_t d = 0; d < static_cast<std::size_t>(problem.dim); ++d) {
    const double tolerance = mean_cell(problem.grid, d) / 2;
    if (std::abs(before.min[d] - now.min[d]) > tolerance || std::abs(before.max[d] - now.max[d]) > tolerance)
      return true;
  }
  if (problem.dim != 2) return false;
  const double area_before = std::abs(signed_area(outline_of(before))), area = std::abs(signed_area(outline_of(now)));
  return std::abs(area - area_before) > like * area_before;
}

// The shape that a scene gives such a body fills nothing with points.
void note_other_shapes(const Problem& other, const Problem& problem, const std::vector<std::size_t>& numbers,
                       std::vector<std::string>& notes) {
  const auto box = [](const BodySpec& body) {
    return fmt::format("({:.4g}) and ({:.4g})", fmt::join(body.min.value(), ", "), fmt::join(body.max.value(), ", "));
  };
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto taken = std::ranges::find(problem.bodies, numbers[k], &BodySpec::number);
    if (taken == problem.bodies.end() || !has_other_shape(other.bodies[k], *taken, problem)) continue;
    const std::string now = box(*taken), before = box(other.bodies[k]);
    notes.push_back(fmt::format(
        "body[{}] has another shape than in the other run, {}: it is made of the points that that run has left, "
        "wherever they are; expected the shape of the other run",
        taken - problem.bodies.begin(),
        now == before ? "in the same box" : fmt::format("between {} and not between {}", now, before)));
  }
}

}  // namespace

std::shared_ptr<CarriedBody> points_of_other_run(const Problem& problem, std::vector<std::string>& notes) {
  try {
    Simulation other(load_scene_of(problem.initial_from), {.resume = problem.initial_from, .records = false});
    const SimulationParts parts = other.parts();
    const Problem& scene = parts.problem;
    if (scene.state != problem.state)
      throw_scene_error(initial_from, fmt::format("the other run is one of state = {}, and this scene of {}",
                                                  in_quotes(std::string(to_string(scene.state))),
                                                  in_quotes(std::string(to_string(problem.state)))));
    const bool had_domains = scene.phase.quadrature == Quadrature::domains,
               has_domains = problem.phase.quadrature == Quadrature::domains;
    if (had_domains != has_domains)
      throw_scene_error(
          initial_from,
          fmt::format("the points of {} represent domains, and those of {} do not; expected phase.quadrature = \"{}\" "
                      "here",
                      had_domains ? "the other run" : "this scene", had_domains ? "this scene" : "the other run",
                      had_domains ? "domains" : "points"));
    const std::vector<std::size_t> numbers = numbers_of(scene, problem);
    refuse_other_laws(scene, problem, numbers);
    refuse_other_thickness(scene, problem, numbers);
    note_other_shapes(scene, problem, numbers, notes);
    std::shared_ptr<CarriedBody> points = parts.phase.hand_over(other.t(), other.u(), other.v());
    points->begin_other_run(numbers, problem.displacements_from_zero);
    return points;
  } catch (const StateError& error) {
    throw_scene_error(initial_from, error.what());
  } catch (const PointLost& error) {
    throw_scene_error(initial_from, error.what());
  }
}

// Where cells have fewer points than one, the points of a cell take more than it has. A body at rest has no more volume
// than the cells that it reaches.
void refuse_sparse_points(const Problem& problem, const LagrangianPhase& phase) {
  constexpr double most = 1.3;
  if (problem.phase.quadrature == Quadrature::domains) return;
  const FilledCells filled = filled_cells(problem, phase);
  double mean = 0;
  for (const auto& [cell, share] : filled) mean += share / static_cast<double>(filled.size());
  if (mean <= most) return;
  throw_scene_error(
      initial_from,
      fmt::format("the points of the other run fill {:.2g} times the cells of this grid in which they are, so "
                  "that others inside the body have none; expected larger cells, or more points per cell in "
                  "the other run",
                  mean));
}

}  // namespace stillpoint
