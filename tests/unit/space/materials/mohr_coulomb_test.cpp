// A material point of Mohr–Coulomb soil in the tests of a laboratory, beside closed forms. Compression is negative.
#include <stillpoint/mohr_coulomb.hpp>

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "law_checks.hpp"
#include "space/materials/history_path.hpp"

namespace stillpoint {
namespace {

using enum StressState;
using checks::one_degree;
using test::cell_pressure, test::HistoryPath;

template <StressState S, bool softens = false>
using PyramidPath = HistoryPath<MohrCoulomb<S, softens>, MohrCoulombParameters>;

// The root of an increasing f by the secant method.
template <class F>
double root_of(const F& f, double x0, double x1) {
  double f0 = f(x0), f1 = f(x1);
  for (int k = 0; k < 60 && f1 != f0; ++k) {
    const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
    x0 = x1, f0 = f1, x1 = x2, f1 = f(x2);
  }
  return x1;
}

struct Triaxial {
  double axial;            // σ at the end [Pa]
  double volume_by_axial;  // d ln J/d ε_axial of the last increment
};

// The axial strain is led, the stress across it held.
Triaxial triaxial(const MohrCoulombParameters& m, double axial_strain) {
  PyramidPath<axisymmetric> path(m, {cell_pressure, cell_pressure, cell_pressure, 0});
  constexpr int steps = 50;
  double before = 0, across = 0, volume = 0, last = 0;
  for (int k = 1; k <= steps; ++k) {
    const double zz = std::exp(axial_strain * k / steps) - 1;
    const auto at = [&](double rr) { return Gradient<axisymmetric>{rr, 0, 0, zz, rr}; };
    across = root_of([&](double rr) { return path.stress_after(at(rr))[0] - cell_pressure; }, across, across + 1e-4);
    path.step(at(across));
    last = volume;
    volume = 2 * std::log1p(across) + axial_strain * k / steps;
    before = axial_strain / steps;
  }
  return {path.stress()[1], (volume - last) / before};
}

}  // namespace

TEST_CASE("triaxial compression and extension end on Mohr-Coulomb's strength and dilate by psi") {
  const double phi = GENERATE(30., 35., 0.), c = 1e4;
  const double psi = phi > 0 ? GENERATE(0., 10., 30.) : 0.;
  const MohrCoulombParameters m{.E = 2e7, .nu = 0.3, .c = c, .phi = phi, .psi = psi};
  const double s = std::sin(phi * one_degree), k = c * std::cos(phi * one_degree), d = std::sin(psi * one_degree);
  CAPTURE(phi, psi);
  // σ₁ (1 − sin φ) = σ₃ (1 + sin φ) + 2 c cos φ, pressures positive
  const Triaxial compressed = triaxial(m, -0.03);
  CHECK(-compressed.axial == Approx((1e5 * (1 + s) + 2 * k) / (1 - s)).epsilon(1e-12));
  CHECK(compressed.volume_by_axial == Approx(-2 * d / (1 - d)).margin(1e-7));  // tr d beside d ln J, second order
  const Triaxial extended = triaxial(m, 0.02);
  CHECK(-extended.axial == Approx((1e5 * (1 - s) - 2 * k) / (1 + s)).epsilon(1e-11));
  CHECK(extended.volume_by_axial == Approx(2 * d / (1 + d)).margin(1e-7));
}

TEST_CASE("a biaxial test ends on the strength, and the stress out of the plane follows elastically") {
  // The stresses that ../points.json of an independent Koiter return has: φ 30, c 10 kPa, σ₃ 100 kPa
  const double psi = GENERATE(0., 10., 30.);
  PyramidPath<plane_strain> path({.E = 2e7, .nu = 0.3, .c = 1e4, .phi = 30, .psi = psi},
                                 {cell_pressure, cell_pressure, cell_pressure, 0});
  double across = 0;
  for (int k = 1; k <= 50; ++k) {
    const auto at = [&](double xx) { return Gradient<plane_strain>{xx, 0, 0, -0.03 * k / 50}; };
    across = root_of([&](double xx) { return path.stress_after(at(xx))[0] - cell_pressure; }, across, across + 1e-4);
    path.step(at(across));
  }
  CHECK(path.stress()[1] == Approx(-334641.0161513775).epsilon(1e-11));
  CHECK(path.stress()[2] == Approx(-170392.30484541325).epsilon(1e-10));
}

TEST_CASE("simple shear under a constant normal stress mobilises Davis' ratio, and dilates by tan psi") {
  struct Case {
    double phi, psi, K0;
  };
  const auto [phi, psi, K0] = GENERATE(Case{30, 0, 0.5}, Case{30, 0, 1}, Case{30, 10, 0.5}, Case{30, 30, 0.5},
                                       Case{40, 10, 0.5}, Case{40, 0, 1}, Case{20, 0, 1});
  // So stiff that the stress turns by 1e-7
  PyramidPath<plane_strain> path({.E = 2e12, .nu = 0.3, .phi = phi, .psi = psi},
                                 {K0 * cell_pressure, cell_pressure, K0 * cell_pressure, 0});
  double up = 0, before = 0;
  constexpr int steps = 400;
  constexpr double gamma = 4e-6;
  for (int k = 1; k <= steps; ++k) {
    const auto at = [&](double yy) { return Gradient<plane_strain>{0, gamma * k / steps, 0, yy}; };
    before = up;
    up = root_of([&](double yy) { return path.stress_after(at(yy))[1] - cell_pressure; }, up, up + 1e-9);
    path.step(at(up));
  }
  const double davis = std::sin(phi * one_degree) * std::cos(psi * one_degree) /
                       (1 - std::sin(phi * one_degree) * std::sin(psi * one_degree));
  CAPTURE(phi, psi, K0);
  CHECK(path.stress()[3] / -cell_pressure == Approx(davis).epsilon(1e-5));
  CHECK((up - before) / (gamma / steps) == Approx(std::tan(psi * one_degree)).margin(1e-3));
}

TEST_CASE("softening leads the strength along the table by plastic strain") {
  const MohrCoulombParameters m{
      .E = 2e9, .nu = 0.3, .c = 2e4, .phi = 0, .softening = {{0.02, 1e4, 0, 0}, {0.1, 1.5e4, 0, 0}}};
  PyramidPath<plane_strain, true> path(m, {});
  const auto shear_at = [&](double plastic_strain) {
    while (path.plastic_strain() < plastic_strain) path.step({0, path.H[1] + 1e-5, 0, 0});
    return std::hypot(path.stress()[3], (path.stress()[0] - path.stress()[1]) / 2);
  };
  CHECK(shear_at(0.01) == Approx(1.5e4).epsilon(1e-3));  // one increment late
  CHECK(shear_at(0.02) == Approx(1e4).epsilon(1e-3));
  CHECK(shear_at(0.06) == Approx(1.25e4).epsilon(1e-3));
  CHECK(shear_at(0.2) == Approx(1.5e4).epsilon(1e-9));
  CHECK(path.stress()[3] == Approx(1.5e4).epsilon(0.01));  // and not only in size: turned by γ/2 of elastic spin
}

TEST_CASE("material that is drawn apart keeps the opened volume as a gap, which closes before it is pressed") {
  struct Case {
    double c, tension;
    int directions;  // in which it is drawn apart
  };
  const auto [c, tension, directions] = GENERATE(Case{5e3, 1e9, 3}, Case{5e3, 3e3, 3}, Case{5e3, 0, 3}, Case{0, 1e9, 3},
                                                 Case{0, 1e9, 2}, Case{0, 1e9, 1}, Case{5e3, 0, 2}, Case{5e3, 0, 1});
  CAPTURE(c, tension, directions);
  const MohrCoulombParameters m{.E = 2e7, .nu = 0.25, .c = c, .phi = 30, .psi = 0, .tension = tension};
  const double K = 2e7 / 1.5, cut = std::min(tension, c / std::tan(30 * one_degree));
  PyramidPath<axisymmetric> path(m, {});
  const auto at = [n = directions](double e) { return Gradient<axisymmetric>{e, 0, 0, n > 1 ? e : 0, n > 2 ? e : 0}; };
  path.go(at(0.01), 10);
  const double volume = directions * std::log1p(0.01);
  const auto check_stress = [&] {
    for (int a = 0; a < 3; ++a) CHECK(path.stress()[a] == Approx(cut).margin(1e-9));
  };
  check_stress();
  CHECK(path.gap() == Approx(volume - cut / K).epsilon(1e-4));
  path.go(at(0.005), 10);
  check_stress();
  path.go(at(0), 10);
  // What is left is the stress of a change of shape, which c bounds; without the gap it would be 1.3e5 a direction
  CHECK((path.stress()[0] + path.stress()[1] + path.stress()[2]) / 3 == Approx(0).margin(1e-5 * K + 2 * c));
}

TEST_CASE("an increment beyond what a point can bear is not a number") {
  PyramidPath<plane_strain> plane({.E = 1e7, .c = 1e4}, {});
  CHECK(std::isnan(plane.step({-1.5, 0, 0, 0})[0] + plane.step({-1.5, 0, 0, 0})[1]));
  PyramidPath<space> space_path({.E = 1e7, .c = 1e4}, {});
  const auto P = space_path.step({-1.5, 0, 0, 0, 0, 0, 0, 0, 0});
  double sum = 0;
  for (const double component : P) sum += component;
  CHECK(std::isnan(sum));
}

}  // namespace stillpoint
