// Reads a scene from a TOML file.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/scene.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace stillpoint {

/// Reads, checks and completes a scene, which may choose from the catalogue; overrides are "dotted.key=value". Throws
/// SceneError with every problem.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const Catalogue& catalogue);
/// The same of a text, which stands for that of the file.
Scene read_scene(const std::filesystem::path& file, std::string text, const std::vector<std::string>& overrides,
                 const Catalogue& catalogue);

/// The same of a program's own problem, see resolve().
Problem resolved(Problem problem, const Catalogue& catalogue);

}  // namespace stillpoint
