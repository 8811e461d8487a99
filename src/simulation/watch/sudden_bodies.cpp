// Rigid bodies that go some way into a body within one step, or that the run begins in: in phases the points that are
// pushed so far at once keep stresses and places that no function of the grid feels, and the force at rest is another
// one. An overlap of a tenth of a cell leaves 0.05 % of the force, one of a fifth 7 %, one of 0.4 cells up to 27 %.
// Domains, and a single phase, keep nothing of it.
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

class SuddenBodies : public Watcher {
 public:
  explicit SuddenBodies(const RunState& run)
      : looks_(!run.scene.rigid.empty() && !run.scene.solve.is_static() &&
               (run.scene.phase.ends_by_motion() || run.scene.phase.max_strain) &&
               run.scene.phase.quadrature == Quadrature::points) {}

  void observe(RunState& run) override {
    if (!looks_) return;
    const PhaseSupports& supports = run.model.phase->supports();
    const bool begins = !(run.t > looked_at_);
    if (begins || supports.way_of_rigid_bodies(looked_at_, run.t) > negligible) {
      const std::vector<ContactReport> reports = supports.contacts(run.t, run.motion->u());
      for (std::size_t k = 0; k < run.scene.rigid.size(); ++k)  // they come first
        if (reports[k].penetration > cells_) cells_ = reports[k].penetration, name_ = reports[k].name;
    }
    looked_at_ = run.t;
  }
  void confirm(RunState&, Verdict& verdict) override {
    if (cells_ > negligible)
      verdict = {RunStatus::step_limit, fmt::format("no equilibrium: {}; it ended with {}", fault(), verdict.reason)};
  }
  void fill(Summary& summary, const RunState&) override {
    if (cells_ > negligible) add_note(summary, fault());
  }
  void archive(const StateArchive& state, RunState&) override {
    state("looked_at", looked_at_);
    archive_for_next_stage(state);
  }
  void archive_for_next_stage(const StateArchive& state) override { state("cells", cells_, "name", name_); }

 private:
  static constexpr double negligible = 0.11;  // [cells]

  std::string fault() const {
    return fmt::format(
        "{} was {:.2g} cells inside a body at once: points that are pushed so far within a step keep stresses and "
        "places that no function of the grid feels, and its force is another one; expected a motion that takes some "
        "time, a start without an overlap, or a single phase",
        in_quotes(name_), cells_);
  }

  bool looks_;
  double looked_at_ = std::numeric_limits<double>::infinity();  // the time of the last look [s]
  double cells_ = 0;                                            // how deep it was, where most
  std::string name_;
};

}  // namespace

std::unique_ptr<Watcher> watch_sudden_bodies(const RunState& run) { return std::make_unique<SuddenBodies>(run); }

}  // namespace stillpoint
