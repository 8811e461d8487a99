// Parts that simulations of one body have in common and that are made once: phases, and what is found of them.
#pragma once

#include <stillpoint/problem.hpp>

#include <any>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/stopwatch.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// A part of a set-up, and how long it takes to make [s].
struct SetUpPart {
  std::string name;
  double seconds = 0;
};

/// The common parts of problems that differ in damping, integrator, solver and the scaling of the mass alone.
/// Simulations that share a store may run side by side.
class SetUpStore {
 public:
  /// A phase at its start, in use by nobody else.
  struct MadePhase {
    std::unique_ptr<LagrangianPhase> phase;
    double seconds = 0;  // that it took to make, then or now
    bool made_now = true;
  };
  static MadePhase make(const Problem& problem, const PhaseBegin& begin = {});  // without a store
  MadePhase phase(const Problem& problem);
  /// Keeps a phase for whoever asks next, if runs leave nothing in it: no history, no contact and no other phase.
  void give_back(const MassSpec& mass, std::unique_ptr<LagrangianPhase> phase);

  /// Returns what make() gave when it was first asked for by this name, and how long that took.
  template <class Make>
  auto once(const std::string& name, const Make& make) {
    struct Made {
      decltype(make()) value;
      double seconds;
      bool made_now;
    };
    const std::scoped_lock lock(making_);
    const auto found = found_.find(name);
    if (found != found_.end()) {
      return Made{std::any_cast<const decltype(make())&>(found->second.value), found->second.seconds, false};
    }
    const Stopwatch watch;
    Made made{make(), 0, true};
    made.seconds = watch.seconds();
    found_[name] = {made.value, made.seconds};
    return made;
  }

 private:
  struct Found {
    std::any value;
    double seconds = 0;
  };
  struct Phases {
    std::vector<std::unique_ptr<LagrangianPhase>> idle;
    double seconds = 0;
  };

  std::mutex making_, keeping_;
  std::map<std::string, Found> found_;
  std::map<std::string, Phases> phases_;  // by their mass
};

/// The name of ω₁ of the elastic tangent at the start among the parts.
inline constexpr const char* part_omega_1 = "omega_1";

/// Names a mass among those of one body.
std::string to_string(const MassSpec& mass);

/// The set-up of one simulation: its parts, made here or taken from a store.
class SetUp {
 public:
  /// store: null if there is none; outlives this object.
  explicit SetUp(SetUpStore* store) : store_(store) {}

  /// A stage after the first one has nothing in common with other simulations.
  std::unique_ptr<LagrangianPhase> phase(const Problem& problem, const PhaseBegin& begin);
  /// Leaves a phase that this set-up does without to the store, if there is one.
  void give_back(const MassSpec& mass, std::unique_ptr<LagrangianPhase> phase) {
    if (store_) store_->give_back(mass, std::move(phase));
  }
  /// Returns make(), or what it once gave for a body of this mass.
  template <class Make>
  auto shared(const char* part, const MassSpec& mass, const Make& make) {
    if (!store_) {
      const Stopwatch watch;
      auto value = make();
      add(part, watch.seconds(), true);
      return value;
    }
    auto made = store_->once(part + (", " + to_string(mass)), make);
    add(part, made.seconds, made.made_now);
    return std::move(made.value);
  }

  /// The parts with their times, even if another simulation made them.
  const std::vector<SetUpPart>& parts() const { return parts_; }
  /// The share of these times that was spent for another simulation [s].
  double spared_s() const { return spared_s_; }

 private:
  void add(const std::string& part, double seconds, bool made_now);

  SetUpStore* store_;
  std::vector<SetUpPart> parts_;
  double spared_s_ = 0;
};

}  // namespace stillpoint
