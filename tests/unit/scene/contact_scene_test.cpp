// Contact between bodies in a scene: what its keys say, and what is said of wrong ones.
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "robustness/broken_scene.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

namespace stillpoint::test {
namespace {

/// A block on a base, with these lines beside them.
std::string text_of(const std::string& lines, double overlap = 0) {
  return fmt::format(R"(dim = 2
grid = {{min = [0, 0], max = [2, 2], cells = [4, 4]}}
[[body]]
name = "base"
max = [2, 1]
material = "rubber"
[[body]]
name = "block"
min = [0, {}]
max = [1, 2]
material = "rubber"
[material.rubber]
law = "linear-elastic"
E = 1.0
nu = 0.3
rho = 1.0
[[support]]
face = "bottom"
[stop]
residual = 0
time = 1
{}
)",
                     1 - overlap, lines);
}

Scene scene_of(const std::string& lines) {
  const TemporaryFolder folder;
  return load_scene(folder.write("scene.toml", text_of(lines)));
}

}  // namespace

TEST_CASE("a contact names two bodies, has no friction unless it says so, and a shorter step") {
  const Scene scene = scene_of("[[contact]]\nbodies = [\"block\", \"base\"]");
  REQUIRE(scene.contacts.size() == 1);
  CHECK(scene.contacts[0].name() == "block+base");
  CHECK(scene.contacts[0].shear.friction == 0);
  CHECK_FALSE(scene.rubs());
  CHECK(static_cast<double>(scene.integrator.step_fraction) == 0.8);
  CHECK(scene_of("[[contact]]\nbodies = [\"block\", \"base\"]\nfriction = 0.2").contacts[0].shear.friction == 0.2);
  CHECK(scene_of("[[contact]]\nbodies = [\"block\", \"base\"]\nadhesion = 5").rubs());
  CHECK(std::isinf(
      scene_of("[[contact]]\nbodies = [\"block\", \"base\"]\nfriction = \"rough\"").contacts[0].shear.friction));
}

TEST_CASE("a wrong contact has one message, which says what was expected") {
  CHECK_THAT(complaints(text_of("[[contact]]\nbodies = [\"block\"]")), Contains("must be two bodies, not 1"));
  CHECK_THAT(complaints(text_of("[[contact]]\nbodies = [\"block\", \"block\"]")), Contains("'block' is there already"));
  CHECK_THAT(complaints(text_of("[[contact]]\nbodies = [\"block\", \"bas\"]")),
             Contains("there is no body 'bas'") && Contains("base"));
  CHECK_THAT(complaints(text_of("[[contact]]\nfriction = 0.1")), Contains("'bodies' is missing"));
  CHECK_THAT(complaints(text_of("[[contact]]\nbodies = [\"block\", \"base\"]\n[[contact]]\nbodies = [\"base\", "
                                "\"block\"]")),
             Contains("have a contact already"));
  CHECK_THAT(complaints(text_of("[mass]\nkind = \"multigrid\"\n[[contact]]\nbodies = [\"block\", \"base\"]")),
             Contains("does not know the stiffness of contact yet"));
  CHECK_THAT(complaints(text_of("[[contact]]\nbodies = [\"block\", \"base\"]\nfriction = \"rough\"\nadhesion = 5")),
             Contains("contact[0].adhesion: adds nothing to friction"));
}

TEST_CASE("a force where two bodies with a contact meet is refused by their names, and elsewhere has a body") {
  const auto with_force = [](const std::string& at, const std::string& more) {
    return complaints(text_of("[[force]]\nat = " + at + "\nvalue = [0, -1]\n" + more));
  };
  const std::string contact = "[[contact]]\nbodies = [\"block\", \"base\"]";
  for (const char* at : {"[0.5, 1]", "[1, 1]", "[0, 1]", "[0.5, 1.0000000000001]"}) {
    CAPTURE(at);
    CHECK_THAT(with_force(at, contact), Contains("force[0].at") && Contains("'base' and 'block' meet"));
    CHECK(with_force(at, "").empty());
  }
  for (const char* at : {"[1.5, 1]", "[0.5, 0.99]", "[0.5, 1.01]"}) CHECK(with_force(at, contact).empty());
}

TEST_CASE("bodies that touch may overlap a little when the run begins, others may not") {
  const std::string contact = "[[contact]]\nbodies = [\"block\", \"base\"]";
  CHECK_THAT(complaints(text_of("", 0.1)), Contains("two bodies cannot be in the same place"));
  CHECK(complaints(text_of(contact, 0.1)).empty());
  CHECK_THAT(complaints(text_of(contact, 0.8)), Contains("two bodies cannot be in the same place"));
}

TEST_CASE("in space tubes of a shrink fit may overlap a little whether they are whole or a quarter of one") {
  const auto tubes = [](double from, double interference) {
    return complaints(
        fmt::format("dim = 3\ngrid = {{min = [{0}, {0}, 0], max = [1.2, 1.2, 0.2], cells = [12, 12, 1]}}\n"
                    "[material.m]\nlaw = 'linear-elastic'\nE = 1\nnu = 0.3\nrho = 1\n[damping]\nc = 1\n"
                    "[[contact]]\nbodies = ['in', 'out']\n"
                    "[[body]]\nname = 'in'\nmin = [{0}, {0}, 0]\nmax = [1.2, 1.2, 0.2]\nmaterial = 'm'\n"
                    "cylinder = [[0, 0, 0], [0, 0, 0.2]]\nradius = {1}\ninner_radius = 0.35\n"
                    "[[body]]\nname = 'out'\nmin = [{0}, {0}, 0]\nmax = [1.2, 1.2, 0.2]\nmaterial = 'm'\n"
                    "cylinder = [[0, 0, 0], [0, 0, 0.2]]\nradius = 1.1\ninner_radius = 0.7\n",
                    from, 0.7 + interference));
  };
  for (const double from : {0.0, -1.2}) {
    CAPTURE(from);
    CHECK(tubes(from, 0.002).empty());
    CHECK(tubes(from, 0.02).empty());
    CHECK_THAT(tubes(from, 0.3), Contains("two bodies cannot be in the same place"));
  }
}

}  // namespace stillpoint::test
