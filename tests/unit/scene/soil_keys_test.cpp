// Keys of soils: tables of softening, water, parameters that are formulas of the position.
#include <stillpoint/scene_error.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "files.hpp"
#include "largest.hpp"
#include "random_values.hpp"
#include "scene/grid_lines.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "statics.hpp"

using namespace stillpoint;

namespace {

const std::string soil = "material.soil.";

MaterialSpec soil_with(const std::vector<std::string>& overrides) {
  std::vector<std::string> all;
  for (const std::string& one : overrides) all.push_back(soil + one);
  return scenes::load("stable_slope", all).materials.at("soil");
}

/// ladder/triaxial_clay.toml with parts of its text replaced.
using Changes = std::vector<std::pair<std::string, std::string>>;
Scene scene_of_clay(const Changes& changes) {
  std::string text = test::contents(std::string(STILLPOINT_PROBLEMS) + "/ladder/triaxial_clay.toml");
  for (const auto& [from, to] : changes) {
    const auto at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the scene does not hold " + from);
    text.replace(at, from.size(), to);
  }
  return load_scene("clay.toml", text, {});
}
const std::string without_stress = "[initial]\nstress = [-100e3, -100e3, -100e3, 0.0]\n";

/// Why it is refused, when it is read or when its points are made; empty if it is not.
std::string refusal_of_clay(const Changes& changes) {
  try {
    make_phase(scene_of_clay(changes));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a table of softening has its rows, by plastic strain") {
  const auto rows = soil_with({"softening=[[0.05, 5e3, 18, 0], ['0.1*2', 2e3, 15, 0]]"}).softening;
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].plastic_strain == 0.05);
  CHECK(rows[1].plastic_strain == 0.2);
  CHECK(rows[1].c == 2e3);
  CHECK(rows[1].phi == 15);
}

TEST_CASE("a cohesion may be a formula of the position, and a friction angle may not") {
  const MaterialSpec by_place = soil_with({"c=1e3*(H - y) + x"});
  CHECK(by_place.by_place.at("c")(std::vector<double>{2, 4}, 0) == Approx(6002));
  CHECK(by_place.parameters.at("c") == 1);
  const MaterialSpec constant = soil_with({"c=1e3*H"});
  CHECK(constant.by_place.empty());
  CHECK(constant.parameters.at("c") == 1e4);
  CHECK_THAT(scenes::refusal("stable_slope", {soil + "phi=20 + y"}), Catch::Contains("'y' cannot be used here"));
  CHECK_THAT(scenes::refusal("stable_slope", {soil + "c=1e3*(H - t)"}), Catch::Contains("'t' cannot be used here"));
  CHECK_THAT(scenes::refusal("stable_slope", {soil + "c=-3"}), Catch::Contains("must be at least 0, not -3"));
  CHECK_THROWS_WITH(make_phase(scenes::load("stable_slope", {soil + "c=1e3*(5 - y)"})),
                    Catch::Contains("material.soil.c: must be >= 0 everywhere, not -"));
}

TEST_CASE("soil that cannot be is refused by name") {
  const std::vector<std::pair<std::string, std::string>> all = {
      {"softening=[[0.1, 1e3, 20]]", "softening[0]: expected [plastic strain, c, phi, psi], found 3 values"},
      {"softening=[0.1, 1e3, 20, 0]", "expected [plastic strain, c, phi, psi]"},
      {"softening=[[0.1, 1e3, 20, 0], [0.1, 1e3, 20, 0]]", "softening[1][0]: must be larger than 0.1"},
      {"softening=[[0, 1e3, 20, 0]]", "softening[0][0]: must be greater than 0"},
      {"softening=[[0.1, 1e3, 20, 21]]", "softening[0][3]: must be at most phi = 20, not 21"},
      {"softening=[[0.1,1,9,0],[0.2,1,9,0],[0.3,1,9,0],[0.4,1,9,0],[0.5,1,9,0],[0.6,1,9,0],[0.7,1,9,0],[0.8,1,9,0],[0."
       "9,1,"
       "9,0]]",
       "has 9 rows; expected at most 8"},
      {"psi=25", "psi: must be at most phi = 20, not 25"},
      {"water_modulus=2e9", "water_modulus: goes with undrained = true"},
      {"porosity=0.3", "porosity: goes with undrained = true"}};
  for (const auto& [set, message] : all) {
    CAPTURE(set);
    CHECK_THAT(scenes::refusal("stable_slope", {soil + set}), Catch::Contains(message));
  }
  CHECK_THAT(scenes::refusal("stable_slope", {soil + "undrained=true", soil + "psi=5"}),
             Catch::Contains("undrained: does not go with dilatancy"));
  const auto asked =
      scenes::load("stable_slope", {soil + "undrained=true", soil + "psi=5", soil + "undrained_dilatancy=true"});
  CHECK(asked.materials.at("soil").undrained_dilatancy);
  CHECK_THAT(scenes::refusal("stable_slope", {soil + "c=1e3*(11 - y)", soil + "softening=[[0.1, 1e3, 20, 0]]"}),
             Catch::Contains("softening: does not go with a cohesion that is a formula"));
  for (const char* law : {"linear-elastic", "neo-hookean", "hencky"}) {
    CAPTURE(law);
    const std::vector<std::string> wet = {fmt::format("material.soil.law={}", law), soil + "undrained=true"};
    CHECK(scenes::refusal("column", wet).empty());
    CHECK_THAT(scenes::refusal("column", scenes::with(wet, {"body.state=plane-stress"})),
               Catch::Contains("material.soil.undrained: undrained ground has no state 'plane-stress'"));
    const std::vector<std::string> E = {soil + "E=1e6*(1 + y)"};
    CHECK(scenes::refusal("column", scenes::with(wet, E)).empty());
    CHECK_THAT(scenes::refusal("column", scenes::with(wet, scenes::with(E, {soil + "water_modulus=2e9"}))),
               Catch::Contains("water_modulus: does not go with an E that is a formula of the position"));
    CHECK_THAT(scenes::refusal("column", scenes::with(wet, {soil + "undrained_dilatancy=true"})),
               Catch::Contains("unknown key 'undrained_dilatancy'"));
  }
}

TEST_CASE("Cam clay says what it misses, and what of its parameters goes together") {
  struct Bad {
    std::vector<std::string> set;
    const char* message;
  };
  const std::string clay = "material.clay.";
  const Bad all[] = {
      {{clay + "kappa=0.2"}, "material.clay.kappa: must be below lambda = 0.2, not 0.2"},
      {{clay + "OCR=0.9"}, "material.clay.OCR: must be at least 1, not 0.9"},
      {{clay + "pc=2e5"}, "material.clay.pc: give either OCR or pc, not both"},
      {{clay + "pc=0"}, "material.clay.pc: must be greater than 0, not 0"},
      {{clay + "volume=still"}, "unknown value 'still'"},
      {{clay + "undrained=true"}, "material.clay.undrained: needs water_modulus"},
      {{"initial.stress=[1e5, 0, 0, 0]"}, "initial.stress: is a mean pressure of -33333.3 Pa"},
      {{"initial.stress=[-1e5, -1e5, -1e5]"}, "initial.stress: expected 4 values (xx, yy, zz, xy), found 3"},
      {{"initial.geostatic={K0=1, surface=1}", "body_force.value=[0, -9.81]"},
       "initial.stress: does not go with initial.geostatic"},
      {{"initial.u=[0, 0]"}, "initial.u: does not go with initial.stress"},
  };
  for (const auto& [set, message] : all) {
    CAPTURE(set);
    CHECK_THAT(scenes::refusal("ladder/triaxial_clay", set), Catch::Contains(message));
  }
  CHECK_THAT(refusal_of_clay({{"OCR = 1.0\n", ""}}), Catch::Contains("material.clay.law: 'cam-clay' needs OCR or pc"));
  CHECK_THAT(refusal_of_clay({{without_stress, ""}}),
             Catch::Contains("material.clay.law: 'cam-clay' has no stiffness without pressure"));
  CHECK_THAT(refusal_of_clay({{"OCR = 1.0", "pc = 99e3"}}), Catch::Contains("outside the yield surface of 'cam-clay'"));
  CHECK(refusal_of_clay({{"OCR = 1.0", "pc = 100e3"}}).empty());
  CHECK(refusal_of_clay({{"OCR = 1.0", "pc = \"150e3 - 400e3*y\""}}).empty());
  CHECK_THAT(refusal_of_clay({{"OCR = 1.0", "pc = \"150e3 - 2000e3*y\""}}),
             Catch::Contains("material.clay.pc: must be > 0"));
  CHECK_THAT(refusal_of_clay({{"OCR = 1.0", "OCR = \"2 - 20*y\""}}),
             Catch::Contains("material.clay.OCR: must be >= 1"));
  CHECK_THAT(refusal_of_clay({{without_stress,
                               "[initial.geostatic]\nK0 = 1\nsurface = 0.1\n[body_force]\n"
                               "value = [0, 9.81]\n"}}),
             Catch::Contains("'cam-clay' has no stiffness without pressure, and the mean pressure at ("));
}

TEST_CASE("clay in level ground has the p_c of the largest vertical stress that it bore, by OCR at each place") {
  // p_c/σ_v = 0.877787 at OCR = 1, of M = 1.2, λ = 0.2, κ = 0.04, ν = 0.3
  const auto phase = make_phase(scene_of_clay(
      {{without_stress, "[initial.geostatic]\nK0 = 0.866687013\nsurface = 0.1\n[body_force]\nvalue = [0, -10]\n"},
       {"OCR = 1.0", "OCR = \"1 + 10*y\""}}));
  const std::size_t P = phase->points();
  std::vector<double> pc(P), e(P);
  phase->fields().point_history("pc", pc);
  phase->fields().point_history("void_ratio", e);
  const std::vector<double> positions = phase->fields().point_data().positions;
  for (std::size_t p = 0; p < P; ++p) {
    const double y = positions[2 * p + 1], vertical = 1800 * 10 * (0.1 - y);
    // At OCR = 1 this stress, flatter than normal consolidation makes it, lies on the yield surface
    const double pressure = (1 + 2 * 0.866687013) / 3 * vertical, q = (1 - 0.866687013) * vertical;
    const double through = pressure + q * q / (1.44 * pressure);
    CHECK(pc[p] == Approx(std::max((1 + 10 * y) * 0.877786932671487 * vertical, through)).epsilon(1e-8));
    CHECK(e[p] == 1);
  }
}

TEST_CASE("undrained ground has a pore pressure and an effective stress among its fields") {
  const auto dry = make_phase(scenes::load("stable_slope", {}));
  const auto wet = make_phase(scenes::load("stable_slope", {soil + "undrained=true"}));
  const auto names = [](const auto& phase) { return phase->info().law_fields; };
  CHECK_THAT(names(wet), Catch::VectorContains(std::string("pore_pressure")));
  CHECK_THAT(names(dry), !Catch::VectorContains(std::string("pore_pressure")));
}

TEST_CASE("points have the cohesion of their places: the forces are those of two soils, one above the other") {
  const std::string above = "{law='mohr-coulomb', E=1e8, nu=0.3, rho=2000, phi=20, c=1e3}";
  const std::string one =
      "body=[{max=[12, 5], material='soil', state='plane-strain'}, {min=[0, 5], max=[12, 10], "
      "material='%', state='plane-strain'}]";
  const auto bodies = [&](const std::string& upper) { return std::string(one).replace(one.find('%'), 1, upper); };
  const auto forces_of = [&](const std::vector<std::string>& overrides) {
    const auto phase = make_phase(scenes::load("stable_slope", overrides));
    return statics::internal_force(*phase, test::random_values(phase->size(), 1e-2, 1), 0);
  };
  const auto two = forces_of({bodies("upper"), "material.upper=" + above, soil + "c=3e3"});
  const auto by_place = forces_of({bodies("soil"), soil + "c=1e3 + 2e3*(y < 5)"});
  CHECK(two == by_place);
  const auto other = forces_of({bodies("soil"), soil + "c=3e3"});
  CHECK(largest_difference(two, other) > 1e-3 * largest_magnitude(two));
}

TEST_CASE("softening over bands of a length counts its plastic strains by the cells to which they gather") {
  const double h = mean_cell(scenes::load("stable_slope", {}).grid);
  const auto forces_with = [](const std::string& softening, const std::string& length) {
    std::vector<std::string> set = {"material.soil={law='mohr-coulomb', E=1e8, nu=0.3, rho=2000, phi=20, c=1e3, " +
                                    softening + length + "}"};
    const auto phase = make_phase(scenes::load("stable_slope", set));
    std::vector<double> u = test::random_values(phase->size(), 1e-2, 1);
    statics::commit(*phase, u);
    for (double& value : u) value *= 2;
    return statics::internal_force(*phase, u, 0);
  };
  const std::string at_1 = "softening=[[0.01, 1e2, 10, 0]]", at_2 = "softening=[[0.02, 1e2, 10, 0]]";
  const auto wide = forces_with(at_1, ", softening_length=" + std::to_string(2 * h));
  const auto of_cells = forces_with(at_2, "");
  CHECK(largest_difference(wide, of_cells) < 1e-6 * largest_magnitude(of_cells));  // the digits of the length
  CHECK(largest_difference(of_cells, forces_with(at_1, "")) > 1e-4 * largest_magnitude(of_cells));
  CHECK_THAT(scenes::refusal("stable_slope", {soil + "softening_length=0.1"}),
             Catch::Contains("material.soil.softening_length: goes with softening"));
}
