// A body at one moment, whose fields are read one after the other: from memory, or from fields.h5.
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
  std::vector<std::string> history_names;  // history variables of the laws, besides the stress
  /// A field, (P × components): "position", "u", "v", "stress" or one of history_names.
  std::function<std::vector<double>(const std::string&)> field;
};

/// The body at (t, u, v); fields may be read as long as these and the phase are unchanged.
BodyMoment moment_of(const LagrangianPhase& phase, double t, ConstVec u, ConstVec v);
/// A frame of fields.h5, given by its group. It and its field() throw std::filesystem::filesystem_error if the file
/// cannot be read; the file has to stay open for field().
BodyMoment moment_of(const Hdf5File& fields, const std::string& frame);

}  // namespace stillpoint
