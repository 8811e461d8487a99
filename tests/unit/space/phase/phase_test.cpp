#include <stillpoint/relaxation_system.hpp>

#include <cmath>

#include <Eigen/SparseCore>
#include <catch2/catch.hpp>
#include <omp.h>

#include "allocation_count.hpp"
#include "random_values.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;

namespace {

const std::vector<std::string> basis_names{"linear", "quadratic", "cubic", "hermite"};

// The bar with another basis and law, and four points a cell so that every basis has a mass.
Scene bar_with(const std::string& basis, const std::string& law, const std::string& state = "uniaxial-stress") {
  return scenes::bar({"grid.basis=" + basis, "material.bar.law=" + law, "material.bar.nu=0.3", "body.state=" + state,
                      "body.points_per_cell=4", "grid.cells=6"});
}

}  // namespace

TEST_CASE("the internal force is repeatable to the bit") {
  for (const std::string& basis : basis_names) {
    const auto phase = make_phase(bar_with(basis, "neo-hookean"));
    const auto u = test::random_values(phase->size(), 0.1);
    std::vector<double> first(phase->size()), second(phase->size()), other(phase->size());
    REQUIRE(phase->internal_force(0, u, first, *phase->make_trial()));
    phase->internal_force(0, test::random_values(phase->size(), 0.1, 2), other, *phase->make_trial());
    REQUIRE(phase->internal_force(0, u, second, *phase->make_trial()));
    CHECK(first == second);
    CHECK(first != other);
  }
}

TEST_CASE("the tangent is the derivative of the internal force, applied and assembled") {
  for (const std::string& basis : basis_names) {
    for (const std::string law : {"linear-elastic", "neo-hookean"}) {
      const auto phase = make_phase(bar_with(basis, law));
      const std::size_t n = phase->size();
      const auto u = test::random_values(n, 0.1), du = test::random_values(n, 1, 5);
      std::vector<double> applied(n), above(n), below(n), shifted(u);
      phase->tangents().apply(Tangent::consistent, 0, u, du, applied);
      constexpr double d = 1e-6;
      for (std::size_t i = 0; i < n; ++i) shifted[i] = u[i] + d * du[i];
      phase->internal_force(0, shifted, above, *phase->make_trial());
      for (std::size_t i = 0; i < n; ++i) shifted[i] = u[i] - d * du[i];
      phase->internal_force(0, shifted, below, *phase->make_trial());
      const Eigen::VectorXd assembled = phase->tangents().matrix(Tangent::consistent, 0, u) *
                                        Eigen::Map<const Eigen::VectorXd>(du.data(), static_cast<Eigen::Index>(n));
      for (std::size_t i = 0; i < n; ++i) {
        CHECK(applied[i] == Approx((above[i] - below[i]) / (2 * d)).margin(1e-7));
        CHECK(assembled(static_cast<Eigen::Index>(i)) == Approx(applied[i]).margin(1e-12));
      }
    }
  }
}

TEST_CASE("a collapsed material point makes the trial inadmissible instead of a number") {
  const auto phase = make_phase(bar_with("linear", "neo-hookean"));
  std::vector<double> u(phase->size(), 0.0), R(phase->size());
  u.back() = -100;  // the last cell is turned inside out
  CHECK_FALSE(phase->internal_force(0, u, R, *phase->make_trial()));
  u.back() = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(phase->internal_force(0, u, R, *phase->make_trial()));
  CHECK(phase->internal_force(0, std::vector<double>(phase->size(), 0.0), R, *phase->make_trial()));
}

TEST_CASE("a uniform strain gives its stress at every point and forces at the ends only (patch test)") {
  for (const std::string& basis : basis_names) {
    const auto phase = make_phase(scenes::bar({"grid.basis=" + basis, "body.points_per_cell=4", "initial.u=0.01*x"}));
    const auto u = phase->initial_displacement(0);
    std::vector<double> stress(phase->points());
    phase->fields().point_stress(0, u, stress);
    for (const double sigma : stress) CHECK(sigma == Approx(0.01).epsilon(1e-10));
    std::vector<double> R(phase->size()), F(phase->size());
    phase->internal_force(0, u, R, *phase->make_trial());
    phase->external_force(0, u, F);
    for (std::size_t i = 0; i < R.size(); ++i)
      CHECK(R[i] == Approx(10 * F[i]).margin(1e-12));  // 0.01 A against P0 = 0.001
  }
}

TEST_CASE("mass, consistent or lumped, in any basis, is the mass of the body") {
  for (const std::string& basis : basis_names) {
    for (const std::string kind : {"consistent", "lumped"}) {
      Scene scene =
          scenes::bar({"grid.basis=" + basis, "mass.kind=" + kind, "body.points_per_cell=4", "material.bar.rho=2.5"});
      scene.supports.clear();
      const auto phase = make_phase(scene);
      // The rigid translation u = 1: values 1, slopes 0. Σ_ij M_ij over values is the total mass.
      std::vector<double> one(phase->size(), 1.0), M_one(phase->size());
      if (basis == "hermite") {
        for (std::size_t i = 1; i < one.size(); i += 2) one[i] = 0;
      }
      phase->mass().apply(one, M_one);
      double mass = 0;
      for (std::size_t i = 0; i < one.size(); ++i) mass += one[i] * M_one[i];
      CHECK(mass == Approx(25).epsilon(1e-12));
      CHECK(phase->info().total_mass == Approx(25).epsilon(1e-12));
    }
  }
}

TEST_CASE("rigid translation of a free body gives no internal force") {
  for (const std::string& basis : basis_names) {
    Scene scene = bar_with(basis, "neo-hookean");
    scene.supports.clear();
    scene.initial_u = {Expression(0.7)};
    const auto phase = make_phase(scene);
    std::vector<double> R(phase->size());
    REQUIRE(phase->internal_force(0, phase->initial_displacement(0), R, *phase->make_trial()));
    for (const double r : R) CHECK(r == Approx(0).margin(1e-12));
  }
}

TEST_CASE("body force, traction and point force are in balance with the supports") {
  // Total force = rho g A l + traction A + P; with u = 1 everywhere as test function and no support, Σ F_i is that sum.
  Scene scene = scenes::bar({"grid.basis=cubic", "body.points_per_cell=4", "body.area=2", "material.bar.rho=3",
                             "body_force.value=0.5*(1+t)"});
  scene.supports.clear();
  scene.tractions.push_back({.face = Face::right, .value = {Expression(0.25)}, .pressure = {}});
  const auto phase = make_phase(scene);
  std::vector<double> F(phase->size());
  for (const double t : {0.0, 2.0}) {
    phase->external_force(t, std::vector<double>(F.size(), 0.0), F);
    double total = 0;
    for (const double f : F) total += f;
    CHECK(total == Approx(3 * 0.5 * (1 + t) * 2 * 10 + 0.25 * 2 + 0.001).epsilon(1e-12));
  }
}

TEST_CASE("loads are constant unless one depends on t or follows the body, and are the same at every t then") {
  const auto is_constant = [](const std::string& setting) {
    const auto phase = make_phase(scenes::load("incompressible", {setting}));
    if (!phase->loads_are_constant()) return false;
    std::vector<double> u(phase->size()), now(u.size()), later(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = 1e-3 * static_cast<double>(i % 7);
    phase->external_force(0, std::vector<double>(u.size(), 0.0), now);
    phase->external_force(17, u, later);
    CHECK(now == later);
    return true;
  };
  CHECK(is_constant("body_force.value=[0.0, \"-x*y\"]"));
  CHECK_FALSE(is_constant("body_force.value=[0.0, \"-x*t\"]"));
  CHECK(is_constant("force=[{at=[1.0, 1.0], value=[0.0, 1.0]}]"));
  CHECK_FALSE(is_constant("force=[{at=[1.0, 1.0], value=[0.0, \"t\"]}]"));
  CHECK(is_constant("traction=[{face=\"top\", value=[\"x\", 1.0]}]"));
  CHECK_FALSE(is_constant("traction=[{face=\"top\", value=[0.0, \"x*t\"]}]"));
  CHECK_FALSE(is_constant("traction=[{face=\"top\", pressure=1.0}]"));
}

TEST_CASE("initial values of a polynomial that the basis holds are reproduced at the points") {
  const auto phase =
      make_phase(scenes::bar({"body.points_per_cell=5", "grid.basis=cubic", "initial.u=x^3 - 2*x", "initial.v=x^2"}));
  std::vector<double> u(phase->points()), v(phase->points());
  phase->fields().point_displacement(0, phase->initial_displacement(0), u);
  phase->fields().point_velocity(0, phase->initial_velocity(0), v);
  for (std::size_t p = 0; p < phase->points(); ++p) {
    const double x = phase->fields().positions()[p];
    CHECK(u[p] == Approx(x * x * x - 2 * x).epsilon(1e-9));
    CHECK(v[p] == Approx(x * x).epsilon(1e-9));
  }
}

TEST_CASE("forces are the same bits for 1 and 2 threads") {
  const auto phase =
      make_phase(scenes::bar({"grid.cells=20000", "body.points_per_cell=3", "material.bar.law=neo-hookean"}));
  const auto u = test::random_values(phase->size(), 1e-5);
  std::vector<double> one(phase->size()), two(phase->size());
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  REQUIRE(phase->internal_force(0, u, one, *phase->make_trial()));
  omp_set_num_threads(2);
  REQUIRE(phase->internal_force(0, u, two, *phase->make_trial()));
  omp_set_num_threads(before);
  CHECK(one == two);
}

TEST_CASE("what the scene cannot carry is refused with the key that is wrong") {
  const auto message = [](const std::vector<std::string>& overrides) {
    try {
      make_phase(scenes::bar(overrides));
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(message({"grid.basis=cubic", "support=[{at=2.5}]"}) == "accepted");  // held by a spring
  CHECK_THAT(message({"body.points_per_cell=1", "probe=[]"}), Catch::Contains("too few material points"));
  CHECK_THAT(message({"body.min=5.0", "probe=[]"}), Catch::Contains("no material reaches this support"));
}

TEST_CASE("the right-hand side of a scene allocates nothing after its first evaluation") {
  for (const char* mass : {"consistent", "lumped"}) {
    for (const char* law : {"linear-elastic", "neo-hookean"}) {
      const auto phase =
          make_phase(scenes::bar({std::string("mass.kind=") + mass, std::string("material.bar.law=") + law}));
      const auto damping = make_damping("identity", 0.45, 0);
      RelaxationSystem system(*phase, *damping);
      const auto y = test::random_values(2 * phase->size(), 0.01);
      std::vector<double> ydot(y.size());
      REQUIRE(system(0, y, ydot));
      const long before = test::allocation_count();
      const bool admissible = system(0.1, y, ydot);
      const long allocated = test::allocation_count() - before;
      CHECK(admissible);
      CHECK(allocated == 0);
    }
  }
}
