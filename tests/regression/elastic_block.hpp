// A square elastic block, which scenes hold and load by overrides.
#pragma once

#include <stillpoint/stillpoint.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "temporary_folder.hpp"

namespace stillpoint::test {

// An elastic block, 1 m by 1 m, E = 1 and ν = 0.3, solved by Newton's method.
inline const std::string kBlock = R"(dim = 2
[grid]
min = [0, 0]
max = [1, 1]
cells = [8, 8]
[body]
material = "m"
points_per_cell = 9
[material.m]
law = "linear-elastic"
E = 1
nu = 0.3
rho = 1
[solve]
method = "newton"
[stop]
residual = 1e-11
)";

inline Scene block(const std::vector<std::string>& set) {
  const TemporaryFolder folder;
  return load_scene(folder.write("block.toml", kBlock), set);
}
inline Summary solved(const std::vector<std::string>& set) {
  const Summary s = run(block(set));
  REQUIRE(s.status == RunStatus::equilibrium);
  return s;
}

inline std::string of(const std::string& basis) { return "grid.basis=" + basis; }
inline std::string cells(int n) { return fmt::format("grid.cells=[{}, {}]", n, n); }

inline const std::string kFooting =
    "support=[{face='bottom', name='base'}, {face='top', name='footing', from=0.25, to=0.75, u=-0.01}]";

}  // namespace stillpoint::test
