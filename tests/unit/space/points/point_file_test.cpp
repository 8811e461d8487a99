// Points that a file gives.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "space/points/placed_bodies.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

std::vector<std::string> problems_of(const std::filesystem::path& file) {
  std::vector<std::string> found;
  try {
    place(from_file(file));
  } catch (const SceneError& error) {
    for (const Mistake& problem : error.problems())
      found.push_back(fmt::format("{}:{} {}", problem.where.line, problem.where.column, problem.message));
  }
  return found;
}

}  // namespace

TEST_CASE("points written to a file and read back are the same to the bit, whatever the order of lines and columns") {
  BodySpec body = box({0, 0}, {4, 2});
  body.placement = Placement::random;
  body.volumes = VolumeRule::equal;
  const auto written = place(body, StressState::plane_strain, 3);
  const TemporaryFolder folder;
  std::string text = "# random points\nvolume, y, x\n\n";
  for (std::size_t p = written.size(); p-- > 0;)
    text +=
        fmt::format("{:.17g},{:.17g},\t{:.17g} # point {}\r\n", written.volume[p], written.x[1][p], written.x[0][p], p);
  const auto placed = place_body<2>(from_file(folder.write("points.csv", text)), kGrid, 3, StressState::axisymmetric);
  const auto& read = placed.points;
  check_cells(read);
  CHECK(read.cell == written.cell);
  CHECK(read.cell_begin == written.cell_begin);
  // In a cell they are in the file's order, here the other way round.
  for (std::size_t k = 0; k < read.cell.size(); ++k) {
    for (int p = read.cell_begin[k]; p < read.cell_begin[k + 1]; ++p) {
      const auto here = static_cast<std::size_t>(p);
      const auto there = static_cast<std::size_t>(read.cell_begin[k] + read.cell_begin[k + 1] - 1 - p);
      CHECK(read.position(here) == written.position(there));
      CHECK(read.volume[here] == written.volume[there]);
      CHECK(read.mass[here] == written.mass[there]);
    }
  }
}

TEST_CASE("points on a line come from a file in order of place") {
  const TemporaryFolder folder;
  const Grid<1> line{Axis::uniform(0, 4, 2)};
  const auto file = folder.write("points.csv", "x,volume\n3,1\n1.5,2\n0.5,3\n2,4\n");
  const auto points = place_body<1>(from_file(file), line, 1, StressState::uniaxial_stress).points;
  CHECK(points.x[0] == std::vector{0.5, 1.5, 2.0, 3.0});
  CHECK(points.volume == std::vector{3.0, 2.0, 4.0, 1.0});
  CHECK(points.cell_begin == std::vector{0, 2, 4});
}

TEST_CASE("what is wrong with a file of points is said with its line and column, all at once") {
  using Found = std::vector<std::string>;
  const TemporaryFolder folder;
  const auto found_in = [&](const std::string& text) { return problems_of(folder.write("points.csv", text)); };
  CHECK(found_in("x,y,volume\n1,1,1\n").empty());
  CHECK(found_in("\xEF\xBB\xBFx,y,volume\n1,1,+1e0\n").empty());  // a byte order mark
  CHECK(problems_of(folder.path() / "none.csv") == Found{"0:0 there is no such file"});
  CHECK(problems_of(folder.path()) == Found{"0:0 is not a file of points"});
  CHECK(problems_of("/dev/zero") == Found{"0:0 is not a file of points"});
  CHECK(found_in("") == Found{"0:0 is empty: expected a line with the columns x, y, volume"});
  CHECK(found_in("x,y,volume\n# none\n") == Found{"0:0 holds no points"});
  CHECK(found_in("x,y\n1,1\n") == Found{"1:1 the column 'volume' is missing; expected x, y, volume"});
  CHECK(found_in("x,volume,z\n1,1,1\n") == Found{"1:10 unknown column 'z'; expected one of x, y, volume"});
  CHECK(found_in("x,y,volme\n1,1,1\n") == Found{"1:5 unknown column 'volme'; did you mean 'volume'?"});
  CHECK(found_in("x,y,volume,x\n1,1,1,1\n") == Found{"1:12 the column 'x' is there already"});
  CHECK(found_in("x,y,volume\n1,1\n1,1,1,1\n1,,1\n1,1e999,1\n nan,1,0\n5,1,-1\n") ==
        Found{"2:1 expected 3 values, found 2", "3:1 expected 3 values, found 4",
              "4:3 y: expected a finite number, found ''", "5:3 y: expected a finite number, found '1e999'",
              "6:2 x: expected a finite number, found 'nan'", "6:8 volume: must be greater than 0, not 0",
              "7:1 x = 5 lies outside the grid, 0 to 4", "7:5 volume: must be greater than 0, not -1"});

  std::string wrong = "x,y,volume\n";
  for (int k = 0; k < 100; ++k) wrong += "a;b;c\n";
  const Found many = found_in(wrong);
  REQUIRE(many.size() == 21);
  CHECK(many.back() == "22:1 from here on, more is wrong than is listed");
}
