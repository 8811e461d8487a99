// Newton's method and conjugate gradients against exact solutions, against statics.hpp and against relaxation.
#include <stillpoint/state_norms.hpp>
#include <stillpoint/static_solution.hpp>

#include <cmath>
#include <numbers>

#include "chain.hpp"
#include "driven.hpp"
#include "largest.hpp"
#include "output/exact_error.hpp"
#include "scenes.hpp"
#include "statics.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

namespace {

constexpr double rho = 2000, g = 9.81, H = 10, weight = rho * g;

Scene column(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), "phase.max_motion=none");
  return scenes::load("column", overrides);
}
/// The column under ρ g H = E/2, of a law for large strain.
Scene soft_column(const std::string& law, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), {"material.soil.law=" + law, "constants.E=392400"});
  return column(overrides);
}
/// 10 m × 10 m of cohesive soil behind a vertical cut on the right, on a fixed base.
Scene cut(const std::string& strength, const std::string& cells = "10") {
  return column({"material.soil={law='drucker-prager', E=2e7, nu=0.3, rho=2000, " + strength + "}", "grid.max=[10, 10]",
                 "grid.cells=[" + cells + ", " + cells + "]",
                 "support=[{face='bottom'}, {face='left', kind='roller'}]"});
}
const std::string stands = "c=4e4, phi=20, ";  // up to 11 m [Taylor 1937]
const std::string associated = "psi=20, cone='mean'", non_associated = "psi=0";

struct Solved {
  std::unique_ptr<LagrangianPhase> phase;
  std::vector<double> u;
  StaticReport report;
};
Solved solve(const Scene& scene, const NewtonOptions& options = {}, double t = 0) {
  auto phase = make_phase(scene);
  std::vector<double> u(phase->size(), 0.0);
  auto report = newton(*phase, t, u, options);
  return {std::move(phase), std::move(u), std::move(report)};
}

double distance(const std::vector<double>& a, ConstVec b) { return largest_difference(a, b) / largest_magnitude(b); }

/// p of |r_k+1| ~ |r_k|^p, from the last three residuals above rounding.
double observed_order(std::vector<double> r) {
  constexpr double rounding = 1e-13;
  while (r.size() > 3 && r.back() < rounding) r.pop_back();
  const std::size_t k = r.size() - 3;
  REQUIRE(r[k] < 0.2);
  return std::log(r[k + 2] / r[k + 1]) / std::log(r[k + 1] / r[k]);
}

std::string shown(const StaticReport& report) {
  std::string text = report.reason;
  for (const auto& step : report.load_steps) {
    text += "\n  s = " + std::to_string(step.from) + " to " + std::to_string(step.to) + ":";
    for (const double r : step.residuals) {
      char number[32];
      std::snprintf(number, sizeof number, " %.3e", r);
      text += number;
    }
  }
  return text + "\n  cholesky " + std::to_string(report.cholesky_factorisations) + ", lu " +
         std::to_string(report.lu_factorisations) + ", elastic " + std::to_string(report.elastic_iterations) +
         ", forces " + std::to_string(report.force_evaluations) + ", products " +
         std::to_string(report.tangent_products) + ", bytes " + std::to_string(report.factor_bytes) + ", " +
         std::to_string(report.wall_s) + " s";
}

const std::vector<std::string> large_strain = {"neo-hookean", "hencky"};

}  // namespace

// --- elastic --------------------------------------------------------------------------------------

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

// --- plastic --------------------------------------------------------------------------------------

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

// --- failure --------------------------------------------------------------------------------------

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

// --- conjugate gradients --------------------------------------------------------------------------

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

TEST_CASE("conjugate gradients alone solve the linear column within 1/2 sqrt(kappa) ln(2/eps) products") {
  const auto phase = make_phase(column());
  std::vector<double> u(phase->size(), 0.0);
  const StaticReport report = conjugate_gradients(*phase, 0, u, {.tolerance = 1e-8});
  INFO(shown(report));
  CHECK(report.converged);
  CHECK(report.residual <= 1e-8);
  CHECK(report.tangent_products == report.iterations);
  CHECK(distance(u, statics::solution(*phase)) < 1e-7);
  // ‖e‖_K falls by ε in so many; ‖Q‖_M⁻¹ by √κ less
  const std::vector<double> at_rest(u.size(), 0.0);
  const double root_kappa = omega_max_by_arpack(*phase, 0, at_rest).omega / omega_1_by_arpack(*phase, 0, at_rest).omega;
  CHECK(report.iterations < 0.5 * root_kappa * std::log(2 * root_kappa / 1e-8));
}

TEST_CASE("conjugate gradients alone report a system that is not linear, and one that is not definite") {
  const auto phase = make_phase(soft_column("neo-hookean"));
  std::vector<double> u(phase->size(), 0.0);
  const StaticReport nonlinear = conjugate_gradients(*phase, 0, u, {.max_iterations = 100});
  CHECK_FALSE(nonlinear.converged);
  CHECK_THAT(nonlinear.reason, Contains("residual"));
  test::Chain chain({.n = 3, .cubic = -1, .load = 1});
  std::vector<double> e = {1, 2, 3};
  const StaticReport indefinite = conjugate_gradients(chain, 0, e);
  CHECK_FALSE(indefinite.converged);
  CHECK_THAT(indefinite.reason, Contains("positive definite"));
}

TEST_CASE("Newton's method with conjugate gradients inside finds the same answer without a factor, with order 2") {
  for (const auto& law : large_strain) {
    const Solved direct = solve(soft_column(law)), s = solve(soft_column(law), {.solver = LinearSolver::iterative});
    CAPTURE(law);
    INFO(shown(s.report));
    CHECK(s.report.converged);
    CHECK(s.report.factor_bytes == 0);
    CHECK(s.report.tangent_products > 20);
    CHECK(distance(s.u, direct.u) < 1e-8);
    CHECK(observed_order(s.report.load_steps.back().residuals) > 1.8);
  }
}

TEST_CASE(
    "where flow is not associated Newton's method goes by GMRES to the answer of UMFPACK, by laws and by a matrix") {
  const Solved direct = solve(cut(stands + non_associated));
  CHECK(direct.report.lu_factorisations > 0);
  const bool assembles = GENERATE(false, true);
  const Solved s = solve(cut(stands + non_associated), {.solver = LinearSolver::iterative, .assembles = assembles});
  INFO(shown(s.report));
  CHECK(s.report.converged);
  CHECK(s.report.factor_bytes == 0);
  CHECK(s.report.elastic_iterations == 0);  // the consistent tangent was of use
  CHECK(distance(s.u, direct.u) < 1e-6);
}

TEST_CASE("where the consistent tangent is of no use, conjugate gradients take the elastic one, and no factor") {
  const Solved direct = solve(cut(stands + associated));
  const Solved s = solve(cut(stands + associated), {.max_iterations = 200, .solver = LinearSolver::iterative});
  INFO(shown(s.report));
  CHECK(s.report.converged);
  CHECK(s.report.factor_bytes == 0);
  CHECK(distance(s.u, direct.u) < 1e-4);
}
