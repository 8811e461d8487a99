// Newton's method where soil yields or a spring softens, up to the load that it bears and beyond.
#include <stillpoint/static_solution.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"
#include "scenes.hpp"
#include "solvers/statics/columns_and_cuts.hpp"
#include "statics.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

TEST_CASE("Newton's method gives the yielding column its exact stresses in three iterations") {
  // Confined compression: σ_yy is the weight above, and on the cone, s_xx = s_zz = −s_yy/2,
  //   √J₂ = √3/2 |s_yy| = √3 (p − σ_yy)/2 = k − η p
  const double c = 1000, phi = 20 * std::numbers::pi / 180, eta = std::sin(phi), k = c * std::cos(phi);
  const Solved s = solve(column({"material.soil={law='drucker-prager', E=2e9, nu=0.2, rho=2000, phi=20, c=1000}"}));
  INFO(shown(s.report));
  CHECK(s.report.converged);
  CHECK(s.report.iterations == 3);  // all points on one branch of the return, whose strains are small
  const auto x = s.phase->fields().positions(), stress = statics::point_stress(*s.phase, s.u);
  std::size_t yielding = 0;
  for (std::size_t p = 0; p < s.phase->points(); ++p) {
    const double h = H / 16, middle = (std::floor(x[2 * p + 1] / h) + 0.5) * h, s_yy = -weight * (H - middle);
    CHECK(stress[4 * p + 1] == Approx(s_yy).epsilon(1e-3));  // strain, ρ g H/E
    const double p_cone = (k + std::sqrt(3.0) / 2 * s_yy) / (std::sqrt(3.0) / 2 + eta);
    const double elastic = s_yy * (1 + 2 * 0.25) / 3;
    if (p_cone >= elastic) continue;
    ++yielding;
    CHECK(stress[4 * p] == Approx((3 * p_cone - s_yy) / 2).epsilon(1e-3));
  }
  CHECK(yielding > s.phase->points() / 2);
}

TEST_CASE("Newton's method converges with order 2 on a yielding cut, by LU where the flow is not associated") {
  for (const std::string& flow : {associated, non_associated}) {
    const Solved s = solve(cut(stands + flow, "20"));
    CAPTURE(flow);
    INFO(shown(s.report));
    CHECK(s.report.converged);
    CHECK(s.report.residual <= 1e-10);
    CHECK(observed_order(s.report.load_steps.back().residuals) > 1.8);
    CHECK(s.report.cholesky_factorisations == 1);  // of the state without stress
    CHECK(s.report.lu_factorisations == s.report.iterations - 1);
    std::vector<double> strain(s.phase->points());
    s.phase->fields().point_history("plastic_strain", strain);
    CHECK(std::ranges::count_if(strain, [](double gamma) { return gamma > 1e-5; }) > 20);
  }
}

TEST_CASE("a nearly symmetric K may be solved by Cholesky factors of its symmetric part, at the cost of the order") {
  const Solved exact = solve(cut(stands + associated, "20"));
  const Solved s = solve(cut(stands + associated, "20"), {.solver = LinearSolver::cholesky});
  INFO(shown(s.report));
  CHECK(s.report.converged);
  CHECK(s.report.lu_factorisations == 0);
  CHECK(s.report.iterations > exact.report.iterations);
  CHECK(distance(s.u, exact.u) < 1e-8);
}

TEST_CASE("an elastoplastic load in ten steps ends near the one in a single step, each committed") {
  const Solved one = solve(cut(stands + non_associated)), ten = solve(cut(stands + non_associated), {.load_steps = 10});
  INFO(shown(ten.report));
  CHECK(ten.report.converged);
  CHECK(ten.report.load_steps.size() > 3);  // grown if they are easy
  CHECK(distance(ten.u, one.u) < 0.1);
  CHECK(distance(ten.u, one.u) > 1e-6);  // the path counts
  // what was committed is in equilibrium with the load: another solution from there has nothing to do
  std::vector<double> u = ten.u;
  const StaticReport again = newton(*ten.phase, 0, u);
  CHECK(again.converged);
  CHECK(again.iterations == 0);
  CHECK(u == ten.u);
}

TEST_CASE("a softening soil and a viscous one are solved with order 2 as well") {
  for (const std::string more :
       {"phi_residual=15, c_residual=3.5e4, softening_strain=0.01, psi=0", "fluidity=1e-6, psi=0"}) {
    CAPTURE(more);
    const Solved s = solve(cut(stands + more), {}, 1);
    INFO(shown(s.report));
    CHECK(s.report.converged);
    CHECK(observed_order(s.report.load_steps.back().residuals) > 1.8);
  }
}

TEST_CASE("a load beyond the limit is no success: the report says how far it went, which is the plastic limit") {
  // A block without friction pulled by 3 c in plane strain: it bears 2 c, less the strain c/E by which it is thinner.
  const auto pulled = [](const std::string& traction) {
    return scenes::load("block", {"material.rubber={law='drucker-prager', E=1e6, nu=0.3, rho=1, c=1e3}",
                                  "phase.max_motion=none", "traction=[{face='top', value=[0, " + traction + "]}]"});
  };
  CHECK(solve(pulled("1.99e3")).report.converged);
  const Solved s = solve(pulled("3e3"));
  INFO(shown(s.report));
  CHECK_FALSE(s.report.converged);
  CHECK(s.report.load_factor < 2.0 / 3);
  CHECK(s.report.load_factor > 1.99 / 3 - 2 * NewtonOptions{}.min_load_step);
  CHECK(s.report.residual == Approx(1 - s.report.load_factor).epsilon(1e-6));
  CHECK_THAT(s.report.reason, Contains("no equilibrium beyond the load factor"));
  CHECK_FALSE(s.report.load_steps.back().converged);
}

TEST_CASE("load steps find the limit of a spring that softens, and take no unstable equilibrium") {
  // T = k e − κ e³ is at most 2/3 k √(k/(3 κ)) = 2/3 · √(1/3)
  const double limit = 2.0 / 3 * std::sqrt(1.0 / 3);
  const auto solved = [](double load) {
    test::Chain chain({.n = 1, .cubic = -1, .load = load});
    std::vector<double> u(1, 0.0);
    return std::pair{newton(chain, 0, u), u[0]};
  };
  const auto [below, u] = solved(0.999 * limit);
  CHECK(below.converged);
  CHECK(u - u * u * u == Approx(0.999 * limit).epsilon(1e-9));
  const auto [above, end] = solved(2 * limit);
  INFO(shown(above));
  CHECK_FALSE(above.converged);
  CHECK(above.load_factor <= 0.5);
  CHECK(above.load_factor > 0.5 - 2 * NewtonOptions{}.min_load_step);
  CHECK(end - end * end * end == Approx(above.load_factor * 2 * limit).epsilon(1e-9));  // the last equilibrium
}

TEST_CASE("an unstable equilibrium is taken by those alone who say that they will look at it") {
  for (const bool accepts : {false, true}) {
    test::Chain chain({.n = 1, .cubic = -1, .load = 0.2});
    std::vector<double> u = {0.9};  // past the limit at √(1/3), where e − e³ falls
    const StaticReport report = newton(chain, 0, u, {.accept_unstable = accepts});
    INFO(shown(report));
    CHECK(report.converged == accepts);
    if (!accepts) CHECK_THAT(report.reason, Contains("unstable"));
    if (accepts) CHECK(u[0] - u[0] * u[0] * u[0] == Approx(0.2).epsilon(1e-8));
    if (accepts) CHECK(u[0] > std::sqrt(1.0 / 3));
  }
}
