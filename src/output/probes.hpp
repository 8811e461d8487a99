// All probes of a scene, and the forces on its walls: the columns of history.csv that a scene asks for.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/state_archive.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "output/probe.hpp"

namespace stillpoint {

class Probes {
 public:
  /// Begins the run. All arguments have to outlive it. Throws SceneError if a probe names a field that no law has.
  Probes(const Problem& problem, const LagrangianPhase& phase);

  const std::vector<std::string>& columns() const { return columns_; }  // "<probe>.<field>"
  /// The position of each point's probe when the run began, by name, (dim) [m].
  std::map<std::string, std::vector<double>> positions() const;
  /// The values at (t, u, v), in the order of columns(); the state is that of the last commit.
  std::vector<double> read(double t, ConstVec u, ConstVec v);
  /// end_phase() is called before a phase ends at (t, u, v), begin_phase() once the next has begun, if it has.
  void end_phase(double t, ConstVec u, ConstVec v);
  void begin_phase(double t, ConstVec u, ConstVec v);
  void end_stage();
  void begin_stage(double t, ConstVec u, ConstVec v);
  void archive(const StateArchive& state);
  /// Remarks on the values that the user should know, a sentence each.
  std::vector<std::string> notes() const;

 private:
  const Problem& problem_;
  const LagrangianPhase& phase_;
  std::vector<std::unique_ptr<Probe>> probes_;  // as the scene lists them
  std::vector<std::string> columns_;
};

/// Throws SceneError if the body cannot answer a probe: it has no such material point, or no material at a place or in
/// a box. phase: the first phase.
void check_probes(const Problem& problem, const LagrangianPhase& phase);

}  // namespace stillpoint
