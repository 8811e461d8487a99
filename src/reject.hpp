// How what only shows once a scene is discretised is reported.
#pragma once

#include <stillpoint/scene.hpp>

#include <string>

namespace stillpoint {

/// Throws a SceneError with one problem, at the place of a key (or of the nearest table around it).
[[noreturn]] inline void reject(const Scene& scene, const std::string& key, const std::string& message) {
  throw SceneError({{scene.location(key), message}});
}

}  // namespace stillpoint
