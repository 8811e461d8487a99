// Scenes of problems/ with other values, as `--set` would make them.
#pragma once

#include <stillpoint/stillpoint.hpp>

#include <string>
#include <vector>

namespace scenes {

inline stillpoint::Scene load(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return stillpoint::load_scene(std::string(STILLPOINT_PROBLEMS) + "/" + name + ".toml", overrides);
}
inline stillpoint::Scene bar(const std::vector<std::string>& overrides = {}) { return load("bar", overrides); }

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
