// Materials whose parameters are formulas of the position.
#include <stillpoint/run.hpp>
#include <stillpoint/sparse_matrix.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "driven.hpp"
#include "files.hpp"
#include "largest.hpp"
#include "random_values.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "statics.hpp"

using namespace stillpoint;

namespace {

constexpr double to_rounding = 1e-12;

struct TwoLayers {
  std::string law, lower, upper, by_place;  // the parameters of each layer, and those of one material instead of them
};
const std::string by_layer = "E='5e6 + 15e6*(y < 5)', rho='600 + 1200*(y < 5)'";
const std::vector<TwoLayers> all_laws = {
    {"linear-elastic", "E=2e7, rho=1800", "E=5e6, rho=600", by_layer},
    {"neo-hookean", "E=2e7, rho=1800", "E=5e6, rho=600", by_layer},
    {"hencky", "E=2e7, rho=1800", "E=5e6, rho=600", by_layer},
    {"drucker-prager", "E=2e7, rho=1800, phi=20, c=4e4", "E=5e6, rho=600, phi=20, c=1e4",
     by_layer + ", phi=20, c='1e4 + 3e4*(y < 5)'"},
    {"mohr-coulomb", "E=2e7, rho=1800, phi=20, c=4e4", "E=5e6, rho=600, phi=20, c=1e4",
     by_layer + ", phi=20, c='1e4 + 3e4*(y < 5)'"},
};

std::string material(const std::string& name, const std::string& law, const std::string& parameters) {
  return "material." + name + "={law='" + law + "', nu=0.3, " + parameters + "}";
}

/// problems/column.toml without its exact solution, which is of one material that does not move from phase to phase.
Scene layered_column(const std::vector<std::string>& overrides) {
  std::string text = test::contents(std::string(STILLPOINT_PROBLEMS) + "/column.toml");
  const auto from = text.find("[exact]"), to = text.find("[[probe]]");
  if (from == std::string::npos || to == std::string::npos) throw std::logic_error("the scene has other tables");
  text.erase(from, to - from);
  return load_scene("column.toml", text, overrides);
}

// A column in two layers, of two materials.
std::vector<std::string> layers(const TwoLayers& of, std::vector<std::string> more = {}) {
  more.insert(more.end(), {"body=[{max=[1.25, 5], material='soil', state='plane-strain', points_per_cell=4}, {min=[0, "
                           "5], max=[1.25, 10], material='peat', points_per_cell=4}]",
                           material("soil", of.law, of.lower), material("peat", of.law, of.upper)});
  return more;
}
// The same column of one material.
std::vector<std::string> whole(const TwoLayers& of, std::vector<std::string> more = {}) {
  more.insert(more.end(), {"body=[{max=[1.25, 10], material='soil', state='plane-strain', points_per_cell=4}]",
                           material("soil", of.law, of.by_place)});
  return more;
}

std::vector<double> product(const SparseMatrix& K, const std::vector<double>& u) {
  const Eigen::VectorXd Ku = K * Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size()));
  return {Ku.begin(), Ku.end()};
}
double relative_difference(ConstVec a, ConstVec b) { return largest_difference(a, b) / largest_magnitude(a); }

// Ground under geostatic stress.
std::unique_ptr<LagrangianPhase> level_ground(const std::vector<std::string>& set) {
  return make_phase(scenes::load("level_ground", set));
}
struct AtPoint {
  double y;
  std::array<double, 4> stress;
};
std::vector<AtPoint> stresses(const LagrangianPhase& phase) {
  const std::vector<double> sigma = statics::point_stress(phase, std::vector<double>(phase.size(), 0.0));
  const std::vector<double> x = phase.fields().point_data().positions;
  std::vector<AtPoint> all;
  for (std::size_t p = 0; p < phase.points(); ++p)
    all.push_back({x[2 * p + 1], {sigma[4 * p], sigma[4 * p + 1], sigma[4 * p + 2], sigma[4 * p + 3]}});
  return all;
}

}  // namespace

TEST_CASE("one material by place has the forces, the tangents and the masses of two materials in layers") {
  for (const TwoLayers& one : all_laws) {
    CAPTURE(one.law);
    const auto two = make_phase(layered_column(layers(one, {"phase.max_motion='none'"}))),
               by_place = make_phase(layered_column(whole(one, {"phase.max_motion='none'"})));
    const std::size_t n = two->size();
    REQUIRE(by_place->size() == n);
    const std::vector<double> u = test::random_values(n, 1e-2, 1), zero(n, 0.0), ones(n, 1.0);
    CHECK(relative_difference(statics::internal_force(*two, u), statics::internal_force(*by_place, u)) < to_rounding);
    const std::vector<double> sigma = statics::point_stress(*two, u);  // of a law with a history, none is committed
    CHECK(largest_difference(sigma, statics::point_stress(*by_place, u)) <= to_rounding * largest_magnitude(sigma));
    std::vector<double> a(n), b(n);
    two->mass().apply(ones, a);
    by_place->mass().apply(ones, b);
    CHECK(relative_difference(a, b) < to_rounding);
    for (const Tangent kind : {Tangent::elastic, Tangent::consistent}) {
      two->tangents().apply(kind, 0, u, u, a);
      by_place->tangents().apply(kind, 0, u, u, b);
      CHECK(relative_difference(a, b) < to_rounding);
      CHECK(relative_difference(a, product(by_place->tangents().matrix(kind, 0, u), u)) < to_rounding);
    }
  }
}

TEST_CASE("one material by place comes to rest as two materials in layers do, in a phase and in many") {
  for (const TwoLayers& one : all_laws) {
    for (const bool moves_on : {false, true}) {
      if (moves_on && one.law == "linear-elastic") continue;
      CAPTURE(one.law, moves_on);
      std::vector<std::string> set = {"phase.max_motion='none'", "stop.residual=1e-9"};
      if (moves_on) set = {"phase.max_motion=0.02", "phase.quadrature=points", "stop.residual=1e-9"};
      const Summary two = run(layered_column(layers(one, set))), by_place = run(layered_column(whole(one, set)));
      CHECK(two.status == RunStatus::equilibrium);
      CHECK(by_place.status == RunStatus::equilibrium);
      if (moves_on) CHECK(by_place.phases > 1);
      // Dampings differ, of frequencies whose bound takes the stiffest point: another way, and points that cross lines
      const double same = moves_on ? 1e-3 : 1e-6;
      CHECK(scenes::probe(by_place, "top", "u.y") == Approx(scenes::probe(two, "top", "u.y")).epsilon(same));
      CHECK(scenes::probe(two, "top", "u.y") < -0.01);
    }
  }
}

TEST_CASE("a column whose stiffness and density grow with height comes to the exact solution, with the order 2") {
  // ρ = ρ_0 (1 + η), M = M_0 (1 + η), η = y/H:  σ = −ρ_0 g H (1 − η)(3 + η)/2,
  // u = −ρ_0 g H²/(2 M_0) (4 ln(1 + η) − η − η²/2)
  const auto errors = [](int cells) {
    return run(scenes::load("column", {"grid.cells=[2, " + std::to_string(cells) + "]", "material.soil.E='E*(1 + y/H)'",
                                       "material.soil.rho='rho*(1 + y/H)'", "solve.method=newton",
                                       "exact.u=['0', '-rho*g*H^2/(2*M)*(4*log(1 + y/H) - y/H - (y/H)^2/2)']",
                                       "exact.stress=['-nu/(1-nu)*rho*g*H*(1-y/H)*(3+y/H)/2', "
                                       "'-rho*g*H*(1-y/H)*(3+y/H)/2', '-nu/(1-nu)*rho*g*H*(1-y/H)*(3+y/H)/2', '0']"}))
        .error.value();
  };
  const ExactError coarse = errors(16), fine = errors(32);
  CHECK(fine.u_rel_l2 < 1e-3);
  CHECK(std::log2(coarse.u_rel_l2 / fine.u_rel_l2) > 1.9);
  CHECK(std::log2(coarse.stress_rel_l2.value() / fine.stress_rel_l2.value()) > 0.9);  // linear cells
}

TEST_CASE("level ground bears a weight whose density varies, under a pressure at rest that varies too") {
  // ρ = 1000 (1 + y):  σ_yy = −1000 g ((1 − y) + (1 − y²)/2)
  const auto phase = level_ground({"material.sand.rho='1000*(1 + y)'", "initial.geostatic.K0='0.4 + 0.2*y'"});
  for (const AtPoint& at : stresses(*phase)) {
    const double vertical = -1000 * 9.81 * ((1 - at.y) + (1 - at.y * at.y) / 2);
    CHECK(at.stress[1] == Approx(vertical).epsilon(to_rounding));
    CHECK(at.stress[0] == Approx((0.4 + 0.2 * at.y) * vertical).epsilon(to_rounding));
    CHECK(at.stress[2] == Approx((0.4 + 0.2 * at.y) * vertical).epsilon(to_rounding));
  }
}

TEST_CASE("a step of the density on a line of the grid weighs as two bodies do") {
  const auto two = level_ground(
      {"body=[{max=[1, 0.5], material='sand', state='plane-strain', points_per_cell=4}, {min=[0, 0.5], max=[1, 1], "
       "material='peat', points_per_cell=4}]",
       "material.peat={law='drucker-prager', E=2e7, nu=0.3, rho=600, phi=35}"});
  const auto one = level_ground({"material.sand.rho='600 + 1200*(y < 0.5)'"});
  const auto a = stresses(*two), b = stresses(*one);
  REQUIRE(a.size() == b.size());
  for (const AtPoint& at : a) {
    const double vertical = -9.81 * (at.y < 0.5 ? 600 * 0.5 + 1800 * (0.5 - at.y) : 600 * (1 - at.y));
    CHECK(at.stress[1] == Approx(vertical).epsilon(to_rounding));
  }
  for (const AtPoint& at : b) {
    const double vertical = -9.81 * (at.y < 0.5 ? 600 * 0.5 + 1800 * (0.5 - at.y) : 600 * (1 - at.y));
    CHECK(at.stress[1] == Approx(vertical).epsilon(to_rounding));
  }
}

TEST_CASE("water at rest presses in the pores below its table, bears a share of the weight, and moves nothing") {
  const std::vector<std::string> wet = {"material.sand.undrained=true", "initial.geostatic.water_table=0.75",
                                        "initial.geostatic.water_density=1025"};
  const auto phase = level_ground(wet);
  std::vector<double> water(phase->points());
  phase->fields().point_history("pore_pressure", water);
  const std::vector<AtPoint> all = stresses(*phase);
  const double K0 = 0.3 / 0.7;
  for (std::size_t p = 0; p < all.size(); ++p) {
    const double total = -1800 * 9.81 * (1 - all[p].y), pressure = 1025 * 9.81 * std::max(0.0, 0.75 - all[p].y);
    CHECK(water[p] == Approx(pressure).epsilon(to_rounding));
    CHECK(all[p].stress[1] == Approx(total).epsilon(to_rounding));
    CHECK(all[p].stress[0] == Approx(K0 * (total + pressure) - pressure).epsilon(to_rounding));
  }
  driven::Motion motion(scenes::load("level_ground", wet));
  motion.run_to(0.2);
  // No more than a table that is a kink of the thrust asks of walls and cells: it lies on a line of the grid
  CHECK(largest_magnitude(motion.u()) < 1e-12);
}

TEST_CASE("clay in level ground has the void ratio of its place") {
  const auto phase = level_ground({"body.material=clay",
                                   "material.clay={law='cam-clay', M=1.2, lambda=0.2, kappa=0.04, nu=0.3, rho=1800, "
                                   "e0='1.2 - 0.4*y', OCR=1.5}"});
  std::vector<double> e(phase->points());
  phase->fields().point_history("void_ratio", e);
  const std::vector<double> x = phase->fields().point_data().positions;
  for (std::size_t p = 0; p < e.size(); ++p) CHECK(e[p] == Approx(1.2 - 0.4 * x[2 * p + 1]).epsilon(to_rounding));
}

TEST_CASE("what cannot vary from place to place, or not beside something else, is refused by name") {
  struct Refused {
    std::string scene;
    std::vector<std::string> set;
    std::string message;
  };
  const std::vector<Refused> all = {
      {"column", {"material.soil.nu='0.1*y'"}, "material.soil.nu: "},
      {"column", {"material.soil.rho='1000*t'"}, "material.soil.rho: "},
      {"torsion", {"material.steel.E='1e5*(1+y)'"}, "varies from place to place"},
      {"level_ground",
       {"initial.geostatic.water_table=0.5"},
       "initial.geostatic.water_table: lies above the bottom of the body, and 'sand' is drained"},
      {"level_ground",
       {"material.sand.undrained=true", "initial.geostatic.water_table=1.1"},
       "initial.geostatic.water_table: must not lie above the surface"},
      {"level_ground",
       {"initial.geostatic.water_density=1000"},
       "initial.geostatic.water_density: goes with water_table"},
      {"level_ground",
       {"material.sand.undrained=true", "material.sand.E='1e6*(1 + y)'"},
       "material.sand.undrained: needs a water_modulus"},
      {"level_ground",
       {"material.sand.c='1e3*(1 + y)'", "material.sand.c_residual=10", "material.sand.softening_strain=0.1"},
       "material.sand.c_residual: does not go with a cohesion"},
  };
  for (const Refused& one : all) {
    CAPTURE(one.set);
    CHECK_THAT(scenes::refusal(one.scene, one.set), Catch::Contains(one.message));
  }
  CHECK_THROWS_WITH(level_ground({"initial.geostatic.K0='y - 0.5'"}),
                    Catch::Contains("initial.geostatic.K0: must be > 0"));
  CHECK_THROWS_WITH(level_ground({"material.sand.rho='1000*(y - 0.5)'"}),
                    Catch::Contains("material.sand.rho: must be > 0"));
  CHECK_THROWS_WITH(level_ground({"material.sand.E='1e6*(y - 0.5)'"}), Catch::Contains("material.sand.E: must be > 0"));
}
