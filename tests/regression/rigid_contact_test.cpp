// Contact with rigid bodies against exact answers: a plate, inclines, and what has to be the same whichever way.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;

namespace stillpoint::test {
namespace {

constexpr double E = 1e6, nu = 0.3, height = 1.03, width = 0.55;
constexpr double oedometric = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));

/// A block between rollers, 1.03 high and so off the grid, that a plate presses by 0.01; h = 1/n.
Scene pressed(int n, const std::string& more = "", const std::string& plate = "half_plane = [[0, 1.035], [0, -1]]\n"
                                                                             "motion = ['0', '-0.015']") {
  return load_scene("plate.toml",
                    fmt::format("dim = 2\n[grid]\nmin = [0, 0]\nmax = [0.55, 1.5]\ncells = [{}, {}]\n{}\n"
                                "[body]\nname = 'block'\nmax = [0.55, 1.03]\nmaterial = 'm'\nplacement = 'gauss'\n"
                                "[material.m]\nlaw = 'linear-elastic'\nE = 1e6\nnu = 0.3\nrho = 1000\n"
                                "[[support]]\nface = 'bottom'\nkind = 'roller'\nname = 'floor'\n"
                                "[[support]]\nface = 'left'\nkind = 'roller'\n"
                                "[[support]]\nface = 'right'\nkind = 'roller'\n"
                                "[[rigid]]\nname = 'plate'\n{}\n",
                                n / 2, 3 * n / 2, more, plate),
                    {});
}

const std::string by_auto = "damping = {strategy = 'auto'}", by_newton = "solve = {method = 'newton'}";

Summary run(const Scene& scene) {
  Simulation simulation(scene);
  simulation.run();
  return simulation.summary();
}

double exact_force() { return -oedometric * 0.01 / height * width; }

}  // namespace

TEST_CASE("a plate presses a block whose top lies off the grid with the exact force, by relaxation and by Newton") {
  for (const std::string& way : {by_auto, by_newton, std::string("damping = {strategy = 'adaptive'}")}) {
    CAPTURE(way);
    const Summary s = run(pressed(8, "basis = 'linear'\n[stop]\nresidual = 1e-8\n[" + way.substr(0, way.find(' ')) +
                                         "]\n" + way.substr(way.find('{') + 1, way.find('}') - way.find('{') - 1)));
    REQUIRE(s.status == RunStatus::equilibrium);
    CHECK(s.contacts.at("plate.force_y") == Approx(exact_force()).epsilon(1e-4));
    CHECK(s.contacts.at("plate.contact_area") == Approx(width));
    CHECK(s.contacts.at("plate.penetration") < 1e-3);
    CHECK(s.reactions.at("floor")[1] == Approx(-s.contacts.at("plate.force_y")).epsilon(1e-7));
  }
}

}  // namespace stillpoint::test
