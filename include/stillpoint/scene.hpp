// A scene: a problem that is written down in a TOML file, read and validated as a whole.
//
// In one dimension a scene may write a plain number for a vector. Every number may also be a string: a formula in the
// scene's constants.
#pragma once

#include <stillpoint/problem.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace stillpoint {

struct VariantSpec {  // [[variant]]: the same scene with other values, drawn beside it
  std::string name;
  std::vector<std::string> set;  // "key=value" as for --set
};

struct Scene : Problem {
  Scene() = default;
  /// A problem of a program's own, which stands in no file.
  explicit Scene(Problem problem) : Problem(std::move(problem)) {}

  std::filesystem::path file;
  std::string text;                    // contents of the file
  std::vector<std::string> overrides;  // laid over the file's contents
  std::vector<VariantSpec> variants;
  std::map<std::string, Location> where;  // location of each key written ("support[0].at"), for faults found later

  /// Location of a key, or of the nearest table around it that was written.
  Location location(const std::string& key) const;
  /// The error, with the locations in the file added for those keys that it names without one.
  SceneError located(const SceneError& error) const;
};

/// Reads, checks and completes a scene; overrides are "dotted.key=value" with a TOML value (a bare word is a string).
/// Throws SceneError with every problem.
Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});
/// Loads a scene from a text that was read from the file before.
Scene load_scene(const std::filesystem::path& file, const std::string& text, const std::vector<std::string>& overrides);

}  // namespace stillpoint
