// STL files: both forms, and what is refused with its place.
#include "geometry/stl_file.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "temporary_folder.hpp"
#include "triangles.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;
using stillpoint::test::TemporaryFolder;

namespace {

struct ReadSurface {
  std::vector<Facet> facets;
  std::vector<Mistake> problems;
};
ReadSurface read_surface(const std::string& bytes) {
  const TemporaryFolder folder;
  ReadSurface result;
  result.facets = read_stl_file(folder.write("body.stl", bytes), result.problems);
  return result;
}
/// "line:column message" of the only problem.
std::string problem_of(const std::string& bytes) {
  const ReadSurface result = read_surface(bytes);
  CHECK(result.facets.empty());
  REQUIRE(result.problems.size() == 1);
  const auto& [where, message, key] = result.problems[0];
  return fmt::format("{}:{} {}", where.line, where.column, message);
}
std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

const std::string ascii = ascii_stl(octahedron()), binary = binary_stl(octahedron());

}  // namespace

TEST_CASE("both forms of an STL file have the same triangles, a binary one that is titled 'solid' too") {
  for (const std::string& bytes : {ascii, binary, with(binary, "     ", "solid")}) {
    const ReadSurface result = read_surface(bytes);
    CHECK(result.problems.empty());
    CHECK(result.facets == octahedron());
  }
}

TEST_CASE("a surface that is wound inside out is taken too") {
  std::vector<Facet> inside_out = octahedron();
  for (Facet& facet : inside_out) std::swap(facet[0], facet[1]);
  const ReadSurface result = read_surface(binary_stl(inside_out));
  CHECK(result.problems.empty());
  CHECK(TriangleSolid(result.facets).contains({0.1, 0.2, 0.3}));
}

TEST_CASE("an STL file that is not closed is refused, with the edge") {
  std::vector<Facet> open = octahedron();
  open.erase(open.begin());
  CHECK_THAT(problem_of(binary_stl(open)), Contains("0:0 is not closed: the edge from (0, 0, 1) to (0, 1, 0)"));
  std::vector<Facet> turned = octahedron();
  std::swap(turned[0][0], turned[0][1]);
  CHECK_THAT(problem_of(ascii_stl(turned)), Contains("is not closed") && Contains("wound the other way"));
}

TEST_CASE("an STL file that is cut short is refused") {
  CHECK_THAT(problem_of(binary.substr(0, binary.size() - 3)),
             Contains("is not whole") && Contains("8 triangles") && Contains("484 bytes, not 481"));
  CHECK_THAT(problem_of(ascii.substr(0, ascii.size() - 40)), Contains("the file ends here; expected a finite number"));
  CHECK_THAT(problem_of("solid"), Contains("expected 'facet' or 'endsolid'"));
  CHECK_THAT(problem_of(""), Contains("is empty"));
  CHECK_THAT(problem_of("solid body\nendsolid body\n"), Contains("holds no triangles"));
  CHECK_THAT(problem_of(binary_stl({})), Contains("holds no triangles"));
  CHECK_THAT(problem_of("x, y\n1, 2\n"), Contains("is no STL file"));
}

TEST_CASE("numbers of an STL file that are none, or not finite, are refused at their line and column") {
  CHECK_THAT(problem_of(with(ascii, "vertex 1 0 0", "vertex 1 O 0")),
             Contains("4:16 expected a finite number, found 'O'"));
  CHECK_THAT(problem_of(with(ascii, "vertex 1 0 0", "vertex 1 inf 0")),
             Contains("expected a finite number, found 'inf'"));
  CHECK_THAT(problem_of(with(ascii, "vertex 1 0 0", "vertex 1 0")),
             Contains("5:7 expected a finite number, found 'vertex'"));
  CHECK_THAT(problem_of(with(ascii, "outer loop", "inner loop")), Contains("3:5 expected 'outer', found 'inner'"));
  std::vector<Facet> facets = octahedron();
  facets[2][1][0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(problem_of(binary_stl(facets)), Contains("a coordinate of triangle 3 of 8 is not a finite number"));
}

TEST_CASE("triangles that enclose nothing are refused") {
  const Facet facet{SpacePoint{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, back{facet[0], facet[2], facet[1]};
  CHECK_THAT(problem_of(ascii_stl({facet, back})), Contains("encloses no volume"));
}

TEST_CASE("a file that is not there is told of") {
  std::vector<Mistake> problems;
  CHECK(read_stl_file("/nowhere/body.stl", problems).empty());
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].message == "there is no such file");
}
