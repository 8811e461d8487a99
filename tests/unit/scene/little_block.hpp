// What the tests of plane scenes share: a block of one material.
#pragma once

#include <stillpoint/scene.hpp>

#include <string>

#include "temporary_folder.hpp"

namespace stillpoint::test {

/// An elastic block that says as little as it can, with more text after it.
inline Scene load_block(const std::string& after = "", const std::string& body = "",
                        const std::string& law = "neo-hookean") {
  const TemporaryFolder folder;
  return load_scene(folder.write("block.toml", R"(
dim = 2
[grid]
min = [0, 0]
max = [2, 1]
cells = [4, 2]
[material.rubber]
law = ")" + law + R"("
E = 1e6
nu = 0.3
rho = 1000
)" + (law == "drucker-prager" ? "phi = 30\n" : "") +
                                                   (body.empty() ? "[body]\nmaterial = \"rubber\"\n" : body) + after));
}

}  // namespace stillpoint::test
