// A rigid disc that turns on a block for long: its contact is that of one that stands.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

// Pressed in by a tenth of its radius R, it turns by 0.2 rad/s, and bears the shear stress c wherever it touches.
const std::string disc_on_rubber =
    "dim = 2\n[constants]\nc = 500\nR = 0.3\n[grid]\nmin = [-1, 0]\nmax = [1, 1.2]\ncells = [40, 24]\n"
    "[[body]]\nname = 'block'\nmin = [-1, 0]\nmax = [1, 0.6]\nmaterial = 'rubber'\n"
    "[material.rubber]\nlaw = 'neo-hookean'\nE = 1e5\nnu = 0.3\nrho = 1000\n[[support]]\nface = 'bottom'\n"
    "[[rigid]]\nname = 'disc'\ndisc = [0, '0.6+R']\nradius = 'R'\nabout = [0, '0.6+R']\nrotation = '0.2*t'\n"
    "motion = ['0', '-0.03*min(t/2,1)']\nadhesion = 'c'\n[damping]\nstrategy = 'combined'\n"
    "[stop]\nresidual = 0\ntime = 12\n";

}  // namespace

TEST_CASE("the pressures of a contact whose loads change for long do not come to alternate from patch to patch") {
  constexpr double E = 1e5, nu = 0.3, c = 500, R = 0.3;
  // With domains, of which there are two along a cell, it took 30 s until their pressures were felt.
  for (const auto& set : {std::vector<std::string>{"phase.max_motion='none'"},
                          {"phase.max_motion=0.1"},
                          {"phase.max_motion=0.1", "grid.cells=[80, 48]", "stop.time=40"}}) {
    CAPTURE(set);
    const Summary s = scenes::run_text(disc_on_rubber, set);
    REQUIRE(s.status == RunStatus::end_time);
    const double N = -s.contacts.at("disc.force_y"),
                 half = std::sqrt(4 * N * R * (1 - nu * nu) / (std::numbers::pi * E));
    // Two places that feel contact are 0.15 of its width apart, or half of that.
    CHECK(s.contacts.at("disc.contact_area") == Approx(2 * half).epsilon(0.1));
    CHECK(std::abs(s.contacts.at("disc.moment_z")) == Approx(c * 2 * half * R).epsilon(0.1));
  }
}
