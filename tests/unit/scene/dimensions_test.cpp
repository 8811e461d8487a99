// What a number of dimensions means.
#include "scene/dimensions.hpp"

#include <catch2/catch.hpp>

using namespace stillpoint;

TEST_CASE("a body turns about no axis on a line, about z in the plane and about each of three in space") {
  CHECK(turn_names(1).empty());
  CHECK(turn_names(2) == std::vector<std::string>{"z"});
  CHECK(turn_names(3) == std::vector<std::string>{"x", "y", "z"});
  for (int dim = 1; dim <= 3; ++dim) {
    for (const Turn& turn : dimension_info(dim).turns) {
      CHECK(turn.from < static_cast<std::size_t>(dim));
      CHECK(turn.to < static_cast<std::size_t>(dim));
      CHECK((turn.about + 1) % 3 == turn.from);  // e_about × e_from = e_to
      CHECK((turn.about + 2) % 3 == turn.to);
    }
  }
}

TEST_CASE("the only component of a figure has its name alone, and others the names of theirs") {
  CHECK(component_names("u", axis_names(1)) == std::vector<std::string>{"u"});
  CHECK(component_names("u", axis_names(2)) == std::vector<std::string>{"u.x", "u.y"});
  CHECK(component_names("u", axis_names(3), "_") == std::vector<std::string>{"u_x", "u_y", "u_z"});
  CHECK(component_names("turn", turn_names(1)).empty());
}

TEST_CASE("components of tensors are named in the order in which laws have them") {
  CHECK(stress_names(1) == std::vector<std::string>{"xx"});
  CHECK(stress_names(4) == std::vector<std::string>{"xx", "yy", "zz", "xy"});
  CHECK(stress_names(6).back() == "zx");
  CHECK(gradient_names(2, 4) == std::vector<std::string>{"xx", "xy", "yx", "yy"});
  CHECK(gradient_names(2, 5).back() == "zz");  // around an axis
  CHECK(gradient_names(3, 9).size() == 9);
}
