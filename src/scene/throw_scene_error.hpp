// How bad input is reported that only shows after the scene was read: once it is discretised, or in an option.
#pragma once

#include <stillpoint/scene.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace stillpoint {

/// Throws a SceneError of one key; who has the scene finds where it stands (located()).
[[noreturn]] inline void throw_scene_error(const std::string& key, const std::string& message) {
  throw SceneError({{.where = {.file = key}, .message = message, .key = key}});
}

/// What make() returns. A SceneError that it throws is told with the places in the scene's file.
template <class Make>
decltype(auto) located(const Scene& scene, const Make& make) {
  try {
    return make();
  } catch (const SceneError& error) {
    throw scene.located(error);
  }
}

/// The same for an option of the command, "--out DIR".
[[noreturn]] inline void throw_option_error(const std::string& option, const std::string& given,
                                            const std::string& message) {
  throw SceneError(std::vector<Mistake>(1, {{option + " " + given, 0, 0}, message}));
}
[[noreturn]] inline void throw_folder_error(const std::filesystem::path& out,
                                            const std::filesystem::filesystem_error& error) {
  throw_option_error("--out", out.string(), "cannot be written: " + error.code().message());
}

}  // namespace stillpoint
