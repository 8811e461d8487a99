// Scenes in space with exact answers: problems/torsion.toml, flexure.toml and square_load.toml.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

std::string cells(int x, int y, int z) { return fmt::format("grid.cells=[{}, {}, {}]", x, y, z); }

/// Beside [exact], on cells of half the size.
void check_orders_of_fields(const Summary& coarse, const Summary& fine) {
  CHECK(std::log2(coarse.error.value().u_rel_l2 / fine.error.value().u_rel_l2) > 1.9);
  CHECK(std::log2(coarse.error->stress_rel_l2.value() / fine.error->stress_rel_l2.value()) > 0.9);
}

std::vector<double> copy_of(ConstVec values) { return {values.begin(), values.end()}; }

/// Errors on cells of some size and of half of it.
struct Errors {
  double coarse, fine;
  double order() const { return std::log2(coarse / fine); }
};

/// Settlement of the top of the layer at (x, z) by the double series of problems/square_load.toml, of as many terms
/// along each axis as leave 1e-5 of it.
double settlement_of_layer(double x, double z) {
  constexpr double b = 1, L = 4, H = 4, p = 100e3, E = 20e6, nu = 0.3, pi = std::numbers::pi;
  constexpr int terms = 400;
  const auto of_load = [&](int m) { return m == 0 ? b / L : 2 * std::sin(m * pi * b / L) / (m * pi); };
  double sum = b * b / (L * L) * H * (1 + nu) * (1 - 2 * nu) / (E * (1 - nu));
  for (int m = 0; m < terms; ++m) {
    for (int n = m == 0 ? 1 : 0; n < terms; ++n) {
      const double gamma = pi / L * std::hypot(m, n), gH = std::min(gamma * H, 20.0);  // where tanh is 1
      const double s = std::sinh(gH), c = std::cosh(gH);
      const double F = 2 * (1 - nu * nu) / (E * gamma) * ((3 - 4 * nu) * s * c - gH) /
                       ((3 - 4 * nu) * c * c + std::pow(1 - 2 * nu, 2) + gH * gH);
      sum += of_load(m) * of_load(n) * std::cos(m * pi * x / L) * std::cos(n * pi * z / L) * F;
    }
  }
  return p * sum;
}

}  // namespace

TEST_CASE("a square bar bears Saint-Venant's torque, 0.140577 G a^4 per twist, with order 2, and shears as it should") {
  constexpr double a = 0.2, L = 0.4, G_alpha = 210e9 / 2.6 * 1e-3 / L, T = 0.140577 * G_alpha * a * a * a * a;
  // What the stress does on the twist (0, −x z, x y), which the functions hold, is what the ends do on it: their
  // torque.
  const auto torque = [](Simulation& of) {
    const std::vector<double> x = copy_of(of.field("position")), sigma = copy_of(of.field("stress"));
    const std::size_t points = of.points();
    double sum = 0;
    for (std::size_t p = 0; p < points; ++p) sum += x[3 * p + 1] * sigma[6 * p + 5] - x[3 * p + 2] * sigma[6 * p + 3];
    return sum / static_cast<double>(points) * a * a;  // of one volume each
  };
  const auto of = [&](int n, double& error) {
    Simulation simulation(scenes::load("torsion", {cells(4, n, n)}));
    REQUIRE(simulation.run() == RunStatus::equilibrium);
    const double of_stress = torque(simulation);
    error = of_stress / T - 1;
    const Summary summary = simulation.summary();
    const auto moment = [&](const std::string& end, std::size_t axis) {
      return summary.reaction_moments.at(end + "_y")[axis] + summary.reaction_moments.at(end + "_z")[axis];
    };
    CHECK(moment("end", 0) == Approx(of_stress).epsilon(1e-6));
    CHECK(moment("start", 0) == Approx(-of_stress).epsilon(1e-6));
    for (const std::size_t axis : {1U, 2U}) CHECK(std::abs(moment("end", axis)) < 1e-6 * of_stress);
    return summary;
  };
  Errors of_torque{};
  const Summary coarse = of(8, of_torque.coarse), fine = of(16, of_torque.fine);
  CAPTURE(of_torque.coarse, of_torque.fine);
  CHECK(of_torque.fine > 0);  // functions that are not free to warp as it would are too stiff
  CHECK(of_torque.fine < 0.004);
  CHECK(of_torque.order() > 1.9);
  check_orders_of_fields(coarse, fine);
  CHECK(scenes::probe(fine, "side", "stress.zx") == Approx(T / (0.208165 * a * a * a)).epsilon(0.01));
}

TEST_CASE(
    "a cantilever that may warp at its root takes the force of Timoshenko's beam with Cowper's shear, with order 2") {
  constexpr double W = 5.98717e5, without_shear = 6.72e5;
  const auto of = [](int n) { return run(scenes::load("flexure", {cells(5 * n / 2, n, n)})); };
  const Summary coarse = of(4), fine = of(8);
  REQUIRE(fine.status == RunStatus::equilibrium);
  const Errors force{coarse.reactions.at("end")[1] / W - 1, fine.reactions.at("end")[1] / W - 1};
  CAPTURE(force.coarse, force.fine);
  CHECK(force.fine > 0);
  CHECK(force.fine < 0.01);
  CHECK(without_shear / W > 1.1);
  CHECK(force.order() > 1.9);
  check_orders_of_fields(coarse, fine);
}

TEST_CASE("a square load on a block on rock settles as its double series says, within 1 % and 0.2 %, with order 2") {
  const double centre = settlement_of_layer(0, 0), corner = settlement_of_layer(1, 1);
  CHECK(centre == Approx(8.17424e-3).epsilon(1e-4));
  const auto of = [&](int n) { return run(scenes::load("square_load", {cells(n, n, n)})); };
  const Summary coarse = of(8), fine = of(16);
  REQUIRE(fine.status == RunStatus::equilibrium);
  const auto off = [](const Summary& s, const std::string& probe, double exact) {
    return std::abs(scenes::probe(s, probe, "u.y") / exact + 1);
  };
  const Errors at_centre{off(coarse, "centre", centre), off(fine, "centre", centre)};
  CAPTURE(at_centre.coarse, at_centre.fine);
  CHECK(at_centre.coarse < 0.01);
  CHECK(at_centre.order() > 1.9);
  CHECK(off(coarse, "corner", corner) < 0.002);
  CHECK(off(fine, "corner", corner) < 0.0005);
}
