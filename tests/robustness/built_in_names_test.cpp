// Names that every formula has are none for constants of a scene.
#include <stillpoint/scene_error.hpp>
#include <stillpoint/simulation.hpp>

#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "temporary_folder.hpp"

using namespace stillpoint;

namespace {

std::string refusal_of_constants(const std::string& constants, const std::vector<std::string>& overrides = {}) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.toml", "dim = 1\n[constants]\n" + constants);
  try {
    load_scene(file, overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a constant called like a number, a function or a variable of formulas is refused where it stands") {
  for (const char* name : {"pi", "e", "sin", "max", "bessel_j0", "x", "y", "z", "t"}) {
    CAPTURE(name);
    const std::string said = refusal_of_constants(fmt::format("a = 1\n  {} = 3\n", name));
    CHECK(said.find("scene.toml:4:3: ") != std::string::npos);
    CHECK(said.find(fmt::format("'{}' cannot be a constant's name", name)) != std::string::npos);
  }
  CHECK(refusal_of_constants("", {"constants.pi=3"}).find("'pi' cannot be a constant's name") != std::string::npos);
  CHECK(refusal_of_constants("E = 3\nPi = 3\npi_2 = 'pi/2'\nee = 'e'\n").find("cannot be a constant's name") ==
        std::string::npos);
}
