// A value that a study gives a problem.
#pragma once

#include <stillpoint/scene.hpp>

#include <functional>
#include <string>
#include <vector>

namespace stillpoint {

struct Setting {
  std::string text;  // as --set would write it, "grid.cells=[40, 20]": for the record
  std::function<void(Problem&)> apply;
};
using Settings = std::vector<Setting>;

/// The scene with what `change` does to its problem, resolved and checked anew; its file is not read again. Throws
/// SceneError.
Scene changed(Scene scene, const std::function<void(Problem&)>& change);
/// The scene with these values, likewise.
Scene with(const Scene& scene, const Settings& settings);

std::vector<std::string> texts_of(const Settings& settings);

}  // namespace stillpoint
