// What the tests of convergence studies share: studies of scenes of problems/, and what they say.
#pragma once

#include <stillpoint/converge.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

namespace stillpoint::test {

inline ConvergenceStudy study_of(const std::string& problem, const std::vector<std::string>& overrides,
                                 const ConvergeOptions& options) {
  return converge(scenes::load(problem, overrides), options);
}

inline const StudiedQuantity& quantity(const ConvergenceStudy& study, const std::string& name) {
  const auto found = std::ranges::find(study.quantities, name, &StudiedQuantity::name);
  REQUIRE(found != study.quantities.end());
  REQUIRE(found->order);
  return *found;
}

inline bool says(const ConvergenceStudy& study, const std::string& part) {
  return std::ranges::any_of(study.notes,
                             [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

// The problem, though nobody knows its solution.
inline std::filesystem::path without_exact(const std::string& problem, const TemporaryFolder& folder) {
  std::string text = contents(std::filesystem::path(STILLPOINT_PROBLEMS) / (problem + ".toml"));
  const std::size_t begin = text.find("[exact]"), end = text.find("[[probe]]", begin);
  return folder.write(problem + ".toml", text.erase(begin, end == std::string::npos ? end : end - begin));
}

// The bar swings freely.
inline const std::vector<std::string> swinging = {"damping.strategy=none", "stop.residual=0", "stop.time=3",
                                                  "integrator.step_fraction=0.2"};

}  // namespace stillpoint::test
