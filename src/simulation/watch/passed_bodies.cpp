// Bodies that have gone through each other. Two pieces of border press on each other if they were opposite when the
// phase began: bodies that turn to each other only later in the same phase meet nothing, and a run would end at rest
// with both in one place. So the volume of the bodies that can move apart is summed in blocks of the grid, where it
// must fit.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "scene/contact_bodies.hpp"
#include "scene/grid_lines.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

constexpr int cells_of_block = 2;  // [cells] along each axis

struct Overlap {
  std::size_t a = 0, b = 0;  // bodies
  int blocks = 0;
  std::vector<double> at{};  // a position in one of them [m]
};

/// What a point takes of its cell at its present position, as a share of the cell.
double share_of_cell(const Problem& problem, std::size_t body, ConstVec x, double volume) {
  double cell = problem.dim < 3 ? problem.bodies[body].area : 1;
  if (problem.state == StressState::axisymmetric) cell = 2 * std::numbers::pi * std::max(x[0], 0.0);
  for (std::size_t d = 0; d < x.size(); ++d) cell *= cell_length_at(problem.grid, d, x[d]);
  return cell > 0 ? volume / cell : 0;
}

/// How full a block can be of two bodies that touch in it: each may have half the distance of its points too much.
double fullest(const Problem& problem, std::size_t a, std::size_t b) {
  int fewest = 2;  // points along an axis of a cell
  for (const std::size_t k : {a, b})
    for (const int points : problem.bodies[k].points_per_cell) fewest = std::min(fewest, points);
  return 1.1 + 1.0 / fewest;
}

/// Pairs of bodies that fill the same blocks more than they can.
std::vector<Overlap> overlaps(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  const auto dim = static_cast<std::size_t>(problem.dim);
  const PointData data = phase.fields().point_data();
  const std::size_t points = data.bodies.size();
  std::vector<double> way(dim * points), volume(points);
  phase.fields().point_displacement(t, u, way);
  phase.fields().point_field(PointQuantity::volume, t, u, volume);

  struct Contents {
    std::map<std::size_t, double> filled;  // by each body, in blocks
    std::vector<double> at;
  };
  std::map<std::array<long, 3>, Contents> blocks;
  for (std::size_t p = 0; p < points; ++p) {
    std::vector<double> x(dim);
    std::array<long, 3> number{};
    for (std::size_t d = 0; d < dim; ++d) {
      x[d] = data.initial_positions[dim * p + d] + way[dim * p + d];
      number[d] = std::lround(std::floor(cells_before(problem.grid, d, x[d]) / cells_of_block));
    }
    const auto body = static_cast<std::size_t>(data.bodies[p]);
    Contents& in = blocks[number];
    in.filled[body] += share_of_cell(problem, body, x, volume[p]) / std::pow(cells_of_block, problem.dim);
    in.at = std::move(x);
  }

  constexpr double negligible = 0.25;
  std::map<std::pair<std::size_t, std::size_t>, Overlap> found;
  for (const auto& [number, in] : blocks) {
    for (auto a = in.filled.begin(); a != in.filled.end(); ++a) {
      for (auto b = std::next(a); b != in.filled.end(); ++b) {
        if (std::min(a->second, b->second) < negligible ||
            !(a->second + b->second > fullest(problem, a->first, b->first)))
          continue;
        Overlap& overlap = found[{a->first, b->first}];
        if (overlap.blocks++ == 0) overlap.a = a->first, overlap.b = b->first, overlap.at = in.at;
      }
    }
  }
  std::vector<Overlap> list;
  for (const auto& [pair, overlap] : found) list.push_back(overlap);
  return list;
}

std::string described(const Problem& problem, const Overlap& overlap) {
  const auto name = [&](std::size_t k) {
    return problem.bodies[k].name.empty() ? fmt::format("body[{}]", k) : "'" + problem.bodies[k].name + "'";
  };
  const char* remedy = !have_contact(problem, overlap.a, overlap.b) ? "a [[contact]] between them"
                       : problem.phase.ends()                       ? "phases that end sooner"
                                                                    : "phases that end, as by phase.max_motion = 0.1";
  return fmt::format(
      "{} and {} have gone through each other, by {} blocks of {} cells a side, as at ({:.4g}): only "
      "parts of borders that were opposite when a phase began press on each other; expected {}",
      name(overlap.a), name(overlap.b), overlap.blocks, cells_of_block, fmt::join(overlap.at, ", "), remedy);
}

class PassedBodies : public Watcher {
 public:
  void confirm(RunState& run, Verdict& verdict) override {
    const std::vector<Overlap> found = look(run);
    if (found.empty()) return;
    verdict = {RunStatus::step_limit, fmt::format("no equilibrium: {}; it ended with {}",
                                                  described(run.scene, found.front()), verdict.reason)};
  }
  void fill_state(Summary& summary, RunState& run) override {
    for (const Overlap& overlap : look(run)) add_note(summary, described(run.scene, overlap));
  }

 private:
  // Bodies without a contact are bonded, and cannot.
  static std::vector<Overlap> look(RunState& run) {
    if (run.scene.contacts.empty()) return {};
    return overlaps(run.scene, *run.model.phase, run.t, run.motion->u());
  }
};

}  // namespace

std::unique_ptr<Watcher> watch_passed_bodies() { return std::make_unique<PassedBodies>(); }

}  // namespace stillpoint
