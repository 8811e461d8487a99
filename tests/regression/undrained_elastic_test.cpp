// Elastic ground whose pores are full of water that cannot flow, beside closed forms and beside drained ground that is
// as stiff as it with its water.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using scenes::with;

namespace {

// A column whose skeleton has the confined modulus M = 26.9 MPa, and water of K_w/n = 5 GPa.
constexpr double E = 20e6, nu = 0.3, M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), water = 5e9, load = 2000 * 9.81 * 10;
const std::vector<std::string> wet = {"material.soil.undrained=true", "material.soil.water_modulus=2e9",
                                      "material.soil.porosity=0.4"};
const std::string base =
    "probe=[{name='base', at=[0, 0], fields=['stress.yy', 'effective_stress.yy', 'pore_pressure']}, {name='top', "
    "at=[0, 'H'], fields=['u.y']}]";

}  // namespace

TEST_CASE("water that cannot flow bears its share of the weight of an elastic column, whatever the law") {
  for (const std::string law : {"linear-elastic", "neo-hookean", "hencky"}) {
    CAPTURE(law);
    const Summary s = run(scenes::load("column", with(wet, {"material.soil.law=" + law, base})));
    REQUIRE(s.status == RunStatus::equilibrium);
    constexpr double strain = 1e-4;  // 4e-5, and its square
    CHECK(scenes::probe(s, "top", "u.y") == Approx(-load * 10 / 2 / (M + water)).epsilon(strain));
    const double total = scenes::probe(s, "base", "stress.yy");
    CHECK(total == Approx(-load * (1 - 1.0 / 32)).epsilon(0.01));  // half a cell above the base
    CHECK(scenes::probe(s, "base", "pore_pressure") == Approx(-total * water / (M + water)).epsilon(strain));
    CHECK(scenes::probe(s, "base", "effective_stress.yy") == Approx(total * M / (M + water)).epsilon(strain));
  }
}

TEST_CASE("the exact answer of undrained elastic ground is that of its undrained Poisson's ratio") {
  const auto error_of = [](const std::string& material) {
    const Summary s = run(scenes::load(
        "cylinder", {"exact={solution='lame-cylinder', inner_radius='a', outer_radius='b', inner_pressure='p'}",
                     "grid.basis=quadratic", "body.points_per_cell=9", "stop.residual=1e-10",
                     "material.steel={law='linear-elastic', rho=1, " + material + "}"}));
    CHECK(s.status == RunStatus::equilibrium);
    REQUIRE(s.error);
    return *s.error;
  };
  // G = 1/2.6, K = 1/1.2 and K_w/n = 2:  ν_u = (3 K_u − 2 G)/(2 (3 K_u + G)),  E_u = 2 G (1 + ν_u)
  const double G = 1 / 2.6, K = 1 / 1.2 + 2, nu_u = (3 * K - 2 * G) / (2 * (3 * K + G));
  const auto wet_error = error_of("E=1, nu=0.3, undrained=true, water_modulus=1, porosity=0.5");
  const auto as_stiff = error_of(fmt::format("E={:.17g}, nu={:.17g}", 2 * G * (1 + nu_u), nu_u));
  CHECK(wet_error.u_rel_l2 == Approx(as_stiff.u_rel_l2).epsilon(1e-4));  // two ways to residuals of 1e-10
  CHECK(wet_error.u_rel_l2 < 1e-3);                                      // quadratic, 8 cells
  REQUIRE((wet_error.stress_rel_l2 && as_stiff.stress_rel_l2));
  CHECK(*wet_error.stress_rel_l2 == Approx(*as_stiff.stress_rel_l2).epsilon(1e-4));
  CHECK(error_of("E=1, nu=0.3").u_rel_l2 < 1e-3);
}

TEST_CASE("an exact answer of finite strain, which knows no water, is refused for undrained ground") {
  CHECK_THAT(scenes::refusal("oedometer", {"material.soil.law=hencky", "material.soil.undrained=true"}),
             Catch::Contains("leave out undrained"));
}

TEST_CASE("the water of elastic ground gets stiffer with the skeleton from place to place") {
  const auto sum_of = [](const std::string& E_by_place) {
    return run(scenes::load("column", {"material.soil.undrained=true", base, "material.soil.E=" + E_by_place}));
  };
  const Summary one = sum_of("20e6"), two = sum_of("20e6*(1 + (y > 5))");
  // ν_u = 0.495: the same share everywhere
  CHECK(scenes::probe(two, "base", "pore_pressure") ==
        Approx(scenes::probe(one, "base", "pore_pressure")).epsilon(1e-6));
  CHECK(scenes::probe(one, "base", "pore_pressure") > 0.9 * load);
  // of the settlement the upper half has a quarter
  CHECK(scenes::probe(two, "top", "u.y") == Approx(7.0 / 8 * scenes::probe(one, "top", "u.y")).epsilon(1e-6));
}

TEST_CASE("undrained ground that moves on in phases has the pressure of its whole deformation") {
  for (const std::string law : {"neo-hookean", "hencky"}) {
    CAPTURE(law);
    const auto pressed = [&](const std::string& max_motion) {
      return run(scenes::load(
          "ladder/lifts", {"body=[{name='ground', max=['h', '3*h'], material='fill', state='plane-strain'}]",
                           "stage=[]", "material.fill.law=" + law, "material.fill.undrained=true",
                           "material.fill.water_modulus=1e7", "material.fill.porosity=1", "body_force.value=[0, -500]",
                           "solve.method=relaxation", "phase.max_motion=" + max_motion,
                           "probe=[{name='middle', at=['h/2', '1.5*h'], fields=['pore_pressure', 'stress.yy']}]"}));
    };
    const Summary once = pressed("'none'"), often = pressed("0.05");
    REQUIRE((once.status == RunStatus::equilibrium && often.status == RunStatus::equilibrium));
    CHECK(often.phases > 3);
    for (const char* field : {"pore_pressure", "stress.yy"}) {
      CAPTURE(field);
      const double whole = scenes::probe(once, "middle", field);
      CHECK(std::abs(whole) > 1e5);
      CHECK(scenes::probe(often, "middle", field) == Approx(whole).epsilon(0.01));  // other points in other cells
    }
  }
}

TEST_CASE("a block that shares its change of volume is pressed flat in phases as far as in one") {
  // Domains let it find another rest, half as long again.
  const auto pressed = [](const std::string& max_motion) {
    const Summary s = scenes::run_text(
        "dim = 2\n[grid]\nmin = [0, 0]\nmax = [1, 1]\ncells = [4, 4]\n[body]\nmaterial = 'm'\nstate = 'plane-strain'\n"
        "[material.m]\nlaw = 'hencky'\nE = 10e6\nnu = 0.25\nrho = 2000\nundrained = true\nwater_modulus = 2e7\n"
        "porosity = 0.5\n[phase]\ndilatation = 'cells'\n[[support]]\nface = 'left'\nkind = 'roller'\n[[support]]\n"
        "face = 'bottom'\nkind = 'roller'\n[[support]]\nface = 'right'\nkind = 'roller'\n[[traction]]\n"
        "line = [[0, 1], [1, 1]]\npressure = '1e7*min(t, 1)'\n[[probe]]\nname = 'middle'\nat = [0.5, 0.5]\n"
        "fields = ['u.y', 'effective_stress.xx']\n",
        {"phase.max_motion=" + max_motion});
    CHECK(s.status == RunStatus::equilibrium);
    return s;
  };
  const Summary once = pressed("'none'"), often = pressed("0.05");
  // (12/F + 40) MPa ln F = −10 MPa, by Newton's method
  double F = 1;
  for (int k = 0; k < 20; ++k) F -= ((12 / F + 40) * std::log(F) + 10) / (12 * (1 - std::log(F)) / (F * F) + 40 / F);
  CHECK(scenes::probe(once, "middle", "u.y") == Approx((F - 1) / 2).epsilon(1e-3));
  CHECK(scenes::probe(often, "middle", "u.y") == Approx((F - 1) / 2).epsilon(0.1));  // points cross cells, as it says
  CHECK(scenes::probe(often, "middle", "effective_stress.xx") < -5e5);
}

TEST_CASE("ground that a stage lets yield takes over the effective stress and the pressure of elastic ground") {
  const Summary s = run(scenes::load(
      "ladder/lifts",
      {"body=[{name='below', max=['h', '3*h'], material='fill', state='plane-strain'}]", "material.fill.law=hencky",
       "material.fill.undrained=true", "material.fill.water_modulus=1e9", "material.fill.porosity=1",
       "material.wet={law='mohr-coulomb', c=1e9, E='M', nu=0, rho=1800, undrained=true, water_modulus=1e9, porosity=1}",
       "stage=[{at=1, change=['below'], material=['wet']}]", "stop.residual=1e-8",
       "probe=[{name='middle', at=['h/2', '1.5*h'], fields=['pore_pressure', 'effective_stress.yy', 'stress.yy', "
       "'u.y']}]"}));
  REQUIRE(s.status == RunStatus::equilibrium);
  const double own = 1.5 * 18e3, share = 1e9 / (1e9 + 1e7);
  CHECK(scenes::probe(s, "middle", "stress.yy") == Approx(-own).epsilon(1e-3));
  CHECK(scenes::probe(s, "middle", "pore_pressure") == Approx(own * share).epsilon(1e-3));
  CHECK(scenes::probe(s, "middle", "effective_stress.yy") == Approx(-own * (1 - share)).epsilon(1e-3));
}

TEST_CASE("elastic ground that was drained cannot be undrained in a run that begins with its points") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> set = {
      "body=[{name='ground', max=['h', '3*h'], material='fill', state='plane-strain'}]", "stage=[]", "probe=[]",
      "checkpoint.every_steps=1000"};
  REQUIRE(run(scenes::load("ladder/lifts", set), {.out = folder.path()}).status == RunStatus::equilibrium);
  const std::string from = "initial.from=" + (folder.path() / "checkpoint.h5").string();
  CHECK(run(scenes::load("ladder/lifts", with(set, {from}))).status == RunStatus::equilibrium);
  CHECK_THROWS_WITH(run(scenes::load("ladder/lifts", with(set, {from, "material.fill.undrained=true"}))),
                    Catch::Contains("cannot take over the stress of 'linear-elastic', drained,"));
}
