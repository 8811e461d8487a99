// What a convergence study finds, of problems whose orders are known, and what it refuses.
#include <stillpoint/converge.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <catch2/catch.hpp>

#include "child.hpp"
#include "files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::Child;
using stillpoint::test::contents;
using stillpoint::test::json_of;
using stillpoint::testing::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

ConvergenceStudy study_of(const std::string& problem, const std::vector<std::string>& overrides,
                          const ConvergeOptions& options) {
  return converge(fs::path(STILLPOINT_PROBLEMS) / (problem + ".toml"), overrides, options);
}

const StudiedQuantity& quantity(const ConvergenceStudy& study, const std::string& name) {
  const auto found = std::ranges::find(study.quantities, name, &StudiedQuantity::name);
  REQUIRE(found != study.quantities.end());
  REQUIRE(found->order);
  return *found;
}

bool says(const ConvergenceStudy& study, const std::string& part) {
  return std::ranges::any_of(study.notes,
                             [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

// The bar swings freely.
const std::vector<std::string> swinging = {"damping.strategy=none", "stop.residual=0", "stop.time=3",
                                           "integrator.step_fraction=0.2"};

std::vector<std::string> with(std::vector<std::string> set, const std::vector<std::string>& more) {
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

}  // namespace

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
    double degree;
  };
  for (const auto& [problem, basis, degree] :
       {Case{"cylinder", "linear", 1}, Case{"cylinder", "quadratic", 2}, Case{"column", "linear", 1},
        Case{"ladder/mms_square", "linear", 1}, Case{"ladder/mms_square", "quadratic", 2}}) {
    const bool is_linear_elastic = std::string(problem) != "ladder/mms_square";
    std::vector<std::string> set = {std::string("grid.basis=") + basis, "grid.cells=[8, 8]"};
    if (is_linear_elastic) set = with(set, {"grid.cells=[4, 2]", "solve.method=newton", "damping={}"});
    const ConvergenceStudy study = study_of(problem, set, {.levels = 4, .finds_dominant = false});
    CAPTURE(problem, basis);
    CHECK(quantity(study, "stress_l2").theory == degree);
    CAPTURE(quantity(study, "stress_l2").errors);
    CHECK(quantity(study, "stress_l2").order->order == Approx(degree).margin(0.25));
    if (is_linear_elastic) {
      CAPTURE(quantity(study, "u_energy").errors);
      CHECK(quantity(study, "u_energy").order->order == Approx(degree).margin(0.25));
    } else {
      CHECK(says(study, "u_energy is not reported: it is of linear elasticity, and rubber is neo-hookean"));
    }
  }
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
  std::string text = contents(STILLPOINT_PROBLEMS "/mms_bar.toml");
  const std::size_t begin = text.find("[exact]");
  const fs::path file = folder.write("bar.toml", text.erase(begin, text.find("[[probe]]") - begin));
  const std::vector<std::string> set = {"grid.cells=8", "stop.residual=1e-11",
                                        "probe=[{name='end', at=1.0, fields=['stress']}]"};
  const ConvergenceStudy study = converge(file, set, {.levels = 5, .finds_dominant = false});
  CHECK(study.reference == "Richardson's extrapolation of the probes");
  CHECK(says(study, "expected [exact]"));
  const StudiedQuantity& end = quantity(study, "end.stress");
  REQUIRE(end.extrapolated);
  // Fitted to the points around with the order of the cubic basis' stress; E u'(1) = 4 cos 2.
  CHECK(end.order->order == Approx(3).margin(0.2));
  CHECK(*end.extrapolated == Approx(4 * std::cos(2.0)).epsilon(1e-6));
  CHECK(std::abs(end.errors.back()) < std::abs(end.errors.front()) / 10);
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

TEST_CASE("a study says of an order below the basis' that it is, and why") {
  const ConvergenceStudy study =
      study_of("mms_bar", {"grid.cells=32", "grid.basis=cubic", "stop.residual=1e-4"}, {.levels = 4});
  CHECK(says(study, "below the 4 of smooth solutions: the error of the relaxation's stop is larger"));
}

TEST_CASE("what a scene does not have cannot be refined, and a level that fails is left out by name") {
  const auto refusal = [](const std::string& problem, const std::vector<std::string>& set, Refinement what) {
    try {
      study_of(problem, set, {.refine = {what}, .levels = 2});
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  CHECK_THAT(refusal("bar", {}, Refinement::rtol), Catch::Contains("expected integrator.rtol"));
  CHECK_THAT(refusal("bar", {}, Refinement::motion), Catch::Contains("expected phase.max_motion"));
  CHECK_THAT(refusal("hard/points_from_a_file", {}, Refinement::points), Catch::Contains("points of a file"));
  CHECK_THAT(refusal("bar", {"solve.method=newton", "damping={}", "integrator={}"}, Refinement::step),
             Catch::Contains("takes no steps in time"));

  const ConvergenceStudy study = study_of("mms_bar", {"stop.steps=4500"}, {.levels = 4, .finds_dominant = false});
  CHECK(study.levels.back().status == RunStatus::step_limit);
  CHECK(says(study, "level 4 is left out, it ended as step-limit"));
  CHECK(std::isnan(quantity(study, "u_l2").errors.back()));
  CHECK(quantity(study, "u_l2").order->last == 2);
  CHECK(std::isfinite(quantity(study, "third.stress").errors.front()));
  CHECK(quantity(study, "third.stress").order->last == 2);
}

TEST_CASE(
    "converge writes a row a level and the orders, the same for any number of threads, and its status is the worst") {
  const TemporaryFolder folder;
  const auto run = [&](const char* name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"converge", STILLPOINT_PROBLEMS "/mms_bar.toml", "--levels", "3", "--quiet",
                                          "--out",    (folder.path() / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Child(arguments).wait();
  };
  CHECK(run("one", {"--threads", "1"}) == 0);
  CHECK(run("two", {"--threads", "2"}) == 0);
  std::istringstream csv(contents(folder.path() / "one" / "converge.csv"));
  std::string header, line;
  std::getline(csv, header);
  CHECK(header ==
        "level,h,points,step,evaluations,wall_s,u_l2,u_max,u_energy,stress_l2,third.u,third.stress,size,status");
  int rows = 0;
  while (std::getline(csv, line)) rows += line.ends_with(",equilibrium") ? 1 : 0;
  CHECK(rows == 3);
  const auto one = json_of(folder.path() / "one" / "converge.json"),
             two = json_of(folder.path() / "two" / "converge.json");
  CHECK(one["orders"] == two["orders"]);
  CHECK(one["quantities"] == two["quantities"]);
  CHECK(one["orders"]["u_l2"]["theory"] == 4);
  CHECK(one["dominant"].is_string());
  CHECK(run("short", {"--set", "stop.steps=1500"}) == 3);
  CHECK(run("bad", {"--refine", "motion"}) == 2);
  CHECK_FALSE(fs::exists(folder.path() / "bad"));
}
