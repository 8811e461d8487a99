#include "simulation/other_run.hpp"

#include <stillpoint/simulation.hpp>
#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "plan/catalogue.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/advice/placed_points.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {
namespace {

constexpr const char* initial_from = "initial.from";

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
  return numbers;
}

// A law without history knows no stress but that of its own deformation.
void refuse_other_laws(const Problem& other, const Problem& problem, const std::vector<std::size_t>& numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto taken = std::ranges::find(problem.bodies, numbers[k], &BodySpec::number);
    if (taken == problem.bodies.end()) continue;
    const MaterialSpec &before = other.materials.at(other.bodies[k].material),
                       &now = problem.materials.at(taken->material);
    if (before.law == now.law || catalogue().law(now.law)->history_dependent) continue;
    throw_scene_error(
        fmt::format("material.{}.law", now.name),
        fmt::format("'{}' is a law without history, whose stress follows from its own deformation alone: it "
                    "cannot take over the stress of '{}' in {}",
                    now.law, before.law, problem.initial_from.string()));
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

}  // namespace

std::shared_ptr<CarriedBody> points_of_other_run(const Problem& problem) {
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
