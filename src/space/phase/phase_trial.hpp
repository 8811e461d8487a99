// The trial states of a phase, and its state at the last commit.
#pragma once

#include <stillpoint/semi_discrete.hpp>

#include <vector>

#include "base/work_pool.hpp"

namespace stillpoint {

/// The arrays of a trial. Successive phases use the same ones, whose memory pages are already mapped.
struct TrialArrays {
  std::vector<double> u;                     // over the grid's functions, (functions × dim)
  std::vector<std::vector<double>> history;  // of each material
  std::vector<double> averages;              // effect of MeanDilatation on each point, if points share their dilatation
  long holds_rest_of = -1;                   // the phase of whose points at rest `history` is
};

struct PhaseTrial final : TrialState {
  explicit PhaseTrial(WorkPool<TrialArrays>::Loan from) : arrays(std::move(from)) {}

  const SemiDiscrete* of = nullptr;
  long phase = 0;
  bool evaluated = false;
  double motion = 0;          // the largest motion [cells], if it ends the phase
  bool keeps_history = true;  // false if the trial holds nothing that was not committed before
  WorkPool<TrialArrays>::Loan arrays;
};

struct CommittedState {
  double t = 0, motion = 0;  // as in PhaseTrial
  std::vector<double> u;     // over the grid's functions, (functions × dim)
  std::vector<double> averages;
};

}  // namespace stillpoint
