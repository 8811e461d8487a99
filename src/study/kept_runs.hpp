// Finished runs of a study on the disk, so that one that was stopped can go on.
#pragma once

#include <stillpoint/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "study/level_run.hpp"

namespace stillpoint {

class KeptRuns {
 public:
  /// folder: empty: nothing is kept. resumes: whether to take what is there. A kept run is one of the scene's text, its
  /// overrides and its files of points, by this version.
  KeptRuns(std::filesystem::path folder, bool resumes, const Scene& scene);

  /// The finished run of this name. Throws StateError if the file is damaged, or of another scene, version or set.
  std::optional<LevelRun> find(const std::string& name, const std::vector<std::string>& set) const;
  /// Takes away what was kept of an earlier study that is not resumed.
  void begin(const std::string& name) const;
  /// Writes it at once, whole or not at all; only what came to its end. Throws std::filesystem::filesystem_error.
  void keep(const std::string& name, const LevelRun& run) const;

 private:
  std::filesystem::path file_of(const std::string& name) const { return folder_ / (name + ".json"); }

  std::filesystem::path folder_;
  bool resumes_;
  Json scene_;  // what it is a run of
};

}  // namespace stillpoint
