// A small scene without a fault, and ways to break it.
#pragma once

#include <stdexcept>
#include <string>

namespace stillpoint::testing {

/// Line 1 is [constants]; the tests below know the lines by number.
inline const std::string kGoodScene = R"([constants]
P0 = 1.0
[grid]
min = 0.0
max = 10.0
cells = 4
[body]
material = "steel"
points_per_cell = 3
[material.steel]
law = "linear-elastic"
E = 1.0
rho = 1.0
[[support]]
at = 0.0
u = 0.0
[[force]]
at = 10.0
value = "P0"
[damping]
strategy = "viscous"
c = 0.3
[integrator]
method = "leapfrog"
step_fraction = 0.9
[stop]
residual = 1e-6
time = 0.0
[[probe]]
name = "tip"
point = 12
fields = ["u"]
)";

/// The good scene with the first `from` replaced by `to`.
inline std::string broken(const std::string& from, const std::string& to, std::string scene = kGoodScene) {
  const auto at = scene.find(from);
  if (at == std::string::npos) throw std::logic_error("the good scene does not hold " + from);
  return scene.replace(at, from.size(), to);
}

}  // namespace stillpoint::testing
