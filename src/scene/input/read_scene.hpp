// Reads a scene from a TOML file, and tells the keys that there are.
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
/// The same of a text, which stands for that of the file. name: what locations in the text are called; empty: there are
/// none, and faults are told by their keys alone.
Scene read_scene(const std::filesystem::path& file, std::string text, std::string name,
                 const std::vector<std::string>& overrides, const Catalogue& catalogue);
/// The same of a scene's own text, with more overrides laid over it.
Scene read_again(const Scene& scene, const std::vector<std::string>& more, const Catalogue& catalogue);

/// The same of a program's own problem, see resolve().
Problem resolved(Problem problem, const Catalogue& catalogue);

/// The keys in a list for the terminal.
std::string key_list(const Catalogue& catalogue);
/// In Markdown: the second half of problems/README.md, after a head that is written by hand.
std::string key_reference(const Catalogue& catalogue);
/// In a JSON schema for editors.
std::string key_schema(const Catalogue& catalogue);

}  // namespace stillpoint
