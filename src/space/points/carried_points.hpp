// What a stage of a run hands on to the next, or a run to another, whatever the kinematics.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <cstddef>
#include <vector>

namespace stillpoint {

/// What has rested so far while other parts moved (phase.rest).
struct RestRecord {
  double time = 0;        // over which parts could rest or move [s]
  double points = 0;      // ∫ share of the points at rest dt [s]
  double held_force = 0;  // RestFigures::held_force

  void archive(const StateArchive& state) { state("time", time, "points", points, "held_force", held_force); }
};

class CarriedBody {
 public:
  virtual ~CarriedBody() = default;
  /// Saves or restores it.
  virtual void archive(const StateArchive& state) = 0;
  /// Makes it the beginning of another run, at rest. numbers: BodySpec::number there of each of its bodies, in their
  /// order, or not_taken. forgets: whether displacements count from here.
  virtual void begin_other_run(const std::vector<std::size_t>& numbers, bool forgets) = 0;
  static constexpr std::size_t not_taken = static_cast<std::size_t>(-1);

  SavedState conditions;               // what walls, loads and supports remember, by their kinds
  std::vector<double> out_of_balance;  // F − R at the end, (functions × dim) [N]; empty: not known
  std::vector<int> fields;             // the field of motion of each body there (motion_fields.hpp)
  RestRecord rest;                     // of all stages so far
};

}  // namespace stillpoint
