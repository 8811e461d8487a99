// Convergence in h to a manufactured solution: observed orders of the L2 error of u.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "output/exact_error.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "statics.hpp"

using namespace stillpoint;

namespace {

double error_with(std::vector<std::string> overrides, int cells) {
  overrides.push_back("grid.cells=" + std::to_string(cells));
  const Scene scene = scenes::load("mms_bar", overrides);
  const auto phase = make_phase(scene);
  const auto u = statics::solution(*phase);
  statics::commit(*phase, u);
  return exact_error(scene, *phase, 0, u)->u_rel_l2;
}

double observed_order(const std::vector<std::string>& overrides) {
  const double coarse = error_with(overrides, 16), fine = error_with(overrides, 32);
  CAPTURE(coarse, fine);
  REQUIRE(fine > 1e-13);
  return std::log2(coarse / fine);
}

struct Expected {
  std::string basis;
  double order;
};

const std::vector<Expected> bases = {{"linear", 2}, {"quadratic", 3}, {"cubic", 4}, {"hermite", 4}};

}  // namespace

TEST_CASE("with consistent volumes u converges in L2 with order 2, 3, 4, 4: linear, quadratic, cubic, Hermite") {
  for (const auto& [basis, order] : bases) {
    for (const std::string placement : {"gauss", "uniform"}) {
      CAPTURE(basis, placement);
      const std::string points = placement == "gauss" ? "4" : "6";  // six even points carry degree 5
      const double observed =
          observed_order({"grid.basis=" + basis, "body.placement=" + placement, "body.points_per_cell=" + points});
      CHECK(observed == Approx(order).margin(0.15));
    }
  }
}

TEST_CASE("in space u converges in L2 with order 2, 3, 4: linear, quadratic, cubic, and the stress with one less") {
  struct Case {
    const char *basis, *points;
    double order;
  };
  for (const auto& [basis, points, order] :
       {Case{"linear", "8", 2}, Case{"quadratic", "27", 3}, Case{"cubic", "64", 4}}) {
    CAPTURE(basis);
    const auto error = [&, basis = basis, points = points](int cells) {
      const Summary summary = run(scenes::load(
          "ladder/mms_cube", {fmt::format("grid.cells=[{0}, {0}, {0}]", cells), std::string("grid.basis=") + basis,
                              std::string("body.points_per_cell=") + points}));
      REQUIRE(summary.status == RunStatus::equilibrium);
      return summary.error.value();
    };
    const ExactError coarse = error(4), fine = error(6);
    const double refined = std::log(1.5);
    CHECK(std::log(coarse.u_rel_l2 / fine.u_rel_l2) / refined == Approx(order).margin(0.35));  // few cells: above it
    CHECK(std::log(*coarse.stress_rel_l2 / *fine.stress_rel_l2) / refined == Approx(order - 1).margin(0.2));
  }
}

TEST_CASE("the same orders at finite strain, with a neo-Hookean bar and its own body force") {
  // P(F) = mu (F − 1/F) + lambda ln F/F in a confined bar; b = −P'(F) u,xx/rho with u = 0.1 sin 2x, F = 1 + 0.2 cos 2x.
  const std::string F = "(1+0.2*cos(2*x))", lambda = "(E*0.25/(1.25*0.5))", mu = "(E/2.5)";
  const std::string slope = "(" + mu + "*(1+1/" + F + "^2)+" + lambda + "*(1-ln(" + F + "))/" + F + "^2)";
  const std::string end = "(1+0.2*cos(2))";
  const std::vector<std::string> scene = {
      "material.bar.law=neo-hookean",
      "material.bar.nu=0.25",
      "body.state=uniaxial-strain",
      "exact.u=0.1*sin(2*x)",
      "exact.stress=" + mu + "*(" + F + "-1/" + F + ")+" + lambda + "*ln(" + F + ")/" + F,
      "body_force.value=" + slope + "*0.4*sin(2*x)/rho",
      "traction=[{face='right', value='" + mu + "*(" + end + "-1/" + end + ")+" + lambda + "*ln(" + end + ")/" + end +
          "'}]"};
  for (const auto& [basis, order] : bases) {
    std::vector<std::string> overrides = scene;
    overrides.push_back("grid.basis=" + basis);
    CAPTURE(basis);
    CHECK(observed_order(overrides) == Approx(order).margin(0.15));
  }
}

TEST_CASE("a basis of degree p loses an order where the points integrate less than 2p - 2, and it is said so") {
  const auto poor = [](const std::string& basis, const std::string& points, const std::string& volumes) {
    return std::vector<std::string>{"grid.basis=" + basis, "body.placement=uniform", "body.points_per_cell=" + points,
                                    "body.volumes=" + volumes};
  };
  const auto notes = [](const std::vector<std::string>& overrides) {
    return make_model(scenes::load("mms_bar", overrides)).notes;
  };
  const auto two = poor("quadratic", "2", "consistent");  // degree 1
  CHECK(observed_order(two) == Approx(2).margin(0.15));
  CHECK_THAT(notes(two).at(0), Catch::Contains("integrate degree 1, this basis needs 2"));
  const auto three = poor("hermite", "3", "consistent");  // degree 3
  CHECK(observed_order(three) == Approx(3).margin(0.15));
  CHECK_THAT(notes(three).at(0), Catch::Contains("integrate degree 3, this basis needs 4"));
  const auto equal = poor("cubic", "4", "equal");  // degree 1
  CHECK(observed_order(equal) < 2.5);
  CHECK_THAT(notes(equal).at(0), Catch::Contains("take consistent volumes"));
  CHECK(notes(poor("hermite", "5", "consistent")).empty());
}

TEST_CASE("relaxing a manufactured problem reaches the error of the direct solve") {
  const Summary relaxed = run(scenes::load("mms_bar"));
  CHECK(relaxed.status == RunStatus::equilibrium);
  CHECK(relaxed.error->u_rel_l2 == Approx(error_with({}, 16)).epsilon(1e-2));
}
