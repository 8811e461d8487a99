// Bodies that have gone through each other, or through rigid ones. Two pieces of border press on each other if they
// were opposite when the phase began: bodies that turn to each other only later in the same phase meet nothing, and a
// run would end at rest with both in one place. So their borders are compared where they are at the end, and the volume
// of the bodies that can move apart is summed in blocks of the grid, where it must fit. A rigid body presses on the
// border of a body alone: once past it, it would rest in the middle of the body, which bears nothing. One that jumps on
// to the other side from one step to the next leaves no trace at the end: its way is looked along in each such step.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "scene/contact_bodies.hpp"
#include "scene/dimensions.hpp"
#include "scene/grid_lines.hpp"
#include "simulation/advice/placed_points.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

struct Overlap {
  std::size_t a = 0, b = 0;  // bodies
  int places = 0;
  std::vector<double> at{};  // a position in one of them [m]
};

/// How full a block can be of two bodies that touch in it: each may have half the distance of its points too much.
double fullest(const Problem& problem, std::size_t a, std::size_t b) {
  int fewest = 2;  // points along an axis of a cell
  for (const std::size_t k : {a, b})
    for (const int points : problem.bodies[k].points_per_cell) fewest = std::min(fewest, points);
  return 1.1 + 1.0 / fewest;
}

/// Calls visit(a, b, what a fills, what b fills, a position) for each pair of bodies in a block of so many cells along
/// each axis; the blocks begin at `shift`, in cells.
template <class Visit>
void for_shared_blocks(const Problem& problem, const PlacedPoints& placed, int cells,
                       const std::array<double, 3>& shift, const Visit& visit) {
  struct Contents {
    std::map<std::size_t, double> filled;  // by each body, in blocks
    std::size_t point = 0;
  };
  std::map<std::array<long, 3>, Contents> blocks;
  for (std::size_t p = 0; p < placed.bodies.size(); ++p) {
    std::array<long, 3> number{};
    for (std::size_t d = 0; d < placed.dim; ++d) {
      const double before = cells_before(problem.grid, d, placed.x[placed.dim * p + d]);
      number[d] = std::lround(std::floor((before - shift[d]) / cells));
    }
    Contents& in = blocks[number];
    in.filled[static_cast<std::size_t>(placed.bodies[p])] += placed.share[p] / std::pow(cells, problem.dim);
    in.point = p;
  }
  for (const auto& [number, in] : blocks) {
    const auto x = placed.x.begin() + static_cast<std::ptrdiff_t>(placed.dim * in.point);
    for (auto a = in.filled.begin(); a != in.filled.end(); ++a) {
      for (auto b = std::next(a); b != in.filled.end(); ++b)
        visit(a->first, b->first, a->second, b->second,
              std::vector<double>(x, x + static_cast<std::ptrdiff_t>(placed.dim)));
    }
  }
}

/// Pairs of bodies that fill the same places more than they can: blocks of two cells, or each of them nearly all of the
/// same cell, wherever the grid's lines are, as a plate does that is one cell thick.
std::vector<Overlap> overlaps(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  const PlacedPoints placed = place_points(problem, phase, t, u);
  std::map<std::pair<std::size_t, std::size_t>, Overlap> found;
  const auto add = [&](std::size_t a, std::size_t b, std::vector<double> at) {
    Overlap& overlap = found[{a, b}];
    if (overlap.places++ == 0) overlap.a = a, overlap.b = b, overlap.at = std::move(at);
  };
  constexpr double negligible = 0.25;
  for_shared_blocks(problem, placed, 2, {}, [&](std::size_t a, std::size_t b, double of_a, double of_b, auto at) {
    if (std::min(of_a, of_b) >= negligible && of_a + of_b > fullest(problem, a, b)) add(a, b, std::move(at));
  });
  for (int shifts = 0; shifts < 1 << placed.dim; ++shifts) {
    std::array<double, 3> shift{};
    for (std::size_t d = 0; d < placed.dim; ++d) shift[d] = (shifts >> d & 1) != 0 ? 0.5 : 0;
    for_shared_blocks(problem, placed, 1, shift, [&](std::size_t a, std::size_t b, double of_a, double of_b, auto at) {
      if (std::min(of_a, of_b) > fullest(problem, a, b) - 0.75) add(a, b, std::move(at));
    });
  }
  std::vector<Overlap> list;
  for (const auto& [pair, overlap] : found) list.push_back(overlap);
  return list;
}

/// How the borders of bodies are opposite to each other again and again.
const char* more_phases(const Problem& problem) {
  return problem.phase.ends() ? "phases that end sooner" : "phases that end, as by phase.max_motion = 0.1";
}

std::string described(const Problem& problem, const Overlap& overlap) {
  const auto name = [&](std::size_t k) { return name_of_body(problem, k); };
  const char* remedy =
      have_contact(problem, overlap.a, overlap.b) ? more_phases(problem) : "a [[contact]] between them";
  return fmt::format(
      "{} and {} have gone through each other, in {} places, as at ({:.4g}): only "
      "parts of borders that were opposite when a phase began press on each other; expected {}",
      name(overlap.a), name(overlap.b), overlap.places, fmt::join(overlap.at, ", "), remedy);
}

/// Whether so much is inside that no force is right: a material point is some way below the border, which may lie in a
/// rigid body by no more than its penetration, but for a corner, and for that only if the rest of the border bears it.
/// The border itself has no place that feels contact in its corners.
///
/// Bodies in each other feel it where their borders are opposite, and between two places of these a corner may go in.
bool is_grave(const Intrusion& found) {
  constexpr double corner = 0.15, half = 0.5, rounding = 0.02, tenth = 0.1;  // [cells]
  if (found.of == Intrusion::Of::border) return !found.bears && found.cells > half;
  if (found.of == Intrusion::Of::surface) return found.cells > 1;
  if (found.of == Intrusion::Of::bodies) return found.cells > (found.bears ? half : tenth);
  return found.cells > (found.bears ? corner : rounding);
}
bool is_worth_a_note(const Intrusion& found) {
  constexpr double seen = 0.1, rounding = 0.02, corner = 0.25;  // [cells]
  return is_grave(found) || (found.of == Intrusion::Of::border && found.cells > (found.bears ? seen : rounding)) ||
         (found.of == Intrusion::Of::bodies && found.cells > corner);
}

std::string described(const Problem& problem, const Intrusion& found) {
  const auto rigid = [&](std::size_t k) { return "'" + problem.rigid[k].name + "'"; };
  if (found.of == Intrusion::Of::rigid)
    return fmt::format(
        "{} and {} are in each other by {:.2g} cells, as at ({:.4g}): rigid bodies do not touch each other; expected a "
        "body between them, or one of them not to be rigid",
        rigid(found.rigid), rigid(found.other), found.cells, fmt::join(found.at, ", "));
  if (found.of == Intrusion::Of::bodies) {
    const auto [a, b] = bodies_of(problem, problem.contacts[found.rigid]);
    return fmt::format(
        "{} and {} lie in each other by {:.2g} cells at ({:.4g}), and nothing bears it there: only parts of borders "
        "that were opposite when a phase began press on each other; expected {}",
        name_of_body(problem, a), name_of_body(problem, b), found.cells, fmt::join(found.at, ", "),
        more_phases(problem));
  }
  const std::string body = name_of_body(problem, found.other);
  if (found.of == Intrusion::Of::way)
    return fmt::format(
        "{} has gone right through {} from one step to the next: on its way a material point at ({:.4g}) lay {:.2g} "
        "cells inside it, and only a border feels contact; expected a slower motion, without a jump",
        rigid(found.rigid), body, fmt::join(found.at, ", "), found.cells);
  if (found.of == Intrusion::Of::surface)
    return fmt::format(
        "{} has gone in between the places of the border of {} that feel contact: its surface at ({:.4g}) lies {:.2g} "
        "cells below the border, and only a border feels contact; expected smaller cells, or a rigid body that is "
        "wider "
        "there than a cell",
        rigid(found.rigid), body, fmt::join(found.at, ", "), found.cells);
  if (found.of == Intrusion::Of::border)
    return fmt::format(
        "{} reaches {:.2g} cells into the border of {} at ({:.4g}), between the places that feel contact, and {}; "
        "expected smaller cells, or a rounding of half a cell",
        rigid(found.rigid), found.cells, body, fmt::join(found.at, ", "),
        found.bears ? "nothing bears it there" : "presses on nothing");
  return fmt::format(
      "{} has gone past the border of {}: a material point at ({:.4g}) lies {:.2g} cells inside it, and only a border "
      "feels contact; expected a slower motion{}, or a rigid body of more than two cells",
      rigid(found.rigid), body, fmt::join(found.at, ", "), found.cells,
      problem.phase.ends() ? "" : ", phases that end, as by phase.max_motion = 0.1");
}

/// Bodies that have turned over on each other in a phase; empty: none has.
std::string fault_of_turn(const LagrangianPhase& phase, double t, ConstVec u) {
  for (const ContactReport& contact : phase.supports().contacts(t, u)) {
    if (!(contact.turned > std::numbers::pi / 2)) continue;
    return fmt::format(
        "the bodies of contact {} have turned by {:.0f} degrees on each other since the phase began, and still touch "
        "the parts of their borders that were opposite then; expected phases, as by phase.max_motion = 0.1",
        contact.name, contact.turned * 180 / std::numbers::pi);
  }
  return "";
}

/// Bodies that slide along each other, and that only what was opposite when the phase began holds: of a round body that
/// slides on, places push it back that have gone from under it. empty: there are none.
std::string fault_of_slide(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  constexpr double negligible = 1e-3, most = 0.25;  // of the force; of its component along the axis
  if (problem.contacts.empty()) return "";
  const std::vector<FreePart> parts = phase.shape().free_parts();
  if (parts.empty()) return "";
  const std::vector<int> body_of = phase.fields().point_data().bodies;
  const std::vector<ContactReport> reports = phase.supports().contacts(t, u);
  for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
    const ContactReport& contact = reports[problem.rigid.size() + k];
    const double force = std::hypot(contact.force[0], contact.force[1], contact.force[2]);
    const auto [a, b] = bodies_of(problem, problem.contacts[k]);
    for (const FreePart& part : parts) {
      const auto body = static_cast<std::size_t>(body_of[part.point]), axis = static_cast<std::size_t>(part.axis);
      const double along = std::abs(contact.force[axis]);
      if ((body != a && body != b) || !(along > negligible * force) ||
          !(std::abs(contact.strayed[axis]) > most * along))
        continue;
      return fmt::format(
          "nothing holds {} along {} but {:.4g} N of contact {}, which act on parts of the borders that were opposite "
          "when the phase began and are opposite no more: they slid by up to {:.2g} cells along each other; expected "
          "phases, as by phase.max_motion = 0.1",
          name_of_body(problem, body), axis_names(phase.dim())[axis], along, contact.name, contact.slid);
    }
  }
  return "";
}

class PassedBodies : public Watcher {
 public:
  void observe(RunState& run) override {
    if (run.scene.rigid.empty() || !passed_.empty()) return;
    if (run.t > looked_at_)
      for (const Intrusion& passage : run.model.phase->supports().passages(looked_at_, run.t, run.motion->u()))
        passed_ = described(run.scene, passage);
    looked_at_ = run.t;
  }
  Verdict judge(RunState& run) override { return passed_.empty() ? Verdict{} : run.failed(passed_); }
  void confirm(RunState& run, Verdict& verdict) override {
    const Findings found = look(run);
    if (!found.faults.empty())
      verdict = {RunStatus::step_limit,
                 fmt::format("no equilibrium: {}; it ended with {}", found.faults.front(), verdict.reason)};
  }
  void fill_state(Summary& summary, RunState& run) override {
    const Findings found = look(run);
    for (const std::string& fault : found.faults) add_note(summary, fault);
    for (const std::string& note : found.notes) add_note(summary, note);
  }

  void archive(const StateArchive& state, RunState&) override { state("looked_at", looked_at_); }

 private:
  struct Findings {
    std::vector<std::string> faults, notes;
  };
  static Findings look(RunState& run) {
    Findings found;
    if (!run.scene.may_touch()) return found;  // bodies without a contact are bonded
    const LagrangianPhase& phase = *run.model.phase;
    const ConstVec u = run.motion->u();
    if (std::string fault = fault_of_turn(phase, run.t, u); !fault.empty()) found.faults.push_back(std::move(fault));
    if (std::string fault = fault_of_slide(run.scene, phase, run.t, u); !fault.empty())
      found.faults.push_back(std::move(fault));
    if (!run.scene.contacts.empty())
      for (const Overlap& overlap : overlaps(run.scene, phase, run.t, u))
        found.faults.push_back(described(run.scene, overlap));
    for (const Intrusion& intrusion : phase.supports().intrusions(run.t, u)) {
      if (is_worth_a_note(intrusion))
        (is_grave(intrusion) ? found.faults : found.notes).push_back(described(run.scene, intrusion));
    }
    return found;
  }

  double looked_at_ = std::numeric_limits<double>::infinity();  // the time of the last look [s]
  std::string passed_;                                          // what a rigid body has gone through; empty: nothing
};

}  // namespace

std::unique_ptr<Watcher> watch_passed_bodies() { return std::make_unique<PassedBodies>(); }

}  // namespace stillpoint
