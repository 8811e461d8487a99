// Scenes of problems/ with other values, as `--set` would make them.
#pragma once

#include <stillpoint/stillpoint.hpp>

#include <string>
#include <vector>

namespace scenes {

inline stillpoint::Scene load(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return stillpoint::load_scene(std::string(STILLPOINT_PROBLEMS) + "/" + name + ".toml", overrides);
}

/// Overrides and more of them.
inline std::vector<std::string> with(std::vector<std::string> overrides, const std::vector<std::string>& more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

inline stillpoint::Scene bar(const std::vector<std::string>& overrides = {}) { return load("bar", overrides); }

/// The end of a run of a scene of this text, or of a rung of the ladder, on one thread: tests run side by side.
inline stillpoint::Summary run_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return stillpoint::run(stillpoint::load_scene("scene.toml", text, overrides), {.threads = 1});
}
inline stillpoint::Summary run_ladder(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return stillpoint::run(load("ladder/" + name, overrides), {.threads = 1});
}

/// Why such a scene is refused; empty if it is not.
inline std::string refusal(const std::string& name, const std::vector<std::string>& overrides) {
  try {
    load(name, overrides);
  } catch (const stillpoint::SceneError& error) {
    return error.what();
  }
  return "";
}

/// Last value of a probe's field.
inline double probe(const stillpoint::Summary& summary, const std::string& name, const std::string& field) {
  for (const auto& [key, value] : summary.probes.at(name)) {
    if (key == field) return value;
  }
  throw std::out_of_range("no field " + field + " at probe " + name);
}

}  // namespace scenes
