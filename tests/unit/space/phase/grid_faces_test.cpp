// Points past a face of the grid, by rounding, behind a wall or for good.
#include "space/phase/grid_faces.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "free_block.hpp"
#include "scenes.hpp"

using namespace stillpoint;
using stillpoint::test::free_block;
using stillpoint::test::TemporaryFolder;

namespace {

/// A block of points, two of a side's columns exactly on the left and the right face of the grid [0, 2] × [0, 1.5].
Scene between_faces(const TemporaryFolder& folder, std::vector<std::string> overrides) {
  constexpr double h = 0.25;
  std::string points = "x,y,volume\n";
  for (int i = 0; i <= 16; ++i) {
    for (int j = 0; j < 8; ++j)
      points += fmt::format("{},{},{}\n", i * h / 2, (j + 0.5) * h / 2, h * h / (i % 16 == 0 ? 8 : 4));
  }
  const std::string file = folder.write("points.csv", points).string();
  overrides.insert(overrides.begin(),
                   {"grid={min=[0, 0], max=[2, 1.5], cells=[8, 6], basis='quadratic', follow='wall'}",
                    "body=[{file='" + file + "', material='stuff'}]", "material.stuff.law=hencky",
                    "support=[{face='left', kind='roller'}, {face='bottom', kind='roller'}]",
                    "damping.strategy=viscous", "damping.c=5"});
  return free_block(overrides);
}

}  // namespace

TEST_CASE("a point past a face by rounding goes back onto it, past a wall by a step as well, and no other is moved") {
  Scene scene;
  scene.walls.push_back({.name = "wall", .face = Face::right, .motion = Expression(0.0)});
  const Grid<1> grid{{Axis::uniform(-2, 10, 6)}};
  const GridFaces<1> faces(scene, grid);
  CHECK(faces.keeps(0, -2 - 4e-15));
  CHECK(faces.keeps(0, 10 + 0.19));
  CHECK_FALSE(faces.keeps(0, -2 - 1e-9));
  CHECK_FALSE(faces.keeps(0, 10 + 0.21));
  CHECK_FALSE(faces.keeps(0, std::nan("")));
  MaterialPoints<1> points;
  points.x[0] = {-2 - 4e-15, -2, 3, 10, 10.1};
  points.volume.assign(5, 1);
  faces.put_back(points);
  CHECK(points.x[0] == std::vector<double>{-2, -2, 3, 10, 10});
}

TEST_CASE("points on a roller and on a wall that sets out at once stay in the grid, whatever the basis") {
  const TemporaryFolder folder;
  for (const std::string basis : {"linear", "quadratic"}) {
    for (const std::string motion : {"-0.3*(1 - exp(-t))", "-0.3*sin(t)^2", "-0.1*min(t, 3)"}) {
      const Summary s = run(between_faces(folder, {"grid.basis=" + basis, "stop.time=20", "output.every=1",
                                                   "wall=[{name='wall', face='right', motion='" + motion + "'}]"}),
                            {.threads = 1});
      CAPTURE(basis, motion, s.reason);
      CHECK(s.status == RunStatus::end_time);
      CHECK(s.phases > 5);
      CHECK(std::isfinite(s.kinetic_energy));
    }
  }
}
