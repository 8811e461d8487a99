// The multipliers of contact: a body that is nearly in balance takes its contact pressures as multipliers, and goes on
// to where nothing penetrates.
//
// Each time they change, the body is out of balance again, by what it will have to go on. So they are taken first at a
// residual of 0.1, and then each time that half of what the last update put out of balance is left, and no more than
// that 0.1: body and pressures come to their places together. Friction remembers each state on the way, and the first
// overshoot of the motion is one of another state: with it they are taken first at a residual of 1e-2, and then each
// time that a third of that is left, which is where most bodies come to rest soonest. They are taken at least twice,
// until what the grid's functions can tell of a penetration is less than a thousandth of a cell, and until another
// update would change what the body feels of them by no more than thirty times the residual that the scene asks for. At
// the edge of a contact a piece may open and close from one update to the next; once they come no nearer, there are no
// more, but with friction only if another would change it by a thousandth, or after forty. Under loads that still
// change they follow once in a while, and after a longer while even if the body is not near balance: in a motion that
// is never quiet the penalty alone would press else, and give way. There is no end to those, and they are taken evenly:
// what swings at the moment of an update is not to stay as a pressure. Nor are they taken shortly before a row of the
// history, unless rows are as close as they are: for a while both the new multipliers and the penetration of before
// press.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

class Multipliers : public Watcher {
 public:
  explicit Multipliers(RunState& run)
      : touches_(run.model.phase->info().may_touch),
        remembers_(run.scene.rubs()),
        least_(run.scene.stop.residual > 0 ? run.scene.stop.residual : least_by_default),
        nearest_(run.scene.solve.is_static() ? least_ : least_ / 10),
        largest_change_(std::clamp(30 * least_, 1e-9, 1e-3)),
        between_(run.model.dwell / 4),
        goal_(std::max(remembers_ ? quiet : early, least_)) {
    run.contact_settled = !touches_;
  }

  void observe(RunState& run) override {
    if (!touches_) return;
    const bool loads_stay = run.loads_stay();
    if (!is_due(run, loads_stay)) return;
    const PhaseSupports& supports = run.model.phase->supports();
    ContactState state;  // how well the multipliers fit is asked for where that may end them
    if (loads_stay) {
      state = supports.contact_state(run.t, run.motion->u());
    } else {
      state.touches = supports.are_touched(run.t, run.motion->u());
    }
    const bool fits = !state.touches || (updates_ >= fewest && (is_small(state) || comes_no_nearer(state)));
    const bool ends = loads_stay && (fits || updates_ >= most);
    run.contact_settled = ends && state.balanced;
    change_ = state.change;
    is_pending_ = !ends && state.touches;
    evaluations_ = run.evaluations();
  }

  // Forces by new multipliers are those of no state before the body has answered to them: what is recorded and judged
  // comes first.
  void go_on(RunState& run) override {
    if (!std::exchange(is_pending_, false)) return;
    const bool loads_stay = run.loads_stay();
    // The last evaluation has to be at this state, and others may have looked elsewhere meanwhile.
    if (run.evaluations() != evaluations_) run.motion->norms.residual(run.t, run.motion->u());
    const double residual = run.motion->known_residual(run.t);  // the last evaluation is at this state then
    run.motion->system.change_last([&](Vec R, TrialState& trial) {
      run.model.phase->control().update_multipliers(run.t, run.motion->u(), /*evenly=*/!loads_stay, R, trial);
    });
    run.motion->stepper->take_changed_forces(run.t);
    run.measured.discard();
    last_ = run.t;
    if (!loads_stay) return;
    ++updates_;
    since_nearest_ += std::clamp(std::log10(unbalanced_ / residual), 0.0, 2.0);
    if (change_ < nearer() * least_change_) least_change_ = change_, since_nearest_ = 0;
    unbalanced_ = run.motion->known_residual(run.t);
    goal_ = remembers_ ? std::clamp(third * unbalanced_, least_, std::max(quiet, least_))
                       : std::clamp(half * unbalanced_, nearest_, std::max(early, least_));
  }

  // Takes an equilibrium back whose contact penetrates by much, as its multipliers come to no end, or whose forces are
  // still other ones from one update to the next.
  void confirm(RunState& run, Verdict& verdict) override {
    constexpr double much = 5 * largest_misfit, other = 0.05;
    if (!touches_) return;
    const ContactState state = run.model.phase->supports().contact_state(run.t, run.motion->u());
    const bool are_other = state.change > other && unbalanced_ > 10 * least_;
    if (!are_other && (updates_ < most || state.misfit <= much)) return;
    verdict = {RunStatus::step_limit,
               fmt::format("no equilibrium: after {} updates of its multipliers contact still gives way by {:.2g} "
                           "cells where most, and another would change the forces on the body by {:.2g} %; "
                           "{}; it ended with {}",
                           updates_, state.misfit, 100 * state.change, remedy(run), verdict.reason)};
  }

  // Near a rest that friction keeps, places stick, slip and open in turn: a full step changes which, and its forces
  // jump by as much as they are out of balance. A share of the load is no easier, as its pressures are that share.
  void explain(RunState& run, Verdict& verdict) override {
    if (!touches_ || !run.scene.rubs() || !run.scene.solve.is_static() || verdict.status != RunStatus::failed) return;
    verdict.reason +=
        "; where contact has friction a static solver may find no rest though there is one, which "
        "solve.method = \"relaxation\" finds";
  }

  void fill_state(Summary& summary, RunState& run) override {
    if (!touches_) return;
    note_stretch(summary, run);
    if (!run.scene.stop.wants_equilibrium()) return;
    const ContactState state = run.model.phase->supports().contact_state(run.t, run.motion->u());
    if (!state.balanced)
      add_note(summary, "a free rigid body is not in balance: nothing that it touches bears all of the force on it");
    note_slides(summary, run);
    if (state.misfit <= largest_misfit && state.change <= negligible) return;
    add_note(summary,
             fmt::format("contact gives way by {:.2g} cells where most, and its forces on the body may be off by "
                         "{:.2g} %: its multipliers are those of an earlier state",
                         state.misfit, 100 * state.change));
  }

  void archive(const StateArchive& state, RunState& run) override {
    state("updates", updates_, "goal", goal_, "last", last_, "least_change", least_change_, "since_nearest",
          since_nearest_, "unbalanced", unbalanced_, "settled", run.contact_settled, "look", look_, "change", change_,
          "is_pending", is_pending_);
  }

 private:
  static constexpr double early = 0.1, quiet = 1e-2, least_by_default = 1e-6, largest_misfit = 1e-3;
  static constexpr double half = 0.5, third = 0.3;
  static constexpr double negligible = 1e-3;     // change of the forces
  static constexpr long fewest = 2, most = 200;  // updates
  static constexpr long stride = 8;              // [steps] between two looks at the residual of a motion

  // What supports hold does not get out of the way, whatever the cells.
  static std::string remedy(RunState& run) {
    for (const ContactReport& contact : run.model.phase->supports().contacts(run.t, run.motion->u())) {
      if (!(contact.held > largest_misfit)) continue;
      std::string names;
      for (const SupportSpec& support : run.scene.supports)
        if (!support.name.empty()) names += (names.empty() ? ", as by " : " or ") + in_quotes(support.name);
      return fmt::format(
          "{} is {:.2g} cells deep in a border that a support holds there{}, and that cannot get out of its way; "
          "expected one of the two to be elsewhere",
          in_quotes(contact.name), contact.held, names);
    }
    return "expected smaller cells";
  }
  // Within a phase a piece keeps the facet that was opposite to it.
  static void note_slides(Summary& summary, RunState& run) {
    if (run.scene.phase.ends()) return;
    for (const ContactReport& contact : run.model.phase->supports().contacts(run.t, run.motion->u()))
      if (contact.slid > 1)
        add_note(summary, fmt::format("the bodies of contact {} slid by up to {:.2g} cells along each other, and "
                                      "still touch the parts of their borders that were opposite at the start; "
                                      "expected phases, as by phase.max_motion = 0.3",
                                      contact.name, contact.slid));
  }
  static void note_stretch(Summary& summary, RunState& run) {
    constexpr double much = 3;
    for (const ContactReport& contact : run.model.phase->supports().contacts(run.t, run.motion->u()))
      if (contact.stretch > much)
        add_note(summary,
                 fmt::format("a border in the contact {} is drawn to {:.2g} times its length: what draws it may "
                             "pass between its points; expected smaller cells, or more points in a cell",
                             contact.name, contact.stretch));
  }
  // The share of the least change so far that a nearer one stays below: with friction each update waits for longer.
  double nearer() const { return remembers_ ? half : 0.7; }
  bool is_small(const ContactState& state) const {
    return state.misfit <= largest_misfit && state.change <= largest_change_;
  }
  bool comes_no_nearer(const ContactState& state) const {
    constexpr double patience = 4;
    constexpr long enough = 40;  // updates, of which the last twenty keep what opens (contact_force.hpp)
    return state.misfit <= largest_misfit && since_nearest_ >= patience &&
           ((remembers_ && state.change <= negligible) || updates_ >= enough);
  }
  // Whether the body is as near to balance as the next update wants it.
  bool is_due(RunState& run, bool loads_stay) {
    if (run.motion->stepper->moves() && ++look_ % stride != 0) return false;
    if (loads_stay) return run.motion->known_residual(run.t) <= goal_;
    constexpr double patience = 4, answer = 0.5;  // of the time between two, until the body has answered to one
    if (run.t < last_ + between_) return false;
    const bool is_soon_shown = run.landing < run.t + answer * between_;
    if (is_soon_shown && run.landing < last_ + patience * between_) return false;
    return run.t >= last_ + patience * between_ || run.motion->known_residual(run.t) <= quiet;
  }

  bool touches_, remembers_;  // remembers_: with friction
  double least_;              // the residual that the scene asks for
  double nearest_;            // the smallest to wait for: a static solver has come to rest at what is asked for
  double largest_change_;     // that another update would make, as a share of the forces of contact
  double between_;            // the time between updates under changing loads [s]
  double goal_;               // the residual to wait for
  double last_ = 0;           // when the last update was [s]
  // Under loads that stay:
  double least_change_ = std::numeric_limits<double>::infinity();  // that an update has made
  double since_nearest_ = 0;  // the updates since then, each by the decades of its way to balance, at most two
  double unbalanced_ = 0;     // the residual after the last one
  long updates_ = 0, look_ = 0;
  long evaluations_ = 0;     // when it became due
  double change_ = 0;        // that the update which is due would make
  bool is_pending_ = false;  // whether one is due
};

}  // namespace

std::unique_ptr<Watcher> watch_multipliers(RunState& run) { return std::make_unique<Multipliers>(run); }

}  // namespace stillpoint
