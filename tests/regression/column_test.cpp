// A column under its own weight, in the plane and as a cylinder, at small and at large strain: problems/column.toml.
#include <stillpoint/material.hpp>

#include "largest.hpp"
#include "output/exact_error.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "statics.hpp"

using namespace stillpoint;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

Scene column(std::vector<std::string> overrides = {}) { return scenes::load("column", overrides); }

/// u of the static solution, off by this share in L2 over the points.
double error_of(const Scene& scene) {
  const auto phase = make_phase(scene);
  return exact_error(scene, *phase, 0, statics::solution(*phase))->u_rel_l2;
}

std::string cells_high(int n) { return "grid.cells=[2, " + std::to_string(n) + "]"; }

/// Confined compression at large strain: P(F) = W'(F) = −ρ g (H − Y). With dY = P'(F) dF/(ρ g) the displacement is
///   u = ∫ (F − 1) dY = [(F − 1) P − W]/(ρ g) between the stretches at the base and at Y.
struct ExactColumn {
  static constexpr double nu = 0.3, rho = 2000, g = 9.81, H = 10, E = 3.924e5;  // ρ g H = E/2
  std::string law;
  LameParameters m = LameParameters::from(E, nu);

  static double weight_above(double Y) { return rho * g * (H - Y); }
  double W(double F) const {
    const double ln = std::log(F);
    return law == "hencky" ? (m.lambda + 2 * m.mu) / 2 * ln * ln
                           : m.mu / 2 * (F * F - 1 - 2 * ln) + m.lambda / 2 * ln * ln;
  }
  double P(double F) const {
    const double ln = std::log(F);
    return law == "hencky" ? (m.lambda + 2 * m.mu) * ln / F : m.mu * (F - 1 / F) + m.lambda * ln / F;
  }
  double stretch(double Y) const {
    double low = 0.5, high = 1;
    for (int k = 0; k < 60; ++k) (P((low + high) / 2) < -weight_above(Y) ? low : high) = (low + high) / 2;
    return (low + high) / 2;
  }
  double u(double Y) const {
    const auto potential = [this](double F) { return ((F - 1) * P(F) - W(F)) / (rho * g); };
    return potential(stretch(Y)) - potential(stretch(0));
  }
};

std::vector<std::string> at_large_strain(const std::string& law, const std::string& state) {
  return {"material.soil.law=" + law, "body.state=" + state, "constants.E=" + std::to_string(ExactColumn::E)};
}

/// Largest |u_y − exact| over the points, as a share of the top's displacement.
double error_at_large_strain(const ExactColumn& exact, std::vector<std::string> overrides) {
  const auto phase = make_phase(column(overrides));
  const auto u = statics::point_displacement(*phase, statics::solution(*phase));
  const auto x = phase->fields().positions();
  Largest off;
  for (std::size_t p = 0; p < phase->points(); ++p) {
    CHECK_THAT(u[2 * p], WithinAbs(0, 1e-9));
    off.take_magnitude(u[2 * p + 1] - exact.u(x[2 * p + 1]));
  }
  return off.value() / std::abs(exact.u(ExactColumn::H));
}

struct InPhases {
  Summary summary;
  double off;  // of the top's settlement, as a share
};
InPhases in_phases(const std::string& law, const std::vector<std::string>& overrides) {
  Scene scene = column(overrides);
  scene.exact = {};  // of small strain, and of undeformed places
  scene.phase.max_motion = 0.3;
  Summary s = run(scene);
  const double off = scenes::probe(s, "top", "u.y") / ExactColumn{law}.u(s.probe_positions.at("top")[1]) - 1;
  return {std::move(s), off};
}

const std::vector<std::string> states = {"plane-strain", "axisymmetric"}, laws = {"neo-hookean", "hencky"};

}  // namespace

TEST_CASE("the linear column is exact at its nodes, so that its points are off by 0.257 (h/H)^2 of the field") {
  // Between exact nodes a line cuts off ξ (1 − ξ) h²/2 ρ g/M: 3/32 h² at the points, ξ = 1/4 and 3/4, against √(2/15)
  // H² of u in L2.
  for (const std::string& state : states) {
    for (const int n : {8, 32}) {
      CAPTURE(state, n);
      const double expected = 3.0 / 32 / std::sqrt(2.0 / 15) / (n * n);
      // what is left is the sum over the points for the norm of the field
      CHECK(error_of(column({"body.state=" + state, cells_high(n)})) == Approx(expected).epsilon(0.01));
    }
  }
}

TEST_CASE("bases that hold a parabola hold the column exactly where the points integrate degree 2") {
  for (const std::string& state : states) {
    for (const std::string basis : {"quadratic", "cubic", "hermite"}) {
      for (const std::string placement : {"gauss", "uniform"}) {
        CAPTURE(state, basis, placement);
        // to rounding times the condition of K
        const std::string points = basis == "quadratic" ? "9" : "25";
        CHECK(error_of(column({"body.state=" + state, "grid.basis=" + basis, "body.placement=" + placement,
                               "body.points_per_cell=" + points, cells_high(8),
                               basis == "hermite" ? "mass.kind=consistent" : "mass.kind=lumped"})) < 1e-10);
      }
    }
  }
}

TEST_CASE("relaxing the column reaches the exact answer as far as its residual allows") {
  const Summary linear = run(column());
  CHECK(linear.status == RunStatus::equilibrium);
  CHECK(linear.error->u_rel_l2 == Approx(3.0 / 32 / std::sqrt(2.0 / 15) / 256).epsilon(0.01));
  const Summary quadratic = run(column({"grid.basis=quadratic", "body.points_per_cell=9"}));
  CHECK(quadratic.status == RunStatus::equilibrium);
  CHECK(quadratic.error->u_rel_l2 < 1e-6);  // 100 residuals of 1e-8
}

TEST_CASE("at large strain the column loses 25 % of its base's height, and its points converge with order 2 and 3") {
  for (const std::string& law : laws) {
    const ExactColumn exact{law};
    REQUIRE(exact.stretch(0) < 0.76);
    for (const std::string& state : states) {
      for (const std::string basis : {"linear", "quadratic"}) {
        CAPTURE(law, state, basis);
        auto scene = at_large_strain(law, state);
        scene.insert(scene.end(), {"grid.basis=" + basis, "body.placement=gauss", "body.points_per_cell=9"});
        const auto off = [&](int n) {
          auto finer = scene;
          finer.push_back(cells_high(n));
          return error_at_large_strain(exact, finer);
        };
        const double coarse = off(8), fine = off(16);
        CAPTURE(coarse, fine);
        CHECK(std::log2(coarse / fine) > (basis == "linear" ? 1.9 : 2.8));
        CHECK(fine < (basis == "linear" ? 2e-3 : 5e-5));
      }
    }
  }
}

TEST_CASE("at large strain each cell of the linear column bears exactly the weight above its middle") {
  // P is uniform in a cell and the nodes balance; in confined compression σ_yy = P.
  for (const std::string& law : laws) {
    for (const std::string& state : states) {
      CAPTURE(law, state);
      const auto phase = make_phase(column(at_large_strain(law, state)));
      const auto u = statics::solution(*phase);
      const auto x = phase->fields().positions(), stress = statics::point_stress(*phase, u);
      const double h = ExactColumn::H / 16;
      for (std::size_t p = 0; p < phase->points(); ++p) {
        const double middle = (std::floor(x[2 * p + 1] / h) + 0.5) * h;
        CHECK_THAT(stress[4 * p + 1],
                   WithinAbs(-ExactColumn::weight_above(middle), 1e-9 * ExactColumn::weight_above(0)));
        CHECK_THAT(stress[4 * p], WithinRel(stress[4 * p + 2], 1e-9));  // σ_xx = σ_zz
      }
    }
  }
}

TEST_CASE("relaxed at large strain in a single phase, the column is the static solution") {
  for (const std::string& law : laws) {
    CAPTURE(law);
    Scene scene = column(at_large_strain(law, "plane-strain"));
    scene.exact = {};  // of small strain
    const Summary s = run(scene);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.phases == 1);
    const auto phase = make_phase(scene);
    const auto u = statics::solution(*phase);
    std::vector<double> top(2);
    phase->fields().read_places(0, u, std::vector<double>(u.size()))->displacement(s.probe_positions.at("top"), top);
    CHECK_THAT(scenes::probe(s, "top", "u.y"), WithinRel(top[1], 1e-6));
    CHECK_THAT(scenes::probe(s, "top", "u.y"), WithinRel(ExactColumn{law}.u(s.probe_positions.at("top")[1]), 2e-3));
  }
}

TEST_CASE("at large strain in many phases the quadratic column settles right to 0.3 % and bears its weight to 2 %") {
  // What is lost is in the points of a cell that no longer integrate it once they have moved.
  for (const std::string& law : laws) {
    for (const std::string& state : states) {
      auto overrides = at_large_strain(law, state);
      overrides.insert(overrides.end(), {"grid.basis=quadratic", "body.points_per_cell=9"});
      const auto [s, off] = in_phases(law, overrides);
      CAPTURE(law, state, s.reason, off);
      CHECK(s.status == RunStatus::equilibrium);
      CHECK(s.phases > 5);
      CHECK(std::abs(off) < 0.003);
      const double y = s.probe_positions.at("base")[1];
      CHECK_THAT(scenes::probe(s, "base", "stress.yy"), WithinRel(-ExactColumn::weight_above(y), 0.02));
    }
  }
}

TEST_CASE("in many phases the linear column at points settles too far, the less the more points a cell has") {
  // Cell crossing [Steffen, Kirby and Berzins 2008]: ∇N jumps at the grid lines, so that a cell's stress is off by as
  // much as the share of its length that the points in it stand for.
  const auto off = [](const std::string& points) {
    auto overrides = at_large_strain("hencky", "plane-strain");
    overrides.push_back("body.points_per_cell=" + points);
    return in_phases("hencky", overrides).off;
  };
  const double coarse = off("4"), fine = off("36");
  CAPTURE(coarse, fine);
  CHECK(std::abs(coarse) < 0.12);
  CHECK(std::abs(fine) < 0.02);
}

TEST_CASE("a run of elastic points in many phases says what a linear basis costs them, and no other run does") {
  const auto warns = [](const std::string& basis, double max_motion, Quadrature quadrature = Quadrature::points) {
    Scene scene = scenes::load("column", {"material.soil.law=hencky", "grid.basis=" + basis});
    scene.phase.max_motion = max_motion;
    scene.phase.quadrature = quadrature;
    for (const std::string& note : make_model(scene).notes) {
      if (note.find("points cross the cells of a linear basis") != std::string::npos) return true;
    }
    return false;
  };
  CHECK(warns("linear", 0.1));
  CHECK_FALSE(warns("linear", 0.1, Quadrature::domains));
  CHECK_FALSE(warns("quadratic", 0.1));
  CHECK_FALSE(warns("linear", PhaseSpec::never));
}
