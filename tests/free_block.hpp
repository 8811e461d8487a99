// A block that flies freely inside its grid, as a scene with overrides.
#pragma once

#include <stillpoint/scene.hpp>

#include <string>
#include <vector>

#include "temporary_folder.hpp"

namespace stillpoint::test {

/// 5 × 2 cells of 0.25 m with four points each, in a grid of 9 × 4. No supports, no gravity, no damping.
inline Scene free_block(const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  return load_scene(folder.write("block.toml", R"(
dim = 2
[grid]
min = [0, 0]
max = [2.25, 1.0]
cells = [9, 4]
[body]
min = [0.5, 0.25]
max = [1.75, 0.75]
material = "stuff"
points_per_cell = 4
[material.stuff]
law = "neo-hookean"
E = 1e4
nu = 0.3
rho = 1000
[phase]
max_motion = 0.1
[damping]
strategy = "none"
[stop]
residual = 0
time = 0.15
[output]
every = 0.01
)"),
                    overrides);
}

/// The same of cohesionless soil.
inline Scene free_soil(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), {"material.stuff={law='drucker-prager', E=1e4, nu=0.3, rho=1000, phi=35}"});
  return free_block(overrides);
}

}  // namespace stillpoint::test
