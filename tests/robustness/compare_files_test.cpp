// The files of a comparison, and the times in them.
#include <stillpoint/compare.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparisons.hpp"
#include "files.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

TEST_CASE("a comparison's files are whole: a line and an object a run, and null where there is no figure",
          "[compare]") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "new" / "out";
  const Comparison c = compared("bar", {.strategies = {"viscous", "newton"}, .repeats = 2}, crushed);
  write_comparison(c, out);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    ++files;
    CHECK(entry.path().extension() != ".partial");
  }
  CHECK(files == 3);

  const std::vector<std::string> csv = lines(out / "compare.csv");
  REQUIRE(csv.size() == 1 + c.runs.size());
  const auto commas = [](const std::string& line) { return std::ranges::count(line, ','); };
  CHECK(csv[0].starts_with("strategy,integrator,step_fraction,rtol,status,steps,evaluations,"));
  CHECK(commas(csv[2]) == commas(csv[0]));
  CHECK(csv[1].starts_with("viscous,leapfrog,0.9"));

  const auto json = json_of(out / "compare.json");
  CHECK(json["scene"] == "bar");
  CHECK(json["goal_of"] == "error");
  CHECK(json["kappa"].get<double>() == *c.kappa);
  REQUIRE(json["runs"].size() == 2);
  const auto& newton = json["runs"][1];
  CHECK(newton["label"] == "newton");
  CHECK(newton["status"] == "converged");
  CHECK(newton["evaluations"] == row(c, "newton").evaluations);
  CHECK(newton["wall_s"]["least"] <= newton["wall_s"]["median"]);
  CHECK(newton["wall_s"]["median"] <= newton["wall_s"]["most"]);
  CHECK(newton["step_fraction"].is_null());
  CHECK(newton["total_s"].get<double>() >= newton["wall_s"]["median"].get<double>());
  const auto& viscous = json["runs"][0];
  CHECK(viscous["status"] == "diverged");
  CHECK(viscous["wall_s"].is_null());
  CHECK(viscous["total_s"].is_null());
  CHECK(viscous["samples"].size() == row(c, "viscous 0.9").samples.size());
  CHECK(viscous["samples"][0].size() == json["sample"].size());
}

TEST_CASE("a row has the time that its own set-up would take, whoever made its parts, by part and in total",
          "[compare]") {
  const TemporaryFolder folder;
  const Comparison c = compared("column", {.strategies = {"viscous", "kinetic", "newton"}, .repeats = 1});
  for (const ComparedRun& run : c.runs) {
    CAPTURE(run.label());
    double parts = 0;
    for (const auto& [part, seconds] : run.setup_parts) {
      CHECK(seconds > 0);
      parts += seconds;
    }
    CHECK(parts > 0);
    CHECK(run.setup_s >= parts);
    CHECK(run.total_s().value() == run.setup_s + run.wall_s->median);
  }
  const auto omega_1 = [&](const char* label) {
    for (const auto& [part, seconds] : row(c, label).setup_parts)
      if (part == "omega_1") return seconds;
    throw std::out_of_range("no omega_1");
  };
  CHECK(omega_1("viscous 0.9") == omega_1("kinetic 0.9"));  // made once
  CHECK(c.timed_s > 0);
  CHECK(c.wall_s > c.timed_s);
  write_comparison(c, folder.path());
  const auto json = json_of(folder.path() / "compare.json");
  CHECK(json["runs"][0]["setup_parts_s"]["omega_1"].get<double>() == omega_1("viscous 0.9"));
  CHECK(lines(folder.path() / "compare.csv").at(0).ends_with(",total_s,mass"));
}

TEST_CASE("a row that was refused has no error in the files, not one of 0", "[compare]") {
  const TemporaryFolder folder;
  const Comparison c =
      compared("block_on_wall", {.strategies = {"cg"}, .repeats = 0}, {"stop.residual=1e-6", "stop.time=0"});
  write_comparison(c, folder.path());
  const auto json = json_of(folder.path() / "compare.json");
  CHECK(json["runs"][0]["error"].is_null());
  CHECK(json["runs"][0]["residual"].is_null());
  CHECK_THAT(contents(folder.path() / "compare.csv"), !Contains("nan"));
}
