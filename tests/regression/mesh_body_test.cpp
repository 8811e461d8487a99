// Bodies whose borders are those of meshes.
#include <stillpoint/stillpoint.hpp>

#include <string>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::TemporaryFolder;

namespace {

const std::string hexahedra =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"lower\"\n3 2 \"upper\"\n$EndPhysicalNames\n"
    "$Nodes\n12\n1 0 0 0\n2 1 0 0\n3 1 0 1\n4 0 0 1\n5 0 0.9 0\n6 1 0.9 0\n7 1 0.9 1\n8 0 0.9 1\n"
    "9 0 1.7 0\n10 1 1.7 0\n11 1 1.7 1\n12 0 1.7 1\n$EndNodes\n"
    "$Elements\n2\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 5 2 2 2 5 6 7 8 9 10 11 12\n$EndElements\n";

/// Two blocks on each other, whose borders lie in the middle of cells, under their weight between smooth sides.
const std::string meshed_column = R"(
dim = 3
[grid]
min = [0, 0, 0]
max = [1, 2, 1]
cells = [2, 4, 2]
[[body]]
mesh = "column.msh"
group = "lower"
placement = "gauss"
[[body]]
mesh = "column.msh"
group = "upper"
placement = "gauss"
[material.lower]
law = "linear-elastic"
E = 1e6
nu = 0
rho = 1000
[material.upper]
law = "linear-elastic"
E = 1e6
nu = 0
rho = 1000
[body_force]
value = [0, -10, 0]
[[support]]
face = "bottom"
name = "base"
[[support]]
face = "left"
kind = "roller"
[[support]]
face = "right"
kind = "roller"
[[support]]
face = "back"
kind = "roller"
[[support]]
face = "front"
kind = "roller"
[solve]
method = "newton"
)";

}  // namespace

TEST_CASE("a plate with a hole, of two groups of a mesh, meets Kirsch's solution") {
  const Summary s = run(scenes::load("plate_with_hole"));
  CHECK(s.exit_status == 0);
  CHECK(s.error.value().u_rel_l2 < 1e-3);
  CHECK(s.error.value().stress_rel_l2 < 0.02);
  CHECK(scenes::probe(s, "top", "stress.xx") == Approx(3e-3).epsilon(0.02));
}

TEST_CASE("two volumes of a mesh are a column as high as both, and bear their weight") {
  const TemporaryFolder folder;
  folder.write("column.msh", hexahedra);
  const Summary s = run(load_scene(folder.write("column.toml", meshed_column)));
  CHECK(s.exit_status == 0);
  CHECK(s.reactions.at("base").at(1) == Approx(1000 * 10 * 1.7).epsilon(1e-9));
}

TEST_CASE("a mesh that reaches out of the grid, or has no such group, is refused at its key") {
  const TemporaryFolder folder;
  folder.write("column.msh", hexahedra);
  const auto refuses = [&](const std::string& what, const std::string& by, const std::string& message) {
    std::string text = meshed_column;
    text.replace(text.find(what), what.size(), by);
    CHECK_THROWS_WITH(load_scene(folder.write("column.toml", text)), Catch::Contains(message));
  };
  refuses("max = [1, 2, 1]", "max = [1, 1.5, 1]", "column.toml:12:8: body[1].mesh: reaches from 0.9 to 1.7 along y");
  refuses("\"upper\"", "\"uper\"", "has no physical group 'uper' of volumes; it has 'lower', 'upper'");
  refuses("mesh = \"column.msh\"\n", "", "goes with mesh");
  refuses("mesh = \"column.msh\"\n", "mesh = \"column.msh\"\nstl = \"a.stl\"\n", "does not go with stl");
  refuses("[material.upper]", "[material.other]", "upper");
}
