#include "geometry/gmsh_file.hpp"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::TemporaryFolder;

namespace {

// Two triangles on a square, in two groups, as Gmsh writes them in its two formats; the line is passed over.
const std::string of_blocks =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\n$Nodes is no section here\n$EndComments\n"
    "$PhysicalNames\n3\n1 9 \"below\"\n2 7 \"left part\"\n2 8 \"right\"\n$EndPhysicalNames\n"
    "$Entities\n1 1 2 0\n1 0 0 0 0 \n1 0 0 0 1 0 0 1 9 2 1 -1 \n1 0 0 0 1 1 0 1 7 0 \n2 0 0 0 1 1 0 2 8 7 0 \n"
    "$EndEntities\n"
    "$Nodes\n2 4 1 40\n1 1 1 1\n1\n0 0 0 0.5\n2 1 0 3\n20\n30\n40\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n"
    "$Elements\n3 3 1 3\n1 1 1 1\n1 1 20\n2 1 2 1\n2 1 30 40\n2 2 2 1\n3 1 20 30\n$EndElements\n";
const std::string of_lines =
    "$MeshFormat\r\n2.2 0 8\r\n$EndMeshFormat\r\n$PhysicalNames\r\n2\r\n2 7 \"left part\"\r\n2 8 \"right\"\r\n"
    "$EndPhysicalNames\r\n$Nodes\r\n4\r\n1 0 0 0\r\n20 1 0 0\r\n30 1 1 0\r\n40 0 1 0\r\n$EndNodes\r\n"
    "$Elements\r\n3\r\n1 1 2 9 1 1 20\r\n2 2 2 7 1 1 30 40\r\n3 2 2 8 2 1 20 30\r\n$EndElements\r\n";

struct ReadMesh {
  Mesh mesh;
  std::vector<Mistake> problems;
};
ReadMesh read_mesh(const std::string& text, const std::string& group = "", int dim = 2) {
  const TemporaryFolder folder;
  ReadMesh result;
  result.mesh = read_gmsh_file(folder.write("a.msh", text), dim, group, result.problems);
  return result;
}

}  // namespace

TEST_CASE("both text formats of Gmsh's give the nodes, and the elements of a physical group") {
  for (const std::string& text : {of_blocks, of_lines}) {
    const Mesh all = read_mesh(text).mesh, right = read_mesh(text, "right").mesh;
    REQUIRE(all.elements.size() == 2);
    CHECK(all.nodes.at(30) == SpacePoint{1, 1, 0});
    CHECK(all.elements[0].kind == 2);
    CHECK(all.elements[0].nodes == std::vector<std::size_t>{1, 30, 40});
    REQUIRE(right.elements.size() == 1);
    CHECK(right.elements[0].nodes == std::vector<std::size_t>{1, 20, 30});
  }
  CHECK(read_mesh(of_lines, "left part").mesh.elements.size() == 1);
  CHECK(read_mesh(of_blocks, "left part").mesh.elements.size() == 2);  // of which one surface is in both groups
}

TEST_CASE("what is wrong with a mesh is told once, with line and column if it is in the text") {
  const auto replaced = [](std::string text, const std::string& what, const std::string& by) {
    return text.replace(text.find(what), what.size(), by);
  };
  struct Row {
    std::string text, group, message;
    int line, column;
  };
  const std::vector<Row> rows = {
      {"", "", "begins with $MeshFormat", 1, 1},
      {"solid body\n", "", "begins with $MeshFormat", 1, 1},
      {replaced(of_blocks, "4.1", "4"), "", "format 4; expected 4.1 or 2.2", 2, 1},
      {replaced(of_blocks, "4.1 0", "4.1 1"), "", "is a binary mesh", 2, 5},
      {of_blocks, "rigt", "has no physical group 'rigt' of surfaces; it has 'left part', 'right'", 0, 0},
      {replaced(of_blocks, "1 1 0\n", "1 x 0\n"), "", "expected a coordinate, found 'x'", 30, 3},
      {replaced(of_blocks, "1 1 0\n", "1 nan 0\n"), "", "expected a coordinate, found 'nan'", 30, 3},
      {replaced(of_blocks, "1 20 30", "1 20 31"), "", "there is no node 31", 40, 8},
      {replaced(of_lines, "3 2 2 8 2 1 20", "3 22 2 8 2 1 20"), "", "elements of Gmsh's kind 22", 20, 3},
      {of_blocks.substr(0, of_blocks.find("$EndElements")), "", "expected $EndElements", 41, 1},
      {replaced(of_blocks, "2 1 0 3\n", "2 1 0 4000000000000\n"), "", "expected the tag of a node", 32, 1},
      {replaced(of_blocks, "2 1 2 1\n2 1 30 40", "1 1 99 4000000000000\n2 1 30 40"), "", "the file ends too early", 42,
       1},
      {replaced(of_lines, "\"right\"", "right"), "", "expected a name in quotes", 7, 0},
  };
  for (const Row& row : rows) {
    CAPTURE(row.message);
    const ReadMesh result = read_mesh(row.text, row.group);
    CHECK(result.mesh.elements.empty());
    REQUIRE(result.problems.size() == 1);
    CHECK_THAT(result.problems[0].message, Catch::Contains(row.message));
    CHECK(result.problems[0].where.line == row.line);
    if (row.column > 0) CHECK(result.problems[0].where.column == row.column);
  }
  CHECK_THAT(read_mesh(of_blocks, "", 3).problems.at(0).message, Catch::Contains("holds no elements of volumes"));
  std::vector<Mistake> problems;
  CHECK(read_gmsh_file("/nowhere/a.msh", 2, "", problems).elements.empty());
  CHECK_THAT(problems.at(0).message, Catch::Contains("there is no such file"));
}
