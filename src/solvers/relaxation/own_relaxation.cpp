// The iteration that takes its steps from a relaxation supplied by the calling program.
#include <stillpoint/own_relaxation.hpp>

#include <exception>
#include <utility>

#include "solvers/relaxation/relaxations.hpp"
#include "solvers/relaxation/staggered_iteration.hpp"

namespace stillpoint {
namespace {

class OwnIteration final : public StaggeredIteration {
 public:
  OwnIteration(const RelaxationOptions& options, RelaxationSystem& system, MakeOwnRelaxation make)
      : StaggeredIteration(options, system), make_(std::move(make)) {}

 private:
  MotionNow now() {
    return {.t = t(),
            .last_step = last_step(),
            .max_step = options().max_step,
            .omega_1 = relaxation().omega_1,
            .u = u().span(),
            .v = v().span(),
            .Q = Q().span(),
            .a = a().span(),
            .mass = &system().mass()};
  }

  // A phase never begins by halves: an exception thrown here is kept and thrown again by the first step.
  void on_restart() override {
    try {
      if (!own_) own_ = make_();
      own_->restart(now());
    } catch (...) {
      fault_ = std::current_exception();
    }
  }

  void propose(double h, Vec u_new, Vec v_new) override {
    if (fault_) std::rethrow_exception(fault_);
    own_->propose(h, now(), u_new, v_new);
  }

  // By then the step is taken, and everything around it has to follow: an exception is kept for the next step.
  void moved(double h) override {
    try {
      own_->moved(h, now());
    } catch (...) {
      fault_ = std::current_exception();
    }
  }

  void archive_strategy(const StateArchive& state) override {
    if (fault_) std::rethrow_exception(fault_);
    if (own_) own_->archive(state.part("own"));
  }

  MakeOwnRelaxation make_;
  std::unique_ptr<OwnRelaxation> own_;
  std::exception_ptr fault_;
};

}  // namespace

std::unique_ptr<Stepper> make_own_relaxation(const RelaxationOptions& options, RelaxationSystem& system,
                                             const MakeOwnRelaxation& make) {
  return std::make_unique<OwnIteration>(options, system, make);
}

}  // namespace stillpoint
