// How a run ends: its status and the reason in words, and what a reason says of a run that goes wrong.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/summary.hpp>

#include <functional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "parallel/of_all.hpp"
#include "simulation/phase_motion.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// The outcome of a test of a run: by default the run goes on.
struct Verdict {
  RunStatus status = RunStatus::running;
  std::string reason{};

  bool ends() const { return status != RunStatus::running; }
};

/// Whether a run of this status is over, by a test of its scene; otherwise it went wrong, or could go on.
inline bool is_own_end(RunStatus status) {
  using enum RunStatus;
  return status == equilibrium || status == unstable_equilibrium || status == limit_load || status == end_time ||
         status == step_limit;
}

/// A request that a run ends though it could go on: by its user, or because stop.wall_time is over.
class EndRequest {
 public:
  /// wall_time: the limit since this object was made [s]; 0: there is none. interrupted: asks the user; may be empty.
  EndRequest(double wall_time, std::function<bool()> interrupted)
      : wall_time_(wall_time), interrupted_(std::move(interrupted)) {}

  /// True if the run is to end. Once this is so the question is not put again.
  bool asked() {
    if (request_.ends()) return true;
    if (const double seconds = wall_.seconds(); wall_time_ > 0 && seconds >= wall_time_) {
      request_ = {RunStatus::time_limit, fmt::format("{:.3g} s of wall time reached stop.wall_time", seconds)};
    } else if (interrupted_ && interrupted_()) {
      request_ = {RunStatus::interrupted, "interrupted by the user"};
    }
    return request_.ends();
  }
  /// True if the run is to end on any rank: as the first of them says, or as the first that was asked.
  bool asked_of_any(const Ranks* ranks) {
    if (!ranks) return asked();
    if (asked()) ranks->wish_for_end();
    if (!ranks->someone_wishes_end()) return false;
    const std::string reason = first_text(ranks, request_.reason);
    for (const RunStatus status : of_all(ranks, request_.status)) {
      if (status == RunStatus::running) continue;
      request_ = {status, reason};
      break;
    }
    return true;
  }
  /// time_limit or interrupted; running if nothing has asked for the end.
  RunStatus status() const { return request_.status; }
  const std::string& reason() const { return request_.reason; }
  /// The verdict on a run that heeds the request; `where`: how far it had come.
  Verdict verdict(const std::string& where) const { return {request_.status, request_.reason + "; " + where}; }

 private:
  Stopwatch wall_;
  double wall_time_;
  std::function<bool()> interrupted_;
  Verdict request_;
};

/// A formula or a load of the program's own that is no finite number in the step from t to t + step [s],
/// "body_force.value is not a number at t = 0.3 at material point 12 at (0.5, 0.25)"; empty: all have values.
std::string load_without_value(const Problem& problem, const LagrangianPhase& phase, double t, double step);

/// "material point 12 at (0.5, 0.25) in cell (3, 1) is stressed most, by 3e+08 Pa" at (t, u).
std::string most_stressed(const LagrangianPhase& phase, double t, ConstVec u);

/// The nodes that are furthest from rest at t: the one with the largest out-of-balance force, and the fastest one.
std::string furthest_from_rest(PhaseMotion& motion, double t);

}  // namespace stillpoint
