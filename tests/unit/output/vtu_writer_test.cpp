// The files of VTK's as files; tests/scripts/vtu_test.py reads them by VTK and by meshio.
#include "output/vtu_writer.hpp"

#include <stillpoint/state_archive.hpp>

#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "temporary_folder.hpp"
#include "unit/output/frames.hpp"

using namespace stillpoint;
using stillpoint::test::a_frame, stillpoint::test::bytes_of, stillpoint::test::FullDisk, stillpoint::test::names_in,
    stillpoint::test::TemporaryFolder;
namespace fs = std::filesystem;
using Names = std::set<std::string>;

namespace {

FieldFrame a_frame_on_a_grid(double t, double end, std::size_t points = 3) {
  FieldFrame frame = a_frame(t, points);
  frame.grid_lines = {{0, 1, end}, {0, 1}};
  return frame;
}

}  // namespace

TEST_CASE("VTU files are whole after each frame, and a grid that stays is written once") {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "new" / "folder";
  VtuWriter writer(folder);
  writer.add(a_frame_on_a_grid(0, 2));
  CHECK(names_in(folder) == Names{"fields.pvd", "fields_vtu", "grid.pvd"});
  writer.add(a_frame_on_a_grid(1, 2));
  writer.add(a_frame_on_a_grid(2, 3));
  CHECK(names_in(folder / "fields_vtu") ==
        Names{"grid_0000.vtu", "grid_0002.vtu", "points_0000.vtu", "points_0001.vtu", "points_0002.vtu"});
}

TEST_CASE("VTU files that are gone on with are those of a run that was never broken off") {
  const TemporaryFolder folder, other;
  VtuWriter expected(other.path());
  {
    VtuWriter writer(folder.path());
    for (const double t : {0., 1., 2.}) writer.add(a_frame_on_a_grid(t, 2, t == 1 ? 7 : 3));
  }
  for (const double t : {0., 1., 5.}) expected.add(a_frame_on_a_grid(t, 2, t == 1 ? 7 : 3));
  VtuWriter writer(folder.path(), 2);
  writer.add(a_frame_on_a_grid(5, 2));
  for (const char* name : {"fields.pvd", "grid.pvd", "fields_vtu/points_0002.vtu", "fields_vtu/grid_0000.vtu"}) {
    CAPTURE(name);
    CHECK((bytes_of(folder.path() / name) == bytes_of(other.path() / name)));
  }
  CHECK(names_in(folder.path() / "fields_vtu") == names_in(other.path() / "fields_vtu"));
  CHECK_THROWS_WITH(VtuWriter(folder.path(), 4), Catch::Contains("frame 3 is not there"));
  const VtuWriter another_run(folder.path());
  CHECK(names_in(folder.path()) == Names{"fields_vtu"});
  CHECK(names_in(folder.path() / "fields_vtu").empty());
}

TEST_CASE("on a full disk a VTU frame is refused as a whole, and the frames before it are kept") {
  const TemporaryFolder folder, other;
  VtuWriter writer(folder.path()), expected(other.path());
  for (VtuWriter* each : {&writer, &expected}) each->add(a_frame_on_a_grid(0, 2));
  {
    const FullDisk full(2048);
    CHECK_THROWS_WITH(writer.add(a_frame_on_a_grid(1, 2, 100000)),
                      Catch::Contains("cannot write") && Catch::Contains("points_0001"));
  }
  CHECK(names_in(folder.path() / "fields_vtu") == Names{"grid_0000.vtu", "points_0000.vtu"});
  for (VtuWriter* each : {&writer, &expected}) each->add(a_frame_on_a_grid(1, 2, 100));  // there is room again
  for (const char* name : {"fields.pvd", "grid.pvd", "fields_vtu/points_0001.vtu"})
    CHECK((bytes_of(folder.path() / name) == bytes_of(other.path() / name)));
}

TEST_CASE("a VTU frame whose parts do not fit is refused, and nothing of it is written") {
  const TemporaryFolder folder;
  VtuWriter writer(folder.path());
  FieldFrame frame = a_frame_on_a_grid(0, 2);
  frame.grid_lines.pop_back();
  CHECK_THROWS_WITH(writer.add(frame), Catch::Contains("the grid has 1 values, expected 2"));
  frame = a_frame_on_a_grid(0, 2);
  frame.fields[0].values.pop_back();
  CHECK_THROWS_WITH(writer.add(frame), Catch::Contains("u has 5 values, expected 6"));
  CHECK(names_in(folder.path() / "fields_vtu").empty());
}
