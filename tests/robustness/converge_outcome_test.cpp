// How a convergence study ends: what it refuses, what it writes, and how it goes on after an interruption.
#include <stillpoint/converge.hpp>
#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "child.hpp"
#include "convergence_studies.hpp"
#include "files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using scenes::with;
namespace fs = std::filesystem;

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
  const std::vector<std::string> csv = lines(folder.path() / "one" / "converge.csv");
  CHECK(csv.at(0) ==
        "level,h,points,step,evaluations,wall_s,u_l2,u_max,u_energy,stress_l2,stress_read_l2,third.u,third.stress,size,"
        "status");
  CHECK(std::ranges::count_if(csv, [](const std::string& line) { return line.ends_with(",equilibrium"); }) == 3);
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
  const std::vector<std::string> csv = lines(out / "converge.csv");
  REQUIRE(csv.size() == 13);
  CHECK(csv[0].starts_with("grid.basis,grid.cells,level,h,points"));
  CHECK(csv[1].starts_with("linear,[8],1,0.125,"));
  CHECK(csv[12].starts_with("cubic,[12],3,"));

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
