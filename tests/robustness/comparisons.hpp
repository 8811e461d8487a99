// What the tests of comparisons share: comparisons of scenes of problems/, and their rows.
#pragma once

#include <stillpoint/compare.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes.hpp"

namespace stillpoint::test {

inline Comparison compared(const std::string& problem, CompareOptions options,
                           const std::vector<std::string>& set = {}) {
  if (options.integrators.empty()) options.integrators = {"leapfrog"};
  if (options.threads == 0) options.threads = 1;  // tests run side by side
  return compare(scenes::load(problem, set), options);
}

inline const ComparedRun& row(const Comparison& c, const std::string& label) {
  const auto found = std::ranges::find(c.runs, label, &ComparedRun::label);
  if (found == c.runs.end()) throw std::out_of_range("no row " + label);
  return *found;
}

inline const std::vector<std::string> crushed = {"material.bar.law=neo-hookean", "force=[{at=10.0, value=-1000.0}]"};
inline const std::vector<std::string> to_time_20 = {"stop.residual=0", "stop.time=20"};

}  // namespace stillpoint::test
