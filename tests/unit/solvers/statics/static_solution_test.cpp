// Newton's method on elastic bodies against exact solutions, against statics.hpp and against relaxation.
#include <stillpoint/state_norms.hpp>
#include <stillpoint/static_solution.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"
#include "driven.hpp"
#include "largest.hpp"
#include "output/exact_error.hpp"
#include "scenes.hpp"
#include "solvers/statics/columns_and_cuts.hpp"
#include "statics.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

TEST_CASE("Newton's method gives the exact self-weight column in one iteration, by one Cholesky factor") {
  const Scene scene = column();
  const Solved s = solve(scene);
  INFO(shown(s.report));
  CHECK(s.report.converged);
  CHECK(s.report.iterations == 1);
  CHECK(s.report.cholesky_factorisations == 1);
  CHECK(s.report.lu_factorisations == 0);
  CHECK(s.report.factor_bytes > 8 * s.u.size());
  CHECK(s.report.load_steps.size() == 1);
  // exact at its nodes: between them a line cuts off 3/32 h² ρ g/M, see column_test.cpp
  const double expected = 3.0 / 32 / std::sqrt(2.0 / 15) / (16 * 16);
  CHECK(exact_error(scene, *s.phase, 0, s.u)->u_rel_l2 == Approx(expected).epsilon(0.01));
}

TEST_CASE(
    "a tolerance that rounding does not reach is met as nearly as it can be, by one factor, if the caller says so") {
  const NewtonOptions unreachable{.tolerance = 1e-25};
  CHECK_FALSE(solve(column(), unreachable).report.converged);
  NewtonOptions near = unreachable;
  near.near_enough = 1e-8;
  const Solved s = solve(column(), near);
  INFO(shown(s.report));
  CHECK(s.report.converged);
  CHECK(s.report.residual < 1e-12);  // a few hundred roundings
  CHECK(s.report.iterations <= 8);
  CHECK(s.report.cholesky_factorisations == 1);
  CHECK(s.report.elastic_iterations == 0);
  CHECK_THAT(s.report.reason, Contains("as small as rounding lets it become"));
  CHECK(distance(s.u, solve(column()).u) < 1e-12);
  near.near_enough = -1;
  CHECK_THROWS_WITH(solve(column(), near), Contains("near_enough"));
}

TEST_CASE("Newton's method agrees with an independent one at large strain, and converges with order 2") {
  for (const auto& law : large_strain) {
    for (const std::string state : {"plane-strain", "axisymmetric"}) {
      for (const std::string basis : {"linear", "quadratic"}) {
        CAPTURE(law, state, basis);
        const Solved s = solve(soft_column(law, {"body.state=" + state, "grid.basis=" + basis}));
        INFO(shown(s.report));
        CHECK(s.report.converged);
        CHECK(s.report.residual <= 1e-10);
        CHECK(largest_magnitude(statics::out_of_balance(*s.phase, s.u)) < 1e-9 * weight * H);
        CHECK(distance(s.u, statics::solution(*s.phase)) < 1e-9);
        CHECK(s.report.lu_factorisations == 0);
        CHECK(observed_order(s.report.load_steps.back().residuals) > 1.8);
      }
    }
  }
}

TEST_CASE("a pressure that follows the surface keeps the order 2, by Cholesky all round a body and by LU on one face") {
  // Only if nothing but supports bounds the loaded surface has the pressure a potential.
  const Solved one_face = solve(scenes::load("block", {"traction=[{face='top', pressure=0.3}]"}));
  INFO(shown(one_face.report));
  CHECK(one_face.report.converged);
  CHECK(one_face.report.lu_factorisations > 0);
  CHECK(observed_order(one_face.report.load_steps.back().residuals) > 1.8);
  const Solved s = solve(scenes::load("block"));
  INFO(shown(s.report));
  CHECK(s.report.converged);
  CHECK(s.report.lu_factorisations == 0);
  CHECK(observed_order(s.report.load_steps.back().residuals) > 1.8);
  CHECK(largest_magnitude(statics::out_of_balance(*s.phase, s.u)) < 1e-9);
  for (std::size_t p = 0; p < s.phase->points(); ++p) {
    CHECK(statics::point_stress(*s.phase, s.u)[4 * p] == Approx(-0.3).epsilon(1e-8));
  }
}

TEST_CASE("relaxation by leapfrog comes to rest in Newton's equilibrium") {
  for (const auto& law : large_strain) {
    CAPTURE(law);
    const Scene scene = soft_column(law, {"grid.cells=[1, 8]", "constants.E=1.2e6"});  // ρ g H/E = 0.16
    driven::Motion motion(scene);
    while (!(StateNorms(motion.relaxation()).residual(motion.t(), motion.u()) < 1e-10) && motion.t() < 100)
      motion.run_to(motion.t() + 1);
    const Solved s = solve(scene);
    CHECK(distance(s.u, motion.u()) < 1e-7);
  }
}

TEST_CASE("a moved support loads the body by itself, with its reactions as the scale of the residual") {
  const Scene scene = scenes::bar(
      {"support=[{at=0.0, u='0.1*t'}, {at=10.0}]", "force=[]", "material.bar.law=neo-hookean", "exact.u=0.5*(1-x/10)"});
  const Solved s = solve(scene, {}, 5);
  INFO(shown(s.report));
  CHECK(s.report.converged);
  CHECK(exact_error(scene, *s.phase, 5, s.u)->u_rel_max < 1e-9);
  const std::vector<double> at_rest(s.u.size(), 0.0), R = statics::internal_force(*s.phase, at_rest, 5);
  const auto trial = s.phase->make_trial();
  std::vector<double> again(s.u.size());
  REQUIRE(s.phase->internal_force(5, at_rest, again, *trial));
  const auto norm = [](const std::vector<double>& x) {
    return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())).norm();
  };
  const double scale = norm(trial->reactions);
  CHECK(scale != Approx(norm(R)));
  CHECK(s.report.load_steps.front().residuals.front() == Approx(norm(R) / scale).epsilon(1e-12));
}

TEST_CASE("load steps begin at the state that there is: one in equilibrium stays as it is all the way") {
  Solved s = solve(soft_column("neo-hookean"));
  const std::vector<double> before = s.u;
  const StaticReport again = newton(*s.phase, 0, s.u, {.load_steps = 4});
  INFO(shown(again));
  CHECK(again.converged);
  CHECK(again.load_steps.size() > 1);
  CHECK(again.iterations == 0);
  CHECK(s.u == before);
}

TEST_CASE("a body that is not held has no static solution, and its K no factor") {
  const Solved s = solve(column({"support=[]"}));
  CHECK_FALSE(s.report.converged);
  CHECK(s.report.load_factor == 0);
}

TEST_CASE("contact is refused, and options that are wrong, by name") {
  const auto slope = make_phase(scenes::load("slope", {"constants.h=0.3", "grid.cells=[20, 11]"}));
  std::vector<double> u(slope->size(), 0.0);
  CHECK_THROWS_WITH(newton(*slope, 0, u), Contains("contact"));
  CHECK_THROWS_WITH(conjugate_gradients(*slope, 0, u), Contains("contact"));
  test::Chain chain;
  CHECK_THROWS_WITH(newton(chain, 0, u, {.tolerance = 0}), Contains("tolerance"));
  CHECK_THROWS_WITH(newton(chain, 0, u, {.max_iterations = 0}), Contains("max_iterations"));
  CHECK_THROWS_WITH(newton(chain, 0, u, {.load_steps = 0}), Contains("load_steps"));
  CHECK_THROWS_WITH(newton(chain, 0, u, {.min_load_step = 0}), Contains("min_load_step"));
  CHECK_THROWS_WITH(newton(chain, 0, u, {.symmetry = -1}), Contains("symmetry"));
  CHECK_THROWS_WITH(newton(chain, 0, u, {.max_cg_iterations = -1}), Contains("max_cg_iterations"));
  CHECK_THROWS_WITH(conjugate_gradients(chain, 0, u, {.tolerance = 0}), Contains("tolerance"));
  CHECK_THROWS_WITH(conjugate_gradients(chain, 0, u, {.max_iterations = -1}), Contains("max_iterations"));
}

TEST_CASE("a full step that makes the residual larger, or that is inadmissible, is halved") {
  // atan u = 0 from u = 2, where Newton's method by itself diverges; and the same if u < −1 cannot be evaluated.
  struct Arctangent : test::Chain {
    explicit Arctangent(double lowest) : Chain({.n = 1}), lowest_(lowest) {}
    bool internal_force(double, ConstVec u, Vec R, TrialState&) const override {
      R[0] = std::atan(u[0]);
      return u[0] >= lowest_;
    }
    SparseMatrix matrix(Tangent, double, ConstVec u) const override {
      SparseMatrix K(1, 1);
      K.insert(0, 0) = 1 / (1 + u[0] * u[0]);
      return K;
    }
    double lowest_;
  };
  for (const double lowest : {-1e9, -0.5}) {
    Arctangent system(lowest);
    std::vector<double> u = {2};
    const StaticReport report = newton(system, 0, u);
    INFO(shown(report));
    CHECK(report.converged);
    CHECK(report.load_steps.size() == 1);
    CHECK(report.force_evaluations > report.iterations + 2);
    CHECK(u[0] == Approx(0).margin(1e-9));
  }
}

TEST_CASE("a beam bends by half its length in one load step, by full steps where a search would crawl") {
  // Mattiasson's elastica for P L²/(E I) = 2: the end goes down by 0.49346 L and back by 0.16064 L, and turns by
  // 0.78175.
  const Scene scene = scenes::load("cantilever");
  const auto phase = make_phase(scene);
  std::vector<double> u(phase->size(), 0.0);
  const StaticReport report = newton(*phase, 0, u);
  CAPTURE(report.reason);
  CHECK(report.converged);
  CHECK(report.load_steps.size() == 1);
  CHECK(report.iterations < 30);                               // a search alone took 2994, in 225 load steps
  CHECK(largest_value(report.load_steps[0].residuals) > 100);  // on the way over: the beam is stretched
  CHECK(report.residual < 1e-10);

  // The mean of the last points, which lie 1/24 before the end.
  const std::vector<double> x = phase->fields().positions(), moved = statics::point_displacement(*phase, u);
  double back = 0, down = 0, count = 0;
  for (std::size_t k = 0; k < x.size(); k += 2) {
    if (x[k] < 10 - 0.05) continue;
    back -= moved[k], down -= moved[k + 1], ++count;
  }
  const double rest = 1.0 / 24, angle = 0.78175;
  CHECK_THAT(down / count, Catch::Matchers::WithinRel(4.9346 - rest * std::sin(angle), 0.01));
  CHECK_THAT(back / count, Catch::Matchers::WithinRel(1.6064 - rest * (1 - std::cos(angle)), 0.02));
}

TEST_CASE(
    "a beam bends to the elastica by few factors of K, as the stress of a long step's stretch is not taken into K") {
  // With the stress that each step leaves behind, these loads took 35, 72 and 124 iterations.
  for (const auto& [load, most] : {std::pair{"1", 10}, {"5", 60}, {"10", 75}}) {
    CAPTURE(load);
    const Summary s = run(scenes::load("ladder/elastica", {std::string("constants.load=") + load}));
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.steps <= most);
    CHECK(s.error->u_rel_l2 < 2e-3);  // shear and stretch of L/h = 50
  }
}
