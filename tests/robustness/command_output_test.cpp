// What the command prints: lists, descriptions of a model, frequencies, the end of a run, and help.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "broken_scene.hpp"
#include "command_run.hpp"
#include "files.hpp"
#include "plan/catalogue.hpp"
#include "scene/input/read_scene.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;
using Words = std::vector<std::string>;

namespace {

std::string printed(const std::string& arguments, const std::string& scene = kGoodScene) {
  const CommandRun run(scene, arguments);
  CAPTURE(arguments, run.standard_error);
  CHECK(run.status == 0);
  CHECK(run.standard_error.empty());
  CHECK_FALSE(run.wrote);
  return run.output;
}

/// The first words of the lines that are indented by two spaces.
Words entries(const std::string& text) {
  Words found;
  for (const std::string& line : lines_of(text))
    if (line.starts_with("  ") && line.size() > 2 && line[2] != ' ')
      found.push_back(line.substr(2, line.find(' ', 2) - 2));
  return found;
}

template <class Rows>
Words names_of(const Rows& rows) {
  Words names;
  for (const auto& row : rows) names.emplace_back(row.name);
  return names;
}

/// The number behind `label` in a text.
double number_after(const std::string& label, const std::string& text) {
  const auto at = text.find(label);
  REQUIRE(at != std::string::npos);
  return std::stod(text.substr(at + label.size()));
}

const std::string bar_file = STILLPOINT_PROBLEMS "/bar.toml";

}  // namespace

TEST_CASE("list names what there is of each topic in the catalogue's order, and without a topic all of it") {
  Words dampings, relaxations, methods = names_of(catalogue().methods);
  for (const StrategyInfo& info : catalogue().strategies)
    (info.is_relaxation ? relaxations : dampings).emplace_back(info.name);
  methods.insert(methods.begin(), "name");  // the head of the table
  CHECK(entries(printed("list integrators")) == methods);
  CHECK(entries(printed("list dampings")) == dampings);
  CHECK(entries(printed("list relaxations")) == relaxations);
  CHECK(entries(printed("list solvers")) == names_of(catalogue().static_methods));
  CHECK(entries(printed("list materials")) == names_of(catalogue().laws));
  CHECK(entries(printed("list solutions")) == names_of(catalogue().solutions));
  CHECK(entries(printed("list bases")) == Words{"linear", "quadratic", "cubic", "hermite"});
  std::string all;
  for (const char* topic :
       {"integrators", "dampings", "relaxations", "solvers", "materials", "solutions", "bases", "keys"})
    all += printed(std::string("list ") + topic);
  CHECK(printed("list") == all);
}

TEST_CASE("list keys gives the reference in Markdown, and a schema that names the tables of a scene") {
  CHECK(printed("list keys --format markdown") == key_reference(catalogue()));
  const Json schema = parsed(printed("list keys --format schema"));
  for (const char* table : {"grid", "body", "material", "damping", "stop", "probe"})
    CHECK(schema["properties"].contains(table));
}

TEST_CASE(
    "check says the points, unknowns, frequency and step of the model that a run would have, and writes nothing") {
  const std::string said = printed("check " + bar_file);
  const Model model = make_model(scenes::bar());
  CHECK(lines_of(said).at(0) == scenes::bar().title);
  CHECK_THAT(said, Contains(fmt::format("  points           {}, mass 10 kg", model.phase->points())));
  CHECK_THAT(said, Contains(fmt::format("{} free, 1 supported; consistent mass", model.phase->size())));
  CHECK(number_after("  omega_max        ", said) == Approx(5.81539857).epsilon(1e-8));
  CHECK(number_after("the run takes ", said) == Approx(0.9 * *model.critical_step).epsilon(1e-5));
  CHECK_THAT(said, Contains("  damping          identity, c = 0.45: M a = Q - c v\n"));
}

TEST_CASE("check says how long cells are along an axis where they are unequal") {
  CHECK_THAT(printed("check " + bar_file), !Contains("cells along"));
  const std::string said = printed("check " STILLPOINT_PROBLEMS
                                   "/cylinder.toml --set \"grid.x=[[1, 1.7, 3, 4], [1.7, 2, 1]]\" "
                                   "--set \"grid.y=[[0, 0.25, 2]]\"");
  CHECK_THAT(said, Contains("4 x 2 cells") && Contains("  cells along x    0.1 to 0.4 m long\n"));
  CHECK_THAT(said, !Contains("cells along y"));
}

TEST_CASE("check sums the bytes of a point and the memory of a run to what it says of them together") {
  const std::vector<std::string> said = lines_of(printed("check " + bar_file));
  const auto sum_from = [&](const std::string& head) {
    double sum = 0;
    auto line = std::ranges::find_if(said, [&](const std::string& l) { return l.starts_with(head); });
    REQUIRE(line != said.end());
    for (++line; !line->starts_with("    together"); ++line)
      sum += std::stod(line->substr(line->find_first_of("0123456789.")));
    return std::pair(sum, std::stod(line->substr(line->find_first_of("0123456789."))));
  };
  const auto [of_point, point] = sum_from("  bytes a point");
  CHECK(of_point == Approx(point).margin(0.5));
  const auto [of_run, run] = sum_from("  memory, when a run takes most");
  CHECK(of_run == Approx(run).epsilon(0.01));
}

TEST_CASE("check says which rule chose what a scene leaves open, and nothing of what it asks for") {
  const std::string open = printed("check " STILLPOINT_PROBLEMS "/ladder/compaction.toml");
  CHECK_THAT(open, Contains("several: the points move on"));
  CHECK_THAT(open, Contains("  chosen           phase.quadrature = domains: "));
  CHECK_THAT(open, !Contains("  chosen           phase.max_motion"));
}

TEST_CASE("spectrum prints the bar's frequencies by each method, kappa and the critical damping") {
  const std::string said = printed("spectrum " + bar_file);
  for (const std::string row : {"omega_1   Lanczos", "omega_1   ARPACK"}) {
    const auto at = said.find(row);
    REQUIRE(at != std::string::npos);
    CHECK(std::stod(said.substr(at + 46)) == Approx(0.15707217).epsilon(1e-7));  // exact on this grid
  }
  CHECK(number_after("(omega_max/omega_1)^2 = ", said) == Approx(std::pow(5.81539857 / 0.15707217, 2)).epsilon(1e-6));
  CHECK(number_after("c = 2 omega_1 = ", said) == Approx(2 * 0.15707217).epsilon(1e-7));
  CHECK_THAT(
      printed("spectrum " + bar_file + " --set support=[] --set damping.strategy=viscous --set damping.c=critical"),
      Contains("critical steps   not known: c = \"critical\" needs omega_1"));
}

TEST_CASE("run prints its table of the end, quiet prints nothing, and both write into out/<scene> unless told") {
  const CommandRun run(kGoodScene, "run SCENE && test -f out/scene/summary.json");
  CHECK(run.status == 0);
  CHECK_THAT(run.output, Contains("  status            equilibrium: "));
  CHECK_THAT(run.output, Contains("  model             12 points, 4 degrees of freedom, 1 phase\n"));
  CHECK_THAT(run.output, Contains("  probe tip         u = "));
  CHECK_THAT(run.output, Contains("  written           out/scene\n"));
  const CommandRun quiet(kGoodScene, "run SCENE --quiet --threads auto && test -f out/scene/summary.json");
  CHECK(quiet.status == 0);
  CHECK(quiet.output.empty());
  CHECK(quiet.standard_error.empty());
}

TEST_CASE("a run that ends at a limit says so among the errors, quiet or not, with status 3") {
  for (const std::string quiet : {"", " --quiet"}) {
    const CommandRun run(kGoodScene, "run SCENE --set stop.steps=3" + quiet);
    CHECK(run.status == 3);
    CHECK_THAT(run.standard_error, Contains("stillpoint: ") && Contains("stop.steps"));
    CHECK(run.output.empty() == !quiet.empty());
  }
}

TEST_CASE(
    "help and the version are printed with status 0, and no subcommand gets the help among the errors, status 2") {
  CHECK_THAT(printed("--version"), Contains("."));
  const std::string help = printed("--help");
  for (const char* subcommand : {"run", "compare", "converge", "check", "spectrum", "list"}) {
    CHECK_THAT(help, Contains(std::string("\n  ") + subcommand + " "));
    CHECK_THAT(printed(std::string(subcommand) + " --help"), Contains("Usage: stillpoint " + std::string(subcommand)));
  }
  const CommandRun nothing(kGoodScene, "");
  CHECK(nothing.status == 2);
  CHECK(nothing.output.empty());
  CHECK(nothing.standard_error == help);
}

TEST_CASE("options of run that exclude each other, or numbers of threads that are none, are refused with status 2") {
  for (const std::string arguments :
       {"run", "run SCENE --resume OUT", "run --resume OUT --out OUT", "run --resume OUT --set damping.c=1",
        "run SCENE --threads 0", "run SCENE --threads 1025", "run SCENE --threads many", "run SCENE SCENE"}) {
    CAPTURE(arguments);
    const CommandRun run(kGoodScene, arguments);
    CHECK(run.status == 2);
    CHECK_FALSE(run.standard_error.empty());
    CHECK_FALSE(run.wrote);
  }
}
