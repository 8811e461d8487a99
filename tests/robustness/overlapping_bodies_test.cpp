// Two bodies in the same place are bad input.
#include "robustness/broken_scene.hpp"

using namespace stillpoint;
using stillpoint::test::problems_of;
using stillpoint::test::TemporaryFolder;

namespace {

// A grid of 8 × 8 cells on 4 m × 4 m, and these bodies of one soil.
std::string scene_of_bodies(const std::vector<std::string>& bodies) {
  std::string text =
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [4, 4]\ncells = [8, 8]\n[material.m]\nlaw = \"linear-elastic\"\nE = 1.0\n"
      "nu = 0.3\nrho = 1.0\n[[support]]\nface = \"bottom\"\n[body_force]\nvalue = [0, -1e-3]\n[stop]\nresidual = "
      "1e-4\n";
  for (const std::string& body : bodies) text += "[[body]]\nmaterial = \"m\"\n" + body + "\n";
  return text;
}

std::vector<std::string> overlaps(const TemporaryFolder& folder, const std::vector<std::string>& bodies) {
  std::vector<std::string> messages;
  for (const Mistake& problem : problems_of(folder.write("scene.toml", scene_of_bodies(bodies))))
    messages.push_back(problem.message);
  return messages;
}

const std::string plate = "min = [0, 0]\nmax = [2, 2]";

}  // namespace

TEST_CASE("a body that lies in another is refused before the run, with the area") {
  const TemporaryFolder folder;
  const std::vector<std::string> inside = {"min = [1, 1]\nmax = [3, 2]", "polygon = [[1, 0], [2, 0], [2, 2], [1, 2]]",
                                           "polygon = [[0, 0], [2, 0], [0, 2]]", plate};
  const std::vector<std::string> areas = {"1 m2", "2 m2", "2 m2", "4 m2"};
  for (std::size_t k = 0; k < inside.size(); ++k) {
    const auto found = overlaps(folder, {plate, inside[k]});
    CAPTURE(inside[k]);
    REQUIRE(found.size() == 1);
    CHECK_THAT(found[0], Catch::Contains("body[1]: an area of " + areas[k] + " lies in body[0]") &&
                             Catch::Contains("two bodies cannot be in the same place"));
  }
}

TEST_CASE("polygons that are not convex overlap only where they do") {
  const TemporaryFolder folder;
  const std::string horseshoe = "polygon = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 2], [3, 2], [3, 3], [0, 3]]";
  CHECK(overlaps(folder, {horseshoe, "min = [1, 1]\nmax = [3, 2]"}).empty());  // in its gap
  CHECK(overlaps(folder, {"min = [1, 1]\nmax = [4, 2]", horseshoe}).empty());
  const auto found = overlaps(folder, {horseshoe, "min = [1, 0.5]\nmax = [3, 2]"});
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], Catch::Contains("an area of 1 m2"));
}

TEST_CASE("bodies that share a border, or miss it by rounding, do not overlap") {
  const TemporaryFolder folder;
  CHECK(overlaps(folder, {plate, "min = [2, 0]\nmax = [4, 2]", "min = [0, 2]\nmax = [4, 3]"}).empty());
  CHECK(overlaps(folder, {"max = [0.7, 4]", "min = [0.6999999999, 0]"}).empty());
  CHECK(overlaps(folder, {"polygon = [[0, 0], [3, 0], [0, 1]]", "polygon = [[3, 0], [3, 1.0000000001], [-0.0, 1]]"})
            .empty());
  CHECK(overlaps(folder, {"polygon = [[0, 0], [3, 0], [0, 1]]", "polygon = [[3, 0], [3, 1.1], [0, 0.9]]"}).size() == 1);
}

TEST_CASE("points of a file in another body, or where another file has one, are named") {
  const TemporaryFolder folder;
  folder.write("a.csv", "x,y,volume\n2.5,0.5,0.1\n1.5,0.5,0.1\n");
  folder.write("b.csv", "x,y,volume\n2.5,0.25,0.1\n2.5,0.5,0.1\n");
  folder.write("c.csv", "x,y,volume\n2.0,0.5,0.1\n");
  const auto in_plate = overlaps(folder, {plate, "file = \"a.csv\""});
  REQUIRE(in_plate.size() == 1);
  CHECK_THAT(in_plate[0], Catch::Contains("body[1]: the point at 1.5, 0.5 lies in body[0]"));
  CHECK(overlaps(folder, {"file = \"a.csv\"", "polygon = [[0, 0], [2, 0], [2, 2], [0, 2]]"}).size() == 1);
  CHECK(overlaps(folder, {"file = \"a.csv\"", "file = \"b.csv\""}).size() == 1);
  CHECK(overlaps(folder, {plate, "file = \"b.csv\""}).empty());
  CHECK(overlaps(folder, {plate, "file = \"c.csv\""}).empty());  // on the border
}

TEST_CASE("bars in one dimension do not overlap either") {
  const TemporaryFolder folder;
  const auto bars = [&](const std::string& second) {
    return problems_of(folder.write(
        "bars.toml",
        "[grid]\nmin = 0\nmax = 4\ncells = 4\n[material.m]\nlaw = \"linear-elastic\"\nE = 1.0\nrho = 1.0\n[[support]]\n"
        "at = 0\n[body_force]\nvalue = 1e-3\n[stop]\nresidual = 1e-4\n[[body]]\nmaterial = \"m\"\nmax = 2\n[[body]]\n"
        "material = \"m\"\nmin = " +
            second));
  };
  CHECK(bars("2").empty());
  CHECK(bars("1.5").size() == 1);
}
