// Scenes with a block and a rigid body, of which tests replace what they need.
#pragma once

#include <stillpoint/scene.hpp>

#include <string>

#include <fmt/format.h>

#include "temporary_folder.hpp"

namespace stillpoint::test {

/// A block on its support and a rigid body, which these lines describe; state: of the block.
inline std::string text_of_scene(int dim, const std::string& corners, const std::string& state,
                                 const std::string& rigid) {
  return fmt::format(R"(dim = {}
[grid]
{}
material = "rubber"
state = "{}"
[material.rubber]
law = "neo-hookean"
E = 1.0
nu = 0.3
rho = 1.0
[[support]]
name = "base"
face = "bottom"
[stop]
residual = 0
time = 1
[[rigid]]
name = "punch"
{}
)",
                     dim, corners, state, rigid);
}

/// In the plane.
inline std::string plane_text(const std::string& rigid, const std::string& state = "plane-strain") {
  return text_of_scene(2, "min = [0, 0]\nmax = [2, 2]\ncells = [4, 4]\n[[body]]\nname = \"block\"\nmax = [2, 1]", state,
                       rigid);
}
/// The same in space.
inline std::string space_text(const std::string& rigid) {
  return text_of_scene(
      3, "min = [0, 0, 0]\nmax = [2, 2, 2]\ncells = [4, 4, 4]\n[[body]]\nname = \"block\"\nmax = [2, 1, 2]", "space",
      rigid);
}

inline Scene plane_scene(const std::string& rigid, const std::string& state = "plane-strain") {
  const TemporaryFolder folder;
  return load_scene(folder.write("scene.toml", plane_text(rigid, state)));
}
inline Scene space_scene(const std::string& rigid) {
  const TemporaryFolder folder;
  return load_scene(folder.write("scene.toml", space_text(rigid)));
}

}  // namespace stillpoint::test
