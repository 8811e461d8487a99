// A small scene without a fault, and ways to break it.
#pragma once

#include <stillpoint/scene.hpp>

#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "temporary_folder.hpp"

namespace stillpoint::test {

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

/// The same in two dimensions: sand between a wall that moves and a side that it slides along.
inline const std::string kGoodPlane = R"(dim = 2
[constants]
angle = 35
[grid]
min = [0, 0]
max = [8, 4]
cells = [8, 4]
basis = "quadratic"
follow = "gate"
[body]
max = [8, 3]
material = "sand"
points_per_cell = 4
[material.sand]
law = "drucker-prager"
E = 1e7
nu = 0.3
rho = 1600
phi = "angle"
psi = 5
cone = "mean"
[mass]
scaling = 25
[phase]
max_motion = 0.1
transfer = "flip"
flip_share = 0.99
[[support]]
face = "bottom"
[[support]]
face = "left"
kind = "roller"
[[wall]]
name = "gate"
face = "right"
motion = "0.05*t"
friction = "rough"
[body_force]
value = [0, -9.81]
[initial.geostatic]
K0 = 0.5
surface = 3
[output]
stages = [0, 1.5, "angle/10"]
[[probe]]
name = "slope"
kind = "slope_angle"
[[probe]]
name = "toe"
at = [8, 0]
fields = ["u.x", "stress.yy"]
)";

/// The good scene with the first `from` replaced by `to`.
inline std::string broken(const std::string& from, const std::string& to, std::string scene = kGoodScene) {
  const auto at = scene.find(from);
  if (at == std::string::npos) throw std::logic_error("the good scene does not hold " + from);
  return scene.replace(at, from.size(), to);
}

/// The problems of a scene; empty if it loads.
inline std::vector<Mistake> problems_of(const std::filesystem::path& file,
                                        const std::vector<std::string>& overrides = {}) {
  try {
    load_scene(file, overrides);
  } catch (const SceneError& error) {
    return error.problems();
  }
  return {};
}

/// What is wrong with the text of a scene, each on a line of its own.
inline std::string complaints(const std::string& text) {
  const TemporaryFolder folder;
  std::string all;
  for (const Mistake& problem : problems_of(folder.write("scene.toml", text))) all += problem.message + "\n";
  return all;
}

struct BadScene {
  const char *name, *from, *to;  // the good scene with `from` replaced by `to`
  const char *where, *message;   // "line:column", part of the message
};

/// Each gives one problem, with what is wrong, its line and its column.
inline void check_each(const std::vector<BadScene>& scenes, const std::string& good) {
  const TemporaryFolder folder;
  for (const BadScene& bad : scenes) {
    INFO(bad.name);
    const auto file = folder.write("bad.toml", broken(bad.from, bad.to, good));
    const auto problems = problems_of(file);
    for (const Mistake& problem : problems) UNSCOPED_INFO(to_string(problem.where) + ": " + problem.message);
    CHECK(problems.size() == 1);
    if (problems.empty()) continue;
    CHECK(to_string(problems[0].where) == file.string() + ":" + bad.where);
    CHECK_THAT(problems[0].message, Catch::Contains(bad.message));
  }
}

}  // namespace stillpoint::test
