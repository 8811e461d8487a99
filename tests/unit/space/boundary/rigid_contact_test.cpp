// Contact with rigid bodies: its force and its tangent, in the plane, axisymmetric and in space.
#include <cmath>
#include <cstddef>
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

using namespace stillpoint;

namespace stillpoint::test {
namespace {

/// A free block of two by two (by two) cells of 1/2, from 0.2 on, that a rigid body touches or not.
Scene touched_block(const std::string& kind, const std::string& rigid, const std::string& more = "") {
  const bool in_space = kind == "space";
  const std::string third = in_space ? ", 0.2" : "", end = in_space ? ", 1.2" : "";
  return load_scene("block.toml",
                    fmt::format("dim = {}\n[grid]\nmin = [0, 0{}]\nmax = [2, 2{}]\ncells = [4, 4{}]\n"
                                "[body]\nmin = [0.2, 0.2{}]\nmax = [1.2, 1.2{}]\nmaterial = 'm'\nstate = '{}'\n"
                                "[material.m]\nlaw = 'linear-elastic'\nE = 100\nnu = 0.3\nrho = 1\n"
                                "[damping]\nc = 1\n[[rigid]]\nname = 'ball'\n{}\n{}\n",
                                in_space ? 3 : 2, in_space ? ", 0" : "", in_space ? ", 2" : "", in_space ? ", 4" : "",
                                third, end, in_space ? "space" : kind, rigid, more),
                    {});
}

std::string ball_at(const std::string& kind, double height) {
  if (kind == "space") return fmt::format("sphere = [0.75, {}, 0.8]\nradius = 0.6", height);
  return fmt::format("disc = [{}, {}]\nradius = 0.6", kind == "axisymmetric" ? 0.0 : 0.75, height);
}

}  // namespace

TEST_CASE("a rigid body that is apart leaves R as it is to the bit, and reports nothing") {
  for (const std::string& kind : contact_states) {
    CAPTURE(kind);
    const auto apart = make_phase(touched_block(kind, ball_at(kind, 1.9)));
    Scene alone = touched_block(kind, ball_at(kind, 1.9));
    alone.rigid.clear();
    const auto without = make_phase(resolve(alone));
    const std::vector<double> u = some_motion(apart->size(), 0.01);
    CHECK(statics::internal_force(*apart, u) == statics::internal_force(*without, u));
    const ContactReport report = apart->supports().contacts(0, u).at(0);
    CHECK(report.force == std::array<double, 3>{});
    CHECK(report.area == 0);
    CHECK_FALSE(apart->supports().contact_state(0, u).touches);
  }
}

TEST_CASE("the tangent of contact is the derivative of its force, and symmetric without friction") {
  for (const std::string& kind : contact_states) {
    for (const char* friction : {"0", "0.3", "'rough'", "0.2\nadhesion = 0.5", "0\nadhesion = 0.5"}) {
      CAPTURE(kind, friction);
      const auto phase = make_phase(touched_block(kind, ball_at(kind, 1.65) + "\nfriction = " + friction));
      const std::size_t n = phase->size();
      const std::vector<double> u = some_motion(n, 0.004), du = some_motion(n, 1);
      REQUIRE(phase->supports().contacts(0, u).at(0).area > 0.1);
      const ContactTangent tangent(*phase, 0, u, du);
      REQUIRE(tangent.scale > 0);
      CHECK(tangent.difference < 1e-13 * tangent.scale);  // rounding
      // The turn of the tangential plane of a curved body is left out where friction acts.
      CHECK(tangent.error < (std::string(friction) == "0" ? 1e-8 : 0.02) * tangent.scale);
      if (std::string(friction) == "0") CHECK(tangent.asymmetry() < 1e-14);
      CHECK(is_stiffer_held(*phase, u, du));
    }
  }
}

TEST_CASE("a free rigid body presses with its weight and its force at any state, and its tangent is their derivative") {
  for (const std::string& kind : contact_states) {
    CAPTURE(kind);
    const std::string third = kind == "space" ? ", '0'" : "";
    const auto phase = make_phase(
        touched_block(kind, ball_at(kind, 1.9) + "\nfree = true\nmass = 0.1\nforce = ['0', '-1-t'" + third + "]",
                      "[body_force]\nvalue = [0, -10" + std::string(kind == "space" ? ", 0]" : "]")));
    const std::size_t n = phase->size();
    const std::vector<double> u = some_motion(n, 0.004), du = some_motion(n, 1);
    for (const double t : {0.0, 2.0}) {
      const ContactReport report = phase->supports().contacts(t, u).at(0);
      CHECK(report.force[1] == Approx(-2 - t).epsilon(1e-12));
      CHECK(report.displacement[1] < -0.04);  // it was 0.1 above the block
      CHECK(phase->supports().contact_state(t, u).balanced);
    }
    const ContactTangent tangent(*phase, 2, u, du);
    REQUIRE(tangent.scale > 0);
    CHECK(tangent.difference < 1e-12 * tangent.scale);  // rounding
    CHECK(tangent.error < 1e-7 * tangent.scale);        // of central differences
    CHECK(tangent.asymmetry() < 1e-13);
  }
}

TEST_CASE("a free rigid body that nothing bears is not in balance") {
  const auto lifted =
      make_phase(touched_block("plane-strain", ball_at("plane-strain", 1.9) + "\nfree = true\nforce = ['0', '1']"));
  const std::vector<double> u(lifted->size(), 0.0);
  CHECK_FALSE(lifted->supports().contact_state(0, u).balanced);
  CHECK(lifted->supports().contacts(0, u).at(0).area == 0);
  // A smooth flat one that is pushed along.
  const auto pushed = make_phase(
      touched_block("plane-strain", "half_plane = [[0, 1.25], [0, -1]]\nfree = true\nforce = ['0.5', '-1']"));
  CHECK_FALSE(pushed->supports().contact_state(0, u).balanced);
  CHECK(pushed->supports().contacts(0, u).at(0).force[1] == Approx(-1));
}

TEST_CASE("the forces on a body are together what the rigid body reports, with its moment") {
  for (const std::string& kind : {std::string("plane-strain"), std::string("space")}) {
    CAPTURE(kind);
    const bool in_space = kind == "space";
    const Scene scene = touched_block(
        kind,
        ball_at(kind, 1.65) + "\nfriction = 0.3\n" +
            (in_space ? "rotation = ['0.2*t', '0', '0.3*t']\nabout = [0.1, 0.4, 0.2]\nmotion = ['0', '0.01*t', '0']"
                      : "rotation = '0.3*t'\nabout = [0.1, 0.4]\nmotion = ['0', '0.01*t']"));
    const auto phase = make_phase(scene);
    Scene alone = scene;
    alone.rigid.clear();
    const auto without = make_phase(resolve(alone));
    const std::size_t n = phase->size(), dim = in_space ? 3 : 2;
    const std::vector<double> u(n, 0.0);
    constexpr double t = 0.1;
    const std::vector<double> R = statics::internal_force(*phase, u, t),
                              R_alone = statics::internal_force(*without, u, t);
    const ContactReport report = phase->supports().contacts(t, u).at(0);
    REQUIRE(report.area > 0.1);
    const NodalLayout layout = phase->shape().layout();
    std::array<double, 3> force{}, moment{};
    const double centre[3] = {0.1, 0.4 + 0.01 * t, 0.2};
    for (std::size_t k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(layout.component[k]);
      const double f = R_alone[k] - R[k];
      force[i] += f;
      std::array<double, 3> arm{}, along{};
      for (std::size_t d = 0; d < dim; ++d)
        arm[d] = layout.positions[dim * static_cast<std::size_t>(layout.node[k]) + d] - centre[d];
      along[i] = f;
      for (std::size_t d = 0; d < 3; ++d)
        moment[d] += arm[(d + 1) % 3] * along[(d + 2) % 3] - arm[(d + 2) % 3] * along[(d + 1) % 3];
    }
    REQUIRE(std::abs(force[1]) > 1);
    for (std::size_t d = 0; d < 3; ++d) {
      CHECK(report.force[d] == Approx(force[d]).margin(1e-12 * std::abs(force[1])));
      CHECK(report.moment[d] == Approx(moment[d]).margin(1e-12 * std::abs(force[1])));
    }
  }
}

TEST_CASE("multipliers keep the force where they are taken, and the penalty acts on what changes from there") {
  const auto phase = make_phase(touched_block("plane-strain", "half_plane = [[0, 1.15], [0, -1]]"));
  const std::vector<double> u(phase->size(), 0.0);
  const double before = phase->supports().contacts(0, u).at(0).force[1];
  REQUIRE(before < 0);
  CHECK(phase->supports().contact_state(0, u).misfit == Approx(0.1));  // 0.05 of cells of 0.5
  take_multipliers(*phase, u, before);
  const double after = phase->supports().contacts(0, u).at(0).force[1];
  CHECK(after == Approx(2 * before).epsilon(1e-12));  // λ + κ g, with λ = κ g
}

}  // namespace stillpoint::test
