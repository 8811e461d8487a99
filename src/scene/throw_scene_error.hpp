// Reports of bad input that shows only after the scene was read: when the scene is discretised, or in an option.
#pragma once

#include <stillpoint/scene.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace stillpoint {

/// Throws a SceneError about one key; located() adds the location of the key in the file.
[[noreturn]] inline void throw_scene_error(const std::string& key, const std::string& message) {
  throw SceneError({{.where = {.file = key}, .message = message, .key = key}});
}

/// Returns what make() returns. A SceneError that it throws gets the locations in the scene's file.
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
