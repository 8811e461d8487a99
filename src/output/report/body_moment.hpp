// A body at one moment, whose fields can be asked for one after the other: as it is in memory, or as fields.h5 has it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "output/hdf5_file.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct BodyMoment {
  double t = 0;  // [s]
  int dim = 1;
  std::size_t points = 0;                  // P
  std::vector<std::string> history_names;  // what laws remember beside the stress
  /// (P × components) of "position", "u", "v", "stress" and history_names.
  std::function<std::vector<double>(const std::string&)> field;
};

/// At (t, u, v); to be asked while these and the phase are as they are.
BodyMoment moment_of(const LagrangianPhase& phase, double t, ConstVec u, ConstVec v);
/// A frame of fields.h5, by its group. Throws std::filesystem::filesystem_error if it cannot be read, and so does its
/// field(), for which the file stays open.
BodyMoment moment_of(const Hdf5File& fields, const std::string& frame);

}  // namespace stillpoint
