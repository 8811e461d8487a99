// Loads that move with the body from phase to phase, class by class: the deformation is given, nothing is solved.
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "largest.hpp"
#include "space/boundary/loaded_block.hpp"
#include "space/grid/domain_basis.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::WithinAbs;

namespace {

Scene loaded(const std::string& points_per_cell, std::vector<std::string> loads) {
  loads.insert(loads.begin(), {"grid={min=[-1, -1.5], max=[3.5, 2.5], cells=[18, 16]}",
                               "body.points_per_cell=" + points_per_cell, "phase.max_motion=0.5"});
  return free_block(loads);
}

void check_equal(const Resultant& is, const Resultant& given) {
  CHECK_THAT(is.force[0], WithinAbs(given.force[0], 1e-12));
  CHECK_THAT(is.force[1], WithinAbs(given.force[1], 1e-12));
  CHECK_THAT(is.moment, WithinAbs(given.moment, 1e-12));
}

/// Stretched to 1.8 times its length in 40 phases, then turned once round in 50. check(F): in each of them.
template <AxisBasis B>
void stretch_and_turn(LoadedBlock<B, Kinematics::plane>& block, const std::function<void(const Matrix& F)>& check) {
  const Point<2> centre = {1.125, 0.5};
  Matrix F{1, 0, 0, 1};
  for (int phase = 0; phase < 90; ++phase) {
    CAPTURE(B::degree, phase);
    check(F);
    const Matrix f = phase < 40 ? Matrix{1.015, 0, 0, 0.995} : rotation(7.2);
    F = f * F;
    block.deform([&](const Point<2>& x) {
      const Point<2> turned = f * Point<2>{x[0] - centre[0], x[1] - centre[1]};
      return Point<2>{centre[0] + turned[0], centre[1] + turned[1]};
    });
  }
}
template <AxisBasis B>
std::string quadrature() {
  return B::window > 1 ? "phase.quadrature=domains" : "phase.quadrature=points";
}

/// A block under q along its right and left face that has been stretched by λ, sheared and shifted by shares of a cell.
template <AxisBasis B>
double largest_imbalance(const std::string& points_per_cell, double shear) {
  constexpr double q = 0.7;
  Largest largest;
  for (const double stretch : {0.4, 0.75, 1.0, 1.33, 1.7}) {
    for (int tenths = 0; tenths < 10; ++tenths) {
      LoadedBlock<B, Kinematics::plane> block(
          loaded(points_per_cell,
                 {quadrature<B>(), "traction=[{face='right', value=[0.7, 0]}, {face='left', value=[-0.7, 0]}]"}));
      block.deform([&](const Point<2>& x) {
        return Point<2>{stretch * x[0] + 0.025 * tenths, x[1] + shear * x[0] - 0.01 * tenths};
      });
      // σ = P Fᵀ/det F with P_xx = q alone, F = [λ 0; γ 1]: σ_xx = q, σ_xy = γ q/λ
      largest.take(block.imbalance(q, shear * q / stretch));
    }
  }
  return largest.value();
}

/// Where a position of the undeformed block is.
Point<2> image(const Matrix& F, const Point<2>& X) {
  const Point<2> moved = F * Point<2>{X[0] - 1.125, X[1] - 0.5};
  return {1.125 + moved[0], 0.5 + moved[1]};
}

template <AxisBasis B>
void check_dead_loads(const std::string& points_per_cell) {
  LoadedBlock<B, Kinematics::plane> block(
      loaded(points_per_cell,
             {quadrature<B>(), "traction=[{face='top', value=[0.2, -0.3]}, {face='right', value=['0.7*(1 + t)', 0.1]}]",
              "force=[{at=[0.6, 0.3], value=[0.4, '-0.9 - t']}, {at=[0.5, 0.75], value=[0, 1]}]"}));
  stretch_and_turn<B>(block, [&](const Matrix& F) {
    Resultant given;
    given.add(image(F, {1.125, 0.75}), {1.25 * 0.2, -1.25 * 0.3});
    given.add(image(F, {1.75, 0.5}), {0.5 * 0.7, 0.5 * 0.1});
    given.add(image(F, {0.6, 0.3}), {0.4, -0.9});
    given.add(image(F, {0.5, 0.75}), {0, 1});
    check_equal(block.resultant(), given);
  });
}

template <AxisBasis B>
void check_pressure(const std::string& points_per_cell) {
  LoadedBlock<B, Kinematics::plane> block(
      loaded(points_per_cell, {quadrature<B>(), "traction=[{face='right', pressure=0.3}]"}));
  stretch_and_turn<B>(block, [&](const Matrix& F) {
    const Point<2> area = F.cofactor() * Point<2>{0.5, 0};
    Resultant given;
    given.add(image(F, {1.75, 0.5}), {-0.3 * area[0], -0.3 * area[1]});
    check_equal(block.resultant(), given);
  });
}

}  // namespace

TEST_CASE("through phases the force and the moment of tractions and point forces are those given, to 1e-12") {
  for (const char* points : {"1", "4"}) {  // with one point a cell the stretched surface is often in a cell without any
    CAPTURE(points);
    check_dead_loads<BSpline<1>>(points);
    check_dead_loads<BSpline<2>>(points);
    check_dead_loads<BSpline<3>>(points);
    check_dead_loads<DomainBSpline<1>>(points);
    check_dead_loads<DomainBSpline<2>>(points);
    check_dead_loads<DomainBSpline<3>>(points);
  }
}

TEST_CASE("a deformed block is in equilibrium with its tractions wherever it cuts the cells, if points are domains") {
  for (const char* points : {"4", "9"}) {
    for (const double shear : {0.0, 0.1, -0.2}) {
      CAPTURE(points, shear);
      CHECK(largest_imbalance<DomainBSpline<1>>(points, shear) < 1e-12);
      CHECK(largest_imbalance<DomainBSpline<2>>(points, shear) < 1e-12);
      CHECK(largest_imbalance<DomainBSpline<3>>(points, shear) < 1e-12);
    }
    // At points alone the sums are off by that much of the largest nodal force: what domains are for.
    CHECK(largest_imbalance<BSpline<2>>(points, 0) > 0.05);
  }
}

TEST_CASE("through phases the force and the moment of a pressure are those on the deformed face, to 1e-12") {
  for (const char* points : {"1", "4"}) {
    CAPTURE(points);
    check_pressure<BSpline<1>>(points);
    check_pressure<BSpline<2>>(points);
    check_pressure<BSpline<3>>(points);
    check_pressure<DomainBSpline<1>>(points);
    check_pressure<DomainBSpline<2>>(points);
    check_pressure<DomainBSpline<3>>(points);
  }
}

TEST_CASE("through phases a ring bears a traction on its undeformed area and a pressure on its present one") {
  const auto check = []<AxisBasis B>(B) {
    const auto axial = [](const std::string& load) {
      LoadedBlock<B, Kinematics::axisymmetric> block(
          loaded("1", {"body.state=axisymmetric", "traction=[{face='top', " + load + "}]",
                       "grid={min=[0, -1.5], max=[3.5, 2.5], cells=[14, 16]}"}));
      for (int phase = 0; phase < 40; ++phase)
        block.deform([](const Point<2>& x) { return Point<2>{1.012 * x[0], 1.01 * x[1]}; });
      return block.resultant().force[1];
    };
    const double area = std::numbers::pi * (1.75 * 1.75 - 0.5 * 0.5), stretch = std::pow(1.012, 40);
    CHECK(axial("value=[0, 0.3]") == Approx(0.3 * area).epsilon(1e-12));
    CHECK(axial("pressure=0.3") == Approx(-0.3 * area * stretch * stretch).epsilon(1e-12));
  };
  check(BSpline<1>{});
  check(BSpline<2>{});
  check(BSpline<3>{});
}
