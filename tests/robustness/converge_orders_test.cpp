// The orders that a convergence study finds, of problems whose orders are known.
#include <stillpoint/converge.hpp>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "convergence_studies.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using scenes::with;

TEST_CASE("a bar with a manufactured solution has the order of its basis in every norm") {
  struct Case {
    const char* basis;
    double degree, least;
  };
  for (const auto& [basis, degree, least] :
       {Case{"linear", 1, 1.9}, Case{"quadratic", 2, 2.9}, Case{"cubic", 3, 3.8}, Case{"hermite", 3, 3.8}}) {
    const ConvergenceStudy study = study_of(
        "mms_bar", {std::string("grid.basis=") + basis, "stop.residual=1e-11", "grid.cells=8", "mass.kind=consistent"},
        {.levels = 4, .finds_dominant = false});
    CAPTURE(basis);
    CHECK(study.reference == "the exact solution");
    for (const char* name : {"u_l2", "u_max"}) {
      const StudiedQuantity& found = quantity(study, name);
      CAPTURE(name, found.order->order, found.order->low, found.order->high);
      CHECK(found.theory == degree + 1);
      CHECK(found.order->order >= least);
      CHECK(found.order->order <= degree + 1.2);
    }
    for (const char* name : {"u_energy", "stress_l2"}) {
      CHECK(quantity(study, name).theory == degree);
      CHECK(quantity(study, name).order->order >= degree - 0.1);
    }
    const StudiedQuantity& read = quantity(study, "stress_read_l2");
    CAPTURE(read.errors, quantity(study, "stress_l2").errors);
    CHECK(read.theory == degree);
    CHECK(read.order->order >= degree - 0.2);
    CHECK(read.errors.back() <= 0.5 * quantity(study, "stress_l2").errors.back());
    // Judged by the exact u at the place itself, a third of the way along a cell or two on each level.
    CHECK(quantity(study, "third.u").theory == degree + 1);
    CHECK(quantity(study, "third.u").order->order >= least - 0.1);
    CHECK(study.levels.size() == 4);
    CHECK(study.levels.back().h == Approx(study.levels.front().h / 8));
  }
}

TEST_CASE("in the plane and around an axis stress and energy norm fall by the order of the basis") {
  struct Case {
    const char *problem, *basis;
    double degree, most;
  };
  // Quadratic elements are better than their order at two Gauss points a cell and axis: the cylinder's points.
  for (const auto& [problem, basis, degree, most] :
       {Case{"cylinder", "linear", 1, 1.1}, Case{"cylinder", "quadratic", 2, 3.1}, Case{"column", "linear", 1, 1.1},
        Case{"ladder/mms_square", "linear", 1, 1.1}, Case{"ladder/mms_square", "quadratic", 2, 2.1}}) {
    const bool is_linear_elastic = std::string(problem) != "ladder/mms_square";
    std::vector<std::string> set = {std::string("grid.basis=") + basis};
    if (is_linear_elastic) set = with(set, {"grid.cells=[4, 2]", "solve.method=newton"});
    const ConvergenceStudy study = study_of(problem, set, {.levels = 4, .finds_dominant = false});
    CAPTURE(problem, basis);
    std::vector<std::string> norms = {"stress_l2"};
    if (is_linear_elastic) norms.emplace_back("u_energy");
    for (const std::string& name : norms) {
      const StudiedQuantity& found = quantity(study, name);
      CAPTURE(name, found.errors);
      CHECK(found.theory == degree);
      CHECK(found.order->order >= degree - 0.1);
      CHECK(found.order->order <= most);
    }
    CHECK(says(study, "u_energy is not reported: it is of linear elasticity, and rubber is neo-hookean") !=
          is_linear_elastic);
  }
}

TEST_CASE("the energy norm is that of the inverse moduli: its error of a shear that is missing is d^2/mu") {
  // σ = (σ0, 0, ν σ0, 0) is found where (σ0, 0, ν σ0, d) is said: d²/μ of σ0² (1 − ν²)/E + d²/μ is missing.
  const double E = 1, nu = 0.3, stress = 1e-3, d = 2e-4, mu = E / (2 * (1 + nu));
  const std::string other = "material.aaa={law='linear-elastic', E=7.0, nu=0.1, rho=1.0}";  // of no body
  const ConvergenceStudy study = study_of("ladder/patch", {"exact.stress=['load', '0', 'nu*load', '2e-4']", other},
                                          {.levels = 2, .finds_dominant = false});
  const double missing = d * d / mu, whole = stress * stress * (1 - nu * nu) / E + missing;
  CHECK(quantity(study, "u_energy").errors[0] == Approx(std::sqrt(missing / whole)).epsilon(1e-10));
  // Components of the tensor: the shear counts twice.
  const double of_tensor = 2 * d * d / (stress * stress * (1 + nu * nu) + 2 * d * d);
  CHECK(quantity(study, "stress_l2").errors[0] == Approx(std::sqrt(of_tensor)).epsilon(1e-10));
}

TEST_CASE("steps in time are refined on the same points, against the finest level: leapfrog's order is 2, RK4's 4") {
  for (const auto& [method, order] : {std::pair{"leapfrog", 2.0}, std::pair{"erk:rk4", 4.0}}) {
    const ConvergenceStudy study = study_of("bar", with(swinging, {std::string("integrator.method=") + method}),
                                            {.refine = {Refinement::step}, .levels = 5, .finds_dominant = false});
    CAPTURE(method);
    CHECK(study.reference == "the finest level");
    for (const char* name : {"u_l2", "p12.u"}) {
      const StudiedQuantity& found = quantity(study, name);
      CAPTURE(name, found.order->order);
      CHECK(found.theory == order);
      CHECK(found.order->order == Approx(order).margin(0.3));
    }
    CHECK(std::isnan(quantity(study, "u_l2").errors.back()));
  }
}

TEST_CASE("without an exact solution probes are extrapolated: the stress at the end of a bar to the exact one") {
  const TemporaryFolder folder;
  const std::filesystem::path file = without_exact("mms_bar", folder);
  const std::vector<std::string> set = {"grid.cells=8", "stop.residual=1e-11",
                                        "probe=[{name='end', at=1.0, fields=['stress']}]"};
  const ConvergenceStudy study = converge(load_scene(file, set), {.levels = 5, .finds_dominant = false});
  CHECK(study.reference == "the finest level, and Richardson's extrapolation of single figures");
  CHECK(says(study, "expected [exact]"));
  const StudiedQuantity& end = quantity(study, "end.stress");
  REQUIRE(end.extrapolated);
  // Fitted to the points around with the order of the cubic basis' stress; E u'(1) = 4 cos 2.
  CHECK(end.order->order == Approx(3).margin(0.2));
  CHECK(*end.extrapolated == Approx(4 * std::cos(2.0)).epsilon(1e-6));
  CHECK(std::abs(end.errors.back()) < std::abs(end.errors.front()) / 10);
}

TEST_CASE("the factor of a driven load is studied without a probe of it: that of a footing comes down to Prandtl's") {
  const ConvergenceStudy study =
      study_of("footing_limit", {"grid.cells=[12, 8]"}, {.levels = 3, .finds_dominant = false});
  const StudiedQuantity& factor = quantity(study, "load.factor");
  REQUIRE(factor.values.size() == 3);
  constexpr double prandtl = 2 + std::numbers::pi;
  for (const double value : factor.values) CHECK(value > prandtl);
  REQUIRE(factor.extrapolated);
  CHECK(*factor.extrapolated == Approx(prandtl).epsilon(0.003));  // 3.5, 1.8 and 0.9 % above it
}

TEST_CASE("without an exact solution u and stress are compared at the same places: their orders are the basis' too") {
  struct Case {
    const char *problem, *basis;
    double degree;
  };
  const TemporaryFolder folder;
  // On a line linear elements are exact at the nodes, on which no place may lie.
  for (const auto& [problem, basis, degree] : {Case{"mms_bar", "linear", 1}, Case{"mms_bar", "quadratic", 2},
                                               Case{"cylinder", "linear", 1}, Case{"cylinder", "quadratic", 2}}) {
    const bool is_bar = std::string(problem) == "mms_bar";
    const std::vector<std::string> set = {std::string("grid.basis=") + basis, "solve.method=newton",
                                          is_bar ? "grid.cells=8" : "grid.cells=[4, 2]"};
    const ConvergeOptions options{.levels = 5, .finds_dominant = false};
    const ConvergenceStudy known = study_of(problem, set, options);
    const ConvergenceStudy study = converge(load_scene(without_exact(problem, folder), set), options);
    CAPTURE(problem, basis);
    CHECK(says(study, "expected [exact]"));
    const StudiedQuantity &u = quantity(study, "u_l2"), &stress = quantity(study, "stress_l2");
    CAPTURE(u.errors, stress.errors, quantity(known, "u_l2").errors);
    CHECK(u.theory == degree + 1);
    CHECK(u.order->order == Approx(degree + 1).margin(0.2));
    CHECK(std::isnan(u.errors.back()));
    // The finest level's own error, a 256th and less of the coarsest's, is missing; and the points stand elsewhere.
    CHECK(u.errors.front() == Approx(quantity(known, "u_l2").errors.front()).epsilon(0.3));
    CHECK(stress.theory == degree);
    CHECK(stress.order->order >= degree - 0.3);  // fitted to the points around it is better, up to an order
    CHECK(stress.order->order <= degree + 1.3);
  }
}

TEST_CASE("the largest error is named: space on few cells, the relaxation's stop where the residual is loose") {
  const auto dominant = [](const std::vector<std::string>& set) {
    const ConvergenceStudy study = study_of("mms_bar", set, {.levels = 3});
    REQUIRE_FALSE(study.sources.empty());
    return study.sources.front().name;
  };
  CHECK(dominant({"grid.cells=4", "grid.basis=quadratic", "stop.residual=1e-10"}) == "space");
  CHECK(dominant({"grid.cells=64", "stop.residual=1e-3"}) == "the relaxation's stop");
}

TEST_CASE(
    "a study fits no order to errors that are those of the relaxation's stop, and says which levels it leaves out") {
  const ConvergenceStudy study =
      study_of("mms_bar", {"grid.cells=32", "grid.basis=cubic", "stop.residual=1e-4"}, {.levels = 4});
  CHECK(says(study, "levels 1, 2, 3, 4 are left out of its order, as errors are no more than"));
}
