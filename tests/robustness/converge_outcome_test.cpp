// What a convergence study finds, of problems whose orders are known, and what it refuses.
#include <stillpoint/converge.hpp>
#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
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
using stillpoint::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

ConvergenceStudy study_of(const std::string& problem, const std::vector<std::string>& overrides,
                          const ConvergeOptions& options) {
  return converge(scenes::load(problem, overrides), options);
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

// The problem, though nobody knows its solution.
fs::path without_exact(const std::string& problem, const TemporaryFolder& folder) {
  std::string text = contents(fs::path(STILLPOINT_PROBLEMS) / (problem + ".toml"));
  const std::size_t begin = text.find("[exact]"), end = text.find("[[probe]]", begin);
  return folder.write(problem + ".toml", text.erase(begin, end == std::string::npos ? end : end - begin));
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
  const fs::path file = without_exact("mms_bar", folder);
  const std::vector<std::string> set = {"grid.cells=8", "stop.residual=1e-11",
                                        "probe=[{name='end', at=1.0, fields=['stress']}]"};
  const ConvergenceStudy study = converge(load_scene(file, set), {.levels = 5, .finds_dominant = false});
  CHECK(study.reference == "the finest level, and Richardson's extrapolation of the probes");
  CHECK(says(study, "expected [exact]"));
  const StudiedQuantity& end = quantity(study, "end.stress");
  REQUIRE(end.extrapolated);
  // Fitted to the points around with the order of the cubic basis' stress; E u'(1) = 4 cos 2.
  CHECK(end.order->order == Approx(3).margin(0.2));
  CHECK(*end.extrapolated == Approx(4 * std::cos(2.0)).epsilon(1e-6));
  CHECK(std::abs(end.errors.back()) < std::abs(end.errors.front()) / 10);
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
    CHECK(stress.order->order >= degree - 0.3);  // fitted to the points around, linear elements' is better
    CHECK(stress.order->order <= degree + 1);
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

TEST_CASE("a level that is no scene is refused with the key of the scene's file that made it so") {
  const auto study = [] { converge(scenes::load("block"), {.levels = 4, .ratio = 100, .finds_dominant = false}); };
  CHECK_THROWS_WITH(study(),
                    Catch::Contains("block.toml:14:9: grid.cells: ") && Catch::Contains("cells are more than"));
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

TEST_CASE("varied values are series of one study, each as if it were alone, and one that a scene refuses stops all") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "converge",  STILLPOINT_PROBLEMS "/mms_bar.toml", "--levels", "3", "--quiet", "--no-sources", "--out",
        out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Child(arguments, {}, (folder.path() / "messages").string()).wait();
  };
  CHECK(run({"--vary", "grid.basis=linear,cubic", "--vary", "grid.cells=[8],[12]"}) == 0);
  const auto json = json_of(out / "converge.json");
  CHECK(json["varied"] == std::vector<std::string>{"grid.basis", "grid.cells"});
  REQUIRE(json["series"].size() == 4);
  CHECK(json["series"][3]["set"] == std::vector<std::string>{"grid.basis=cubic", "grid.cells=[12]"});
  CHECK(json["series"][0]["orders"]["u_l2"]["theory"] == 2);
  CHECK(json["series"][2]["orders"]["u_l2"]["theory"] == 4);
  const ConvergenceStudy alone =
      study_of("mms_bar", {"grid.basis=cubic", "grid.cells=[12]"}, {.levels = 3, .finds_dominant = false});
  CHECK(json["series"][3]["orders"]["u_l2"]["order"] == quantity(alone, "u_l2").order->order);
  std::istringstream csv(contents(out / "converge.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  REQUIRE(lines.size() == 13);
  CHECK(lines[0].starts_with("grid.basis,grid.cells,level,h,points"));
  CHECK(lines[1].starts_with("linear,[8],1,0.125,"));
  CHECK(lines[12].starts_with("cubic,[12],3,"));

  fs::remove_all(out);
  const auto refusal = [&](const std::vector<std::string>& vary) {
    CHECK(run(vary) == 2);
    CHECK_FALSE(fs::exists(out));
    const std::string messages = contents(folder.path() / "messages");
    CHECK(std::ranges::count(messages, '\n') == 1);
    return messages;
  };
  CHECK_THAT(refusal({"--vary", "grid.basis=linear,cubik"}), Catch::Contains("unknown value 'cubik'"));
  // Only the scene that is set up shows it.
  CHECK_THAT(refusal({"--vary", "probe=[{name='p', point=1, fields=['u']}],[{name='p', point=1000, fields=['u']}]",
                      "--set", "body.max=0.97"}),
             Catch::Contains("there is no material point 1000"));
  CHECK_THAT(refusal({"--vary", "grid.basis"}), Catch::Contains("expected a key and two values or more"));
  CHECK_THAT(refusal({"--vary", "grid.basis=linear,linear"}), Catch::Contains("stands there twice"));
  CHECK_THAT(refusal({"--vary", "grid.cells=8,16", "--vary", "grid.cells=4,5"}), Catch::Contains("varied already"));
}

TEST_CASE("a study that is interrupted keeps its finished runs, and goes on to the numbers of an unbroken one") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out", file = without_exact("mms_bar", folder);
  const std::vector<std::string> set = {"grid.cells=8"};  // u and stress at places are kept, too
  int runs = 0;
  ConvergeOptions options{.levels = 4, .threads = 1};
  const ConvergenceStudy unbroken = converge(load_scene(file, set), options);
  options.keep = out;
  options.progress = [&](const StudyProgress&) { ++runs; };
  options.interrupted = [&] { return runs >= 2; };
  const ConvergenceStudy broken = converge(load_scene(file, set), options);
  CHECK(broken.interrupted);
  CHECK(broken.finished_runs == 2);
  CHECK(broken.levels[3].status == RunStatus::equilibrium);
  CHECK(broken.levels[2].status == RunStatus::equilibrium);
  CHECK(broken.levels[0].status == RunStatus::interrupted);

  options.interrupted = {};
  options.resumes = true;
  ConvergenceStudy resumed = converge(load_scene(file, set), options);
  CHECK_FALSE(resumed.interrupted);
  CHECK(resumed.levels[3].wall_s == broken.levels[3].wall_s);  // it was not run once more
  REQUIRE(resumed.quantities.size() == unbroken.quantities.size());
  for (std::size_t q = 0; q < resumed.quantities.size(); ++q) {
    CAPTURE(resumed.quantities[q].name);
    const std::vector<double>&a = resumed.quantities[q].values, &b = unbroken.quantities[q].values;
    CHECK(std::equal(a.begin(), a.end(), b.begin(), b.end(),
                     [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); }));
  }
  REQUIRE(resumed.sources.size() == unbroken.sources.size());
  CHECK(resumed.sources.front().change == unbroken.sources.front().change);

  const auto refusal = [&](const fs::path& scene, const std::vector<std::string>& given) {
    try {
      converge(load_scene(scene, given), options);
    } catch (const StateError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  CHECK_THAT(refusal(file, with(set, {"grid.basis=linear"})), Catch::Contains("is a run with another list of --set"));
  CHECK_THAT(refusal(folder.write("other.toml", contents(file) + "# a word\n"), set),
             Catch::Contains("is a run with another scene text"));
  options.ratio = 3;
  CHECK_THAT(refusal(file, set), Catch::Contains("refined in another way"));
  options.ratio = 2;
  folder.write("out/level-2.json", "{\"of\": 1");
  CHECK_THAT(refusal(file, set), Catch::Contains("level-2.json: is damaged"));
  options.resumes = false;
  CHECK(converge(load_scene(file, set), options).finished_runs == unbroken.runs);
}

TEST_CASE("Ctrl-C ends a study with status 3 and the rows of its finished levels, which are on the disk before") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  // The second level takes minutes.
  const std::string messages = (folder.path() / "messages").string();
  Child child({"converge",
               "--quiet",
               STILLPOINT_PROBLEMS "/mms_bar.toml",
               "--levels",
               "2",
               "--threads",
               "2",
               "--no-sources",
               "--refine",
               "step",
               "--ratio",
               "100",
               "--set",
               "grid.cells=200",
               "--set",
               "integrator.step_fraction=0.1",
               "--set",
               "stop.steps=1000000000",
               "--out",
               out.string()},
              {}, messages);
  REQUIRE(child.wait_until([&] { return fs::exists(out / "runs" / "level-1.json"); }));
  child.send(SIGINT);
  CHECK(child.wait() == 3);
  const std::string csv = contents(out / "converge.csv");
  CHECK_THAT(csv, Catch::Contains("\n1,") && Catch::Contains(",equilibrium\n2,") && Catch::EndsWith(",interrupted\n"));
  CHECK(json_of(out / "converge.json")["notes"].back() == "interrupted by the user before all runs were done");
  CHECK_FALSE(fs::exists(out / "runs" / "level-2.json"));
  CHECK_THAT(contents(messages),
             Catch::Contains("1 of 2 runs were finished and are kept in " + (out / "runs").string()));
}
