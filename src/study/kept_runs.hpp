// Finished runs of a study on the disk, so that an interrupted study can be resumed.
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
  /// folder: empty if nothing is kept. resumes: whether existing files are used. A kept run is identified by the
  /// scene's text, its overrides, its files of points, and this version of the program.
  KeptRuns(std::filesystem::path folder, bool resumes, const Scene& scene);

  /// The finished run of this name. Throws StateError if the file is damaged, or of another scene, version or set.
  std::optional<LevelRun> find(const std::string& name, const std::vector<std::string>& set) const;
  /// Removes a run that an earlier study has kept, unless the study is resumed.
  void begin(const std::string& name) const;
  /// Writes a run at once, completely or not at all, and only if it came to its end. Throws
  /// std::filesystem::filesystem_error.
  void keep(const std::string& name, const LevelRun& run) const;

 private:
  std::filesystem::path file_of(const std::string& name) const { return folder_ / (name + ".json"); }

  std::filesystem::path folder_;
  bool resumes_;
  Json scene_;  // identity of the scene whose runs these are
};

}  // namespace stillpoint
