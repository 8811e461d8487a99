// A scene in plane strain.
#pragma once

#include <string>

namespace stillpoint::test {

/// A block that is held at its base and pressed from above and from the side, until it yields.
inline const std::string yielding_block = R"(dim = 2
[grid]
min = [0, 0]
max = [2, 1]
cells = [8, 4]
[body]
material = "clay"
points_per_cell = 4
[material.clay]
law = "drucker-prager"
E = 1e4
nu = 0.3
rho = 2.0
phi = 20
psi = 20
c = 10
[phase]
max_motion = "none"
[[support]]
face = "bottom"
[[support]]
face = "left"
kind = "roller"
[[traction]]
face = "top"
value = [0, -28]
[stop]
residual = 1e-8
steps = 20000
[[probe]]
name = "middle"
at = [1.0, 0.5]
fields = ["u.y", "stress.yy", "stress.xx"]
)";

}  // namespace stillpoint::test
