// Contact between bodies: its force and its tangent, in the plane, axisymmetric and in space.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/SparseCore>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"
#include "space/boundary/contact_tangent.hpp"
#include "space/boundary/take_multipliers.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "statics.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;

namespace stillpoint::test {
namespace {

struct Stack {
  std::string kind = "plane-strain";  // state
  double gap = 0;                     // between the two [m]
  std::string friction = "0";
  std::string bodies = "['block', 'base']";
  std::string more = {};  // further bodies and keys
};

/// A block on a base that is wider, both without a support; where they meet is no line of the grid.
Scene stack(const Stack& of) {
  const bool in_space = of.kind == "space";
  const auto box = [&](const char* name, double x0, double x1, double y0, double y1, const char* material) {
    return fmt::format("[[body]]\nname = '{}'\nmin = [{}, {}{}]\nmax = [{}, {}{}]\nmaterial = '{}'\nstate = '{}'\n",
                       name, x0, y0, in_space ? ", 0.2" : "", x1, y1, in_space ? ", 1.3" : "", material, of.kind);
  };
  return load_scene("stack.toml",
                    fmt::format("dim = {}\ngrid = {{min = [0, 0{}], max = [2, 2{}], cells = [4, 4{}]}}\n"
                                "material.soft = {{law = 'linear-elastic', E = 100, nu = 0.3, rho = 1}}\n"
                                "material.stiff = {{law = 'linear-elastic', E = 400, nu = 0.2, rho = 2}}\n"
                                "contact = [{{bodies = {}, friction = {}}}]\ndamping = {{c = 1}}\n{}{}{}\n",
                                in_space ? 3 : 2, in_space ? ", 0" : "", in_space ? ", 2" : "", in_space ? ", 4" : "",
                                of.bodies, of.friction, box("base", 0.2, 1.8, 0.1, 0.85, "soft"),
                                box("block", 0.4, 1.4, 0.85 + of.gap, 1.6, "stiff"), of.more),
                    {});
}

/// The unknowns of one body, in a scene with two fields: the base is in the first.
std::vector<double> part(const std::vector<double>& of_both, std::size_t begin, std::size_t count) {
  const auto first = of_both.begin() + static_cast<std::ptrdiff_t>(begin);
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

Problem without(Scene scene, const std::string& body) {
  scene.contacts.clear();
  std::erase_if(scene.bodies, [&](const BodySpec& one) { return one.name == body; });
  return resolve(scene);
}

}  // namespace

TEST_CASE("bodies with a contact that are apart by a tenth of a cell move as if each were alone, to the bit") {
  for (const std::string& kind : contact_states) {
    CAPTURE(kind);
    const Scene scene = stack({.kind = kind, .gap = 0.05});
    const auto both = make_phase(scene), base = make_phase(without(scene, "block")),
               block = make_phase(without(scene, "base"));
    REQUIRE(both->size() == base->size() + block->size());
    const std::vector<double> u = some_motion(both->size(), 0.01), R = statics::internal_force(*both, u);
    CHECK(part(R, 0, base->size()) == statics::internal_force(*base, part(u, 0, base->size())));
    CHECK(part(R, base->size(), block->size()) ==
          statics::internal_force(*block, part(u, base->size(), block->size())));
    const ContactReport report = both->supports().contacts(0, u).at(0);
    CHECK(report.name == "block+base");
    CHECK(report.force == std::array<double, 3>{});
    CHECK(report.area == 0);
    CHECK_FALSE(both->supports().contact_state(0, u).touches);
  }
}

TEST_CASE("the tangent of contact between bodies is the derivative of its force, and symmetric without friction") {
  for (const std::string& kind : contact_states) {
    for (const char* friction : {"0", "0.3", "'rough'"}) {
      CAPTURE(kind, friction);
      const auto phase = make_phase(stack({.kind = kind, .gap = -0.02, .friction = friction}));
      const std::size_t n = phase->size();
      const std::vector<double> u = some_motion(n, 0.002), du = some_motion(n, 1);
      REQUIRE(phase->supports().contacts(0, u).at(0).area > 0.5);
      const ContactTangent tangent(*phase, 0, u, du);
      REQUIRE(tangent.scale > 0);
      CHECK(tangent.difference < 1e-13 * tangent.scale);  // rounding
      CHECK(tangent.error < 1e-7 * tangent.scale);  // of central differences; facets are plane, and their normals stay
      if (std::string(friction) == "0") CHECK(tangent.asymmetry() < 1e-14);
      CHECK(is_stiffer_held(*phase, u, du));
    }
  }
}

TEST_CASE("what one body bears the other exerts, on the same line, and it is what the contact reports") {
  for (const std::string& kind : {std::string("plane-strain"), std::string("space")}) {
    CAPTURE(kind);
    const Scene scene = stack({.kind = kind, .gap = -0.02, .friction = "0.3"});
    const auto phase = make_phase(scene), base = make_phase(without(scene, "block"));
    const std::size_t n = phase->size(), dim = kind == "space" ? 3 : 2;
    const std::vector<double> u = some_motion(n, 0.002), R = statics::internal_force(*phase, u);
    const ContactReport report = phase->supports().contacts(0, u).at(0);
    REQUIRE(report.force[1] > 0.1);
    const NodalLayout layout = phase->shape().layout();
    std::array<double, 3> on_base{}, all{}, moment{};  // −R
    for (std::size_t k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(layout.component[k]);
      if (k < base->size()) on_base[i] -= R[k];
      all[i] -= R[k];
      std::array<double, 3> arm{}, along{};
      for (std::size_t d = 0; d < dim; ++d)
        arm[d] = layout.positions[dim * static_cast<std::size_t>(layout.node[k]) + d];
      along[i] = -R[k];
      for (std::size_t d = 0; d < 3; ++d)
        moment[d] += arm[(d + 1) % 3] * along[(d + 2) % 3] - arm[(d + 2) % 3] * along[(d + 1) % 3];
    }
    for (std::size_t d = 0; d < 3; ++d) {
      CHECK(std::abs(all[d]) < 1e-12 * report.force[1]);
      CHECK(std::abs(moment[d]) < 0.05 * report.force[1]);  // of the overlap at the start, across which friction acts
      CHECK(on_base[d] == Approx(-report.force[d]).margin(1e-12 * report.force[1]));
    }
  }
}

TEST_CASE("past the edge of a body there is nothing to touch") {
  // The base is looked for along, and is wider than the block on it: 1 of 1.6 m touches.
  const auto phase = make_phase(stack({.gap = -0.02, .bodies = "['base', 'block']"}));
  const ContactReport report = phase->supports().contacts(0, std::vector<double>(phase->size(), 0.0)).at(0);
  CHECK(report.name == "base+block");
  CHECK(report.force[1] < 0);
  CHECK(report.area == Approx(1.0).margin(0.15));  // a Gauss point more or less
}

TEST_CASE("bodies without a contact stay bonded where one of them has a contact with a third") {
  // A cap on the block: the two move as one, and the base by itself.
  const std::string cap =
      "[[body]]\nname = 'cap'\nmin = [0.4, 1.6]\nmax = [1.4, 1.9]\nmaterial = 'soft'\nstate = 'plane-strain'\n";
  const auto phase = make_phase(stack({.gap = 0.05, .more = cap}));
  const auto base = make_phase(without(stack({.gap = 0.05}), "block"));
  std::vector<double> u(phase->size(), 0.0);
  for (std::size_t k = base->size(); k < u.size(); k += 2) u[k] = 0.3;  // along x
  const std::vector<double> R = statics::internal_force(*phase, u);
  for (const double force : R) CHECK(std::abs(force) < 1e-12);
}

TEST_CASE("bodies of a contact that a third bonds are refused by name") {
  const std::string plank =
      "[[body]]\nname = 'plank'\nmin = [1.4, 0.85]\nmax = [1.8, 1.6]\nmaterial = 'soft'\nstate = 'plane-strain'\n";
  CHECK_THROWS_WITH(make_phase(stack({.more = plank})),
                    Catch::Contains("contact[0].bodies: 'block' and 'base' are bonded through another body"));
}

TEST_CASE("bodies that overlap by more than half a cell when the run begins are refused") {
  CHECK_THROWS_WITH(make_phase(stack({.gap = -0.26})), Catch::Contains("'block' and 'base' overlap by 0.52 cells"));
}

TEST_CASE("multipliers keep the pressure between bodies where they are taken, and double it at the same overlap") {
  const auto phase = make_phase(stack({.gap = -0.02}));
  const std::vector<double> u(phase->size(), 0.0);
  const double before = phase->supports().contacts(0, u).at(0).force[1];
  REQUIRE(before > 0);
  CHECK(phase->supports().contact_state(0, u).misfit == Approx(0.04));  // 0.02 of cells of 0.5
  take_multipliers(*phase, u, before);
  CHECK(phase->supports().contacts(0, u).at(0).force[1] == Approx(2 * before).epsilon(1e-12));  // λ + κ g, with λ = κ g
}

TEST_CASE(
    "bodies that turn on each other tell the angle, and those that slide, or rest on a generator, have not turned") {
  // The first border's pieces lie on both sides of the edge of the block, which slides by a cell.
  for (const char* bodies : {"['base', 'block']", "['block', 'base']"}) {
    CAPTURE(bodies);
    const Scene scene = stack({.gap = -0.02, .bodies = bodies});
    const auto phase = make_phase(scene);
    const std::size_t of_base = make_phase(without(scene, "block"))->size();
    std::vector<double> u(phase->size(), 0.0);
    for (std::size_t k = of_base; k < u.size(); k += 2) u[k] = 0.5;  // along x
    CHECK(phase->supports().contacts(0, u).at(0).turned < 1e-12);
    // The block turns about the middle of its lower face; then both turn.
    constexpr double angle = 2;
    const NodalLayout layout = phase->shape().layout();
    for (const std::size_t first : {of_base, std::size_t{0}}) {
      CAPTURE(first);
      for (std::size_t k = first; k < u.size(); ++k) {
        const auto node = 2 * static_cast<std::size_t>(layout.node[k]);
        const double x = layout.positions[node] - 0.9, y = layout.positions[node + 1] - 0.85;
        u[k] = layout.component[k] == 0 ? (std::cos(angle) - 1) * x - std::sin(angle) * y
                                        : std::sin(angle) * x + (std::cos(angle) - 1) * y;
      }
      const ContactReport report = phase->supports().contacts(0, u).at(0);
      if (first > 0) REQUIRE(report.area > 0);
      CHECK(report.turned == Approx(first > 0 ? angle : 0).margin(1e-9));
    }
  }
  // Pieces on a generator of a cylinder lie on a line, but for rounding.
  const auto phase = make_phase(load_scene(
      "cylinder.toml",
      "dim = 3\ngrid = {min = [0, 0, 0], max = [1, 1, 1.2], cells = [8, 8, 10]}\n"
      "body = [{name = 'b', min = [0, 0, 0], max = [1, 1, 0.44], material = 'm', placement = 'gauss'},\n"
      "{name = 's', cylinder = [[0.5, 0.1, 0.735], [0.5, 0.9, 0.735]], radius = 0.3, material = 'm', placement = "
      "'gauss'}]\n"
      "material.m = {law = 'linear-elastic', E = 1e4, nu = 0.3, rho = 1}\ncontact = [{bodies = ['s', 'b']}]\n"
      "damping = {c = 1}\n",
      {}));
  const ContactReport report = phase->supports().contacts(0, some_motion(phase->size(), 1e-4)).at(0);
  REQUIRE(report.area > 0);
  CHECK(report.turned < 0.1);
}

}  // namespace stillpoint::test
