// Scenes with a block and a rigid body, of which tests replace what they need.
#pragma once

#include <stillpoint/scene.hpp>

#include <string>

#include "temporary_folder.hpp"

namespace stillpoint::test {

/// A block in the plane and a rigid body, which these lines describe.
inline std::string plane_text(const std::string& rigid, const std::string& state = "plane-strain") {
  return R"(dim = 2
[grid]
min = [0, 0]
max = [2, 2]
cells = [4, 4]
[[body]]
name = "block"
max = [2, 1]
material = "rubber"
state = ")" +
         state + R"("
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
)" + rigid +
         "\n";
}

/// The same in space.
inline std::string space_text(const std::string& rigid) {
  return R"(dim = 3
[grid]
min = [0, 0, 0]
max = [2, 2, 2]
cells = [4, 4, 4]
[[body]]
name = "block"
max = [2, 1, 2]
material = "rubber"
state = "space"
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
)" + rigid +
         "\n";
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
