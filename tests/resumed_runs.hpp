// What runs leave behind, to compare one that was broken off and resumed with one that was not.
#pragma once

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

namespace stillpoint::test {

// What a run leaves behind, but for its times on the clock.
inline std::string left_by(const Summary& s, const std::filesystem::path& out) {
  std::string left = fmt::format("{} {} steps {} evaluations {} phases {} rejected\n{:a} {:a} {:a} {:a} {:a}\n{}\n",
                                 s.reason, s.steps, s.rhs_evaluations, s.phases, s.rejected_steps, s.residual,
                                 s.distance.value_or(0), s.momentum_error.value_or(0), s.plastic_overshoot.value_or(-1),
                                 s.unbalanced_plastic_work.value_or(-1), fmt::join(s.notes, "\n"));
  for (const StageFigures& stage : s.stages)
    left += fmt::format("{:a} to {:a}: {} {} {:a} {}\n", stage.begin, stage.end, to_string(stage.status), stage.reason,
                        stage.residual, stage.steps);
  for (const char* name : {"history.csv", "fields.h5", "fields.xdmf"})
    if (std::filesystem::exists(out / name)) left += contents(out / name);
  return left;
}

inline std::string unbroken(const Scene& scene) {
  const TemporaryFolder folder;
  const Summary s = run(scene, {.out = folder.path()});
  return left_by(s, folder.path());
}

inline std::string resumed(const std::filesystem::path& out) {
  const std::filesystem::path checkpoint = out / "checkpoint.h5";
  const Summary s = run(load_scene_of(checkpoint), {.out = out, .resume = checkpoint});
  return left_by(s, out);
}

}  // namespace stillpoint::test
