// The files of a study have its figures to the last bit, and nothing where there is none.
#include <stillpoint/compare.hpp>
#include <stillpoint/converge.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "study/csv_text.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

constexpr double no_figure = std::numeric_limits<double>::quiet_NaN();

/// Two levels, the second of which failed.
ConvergenceStudy study_of(const std::string& basis) {
  ConvergenceStudy study;
  study.scene = "bar";
  study.varied = {"grid.basis=" + basis, "probe=[1,2]"};
  study.refined = {Refinement::h};
  study.levels.resize(2);
  study.levels[0].status = RunStatus::equilibrium;
  study.levels[0].size = study.levels[0].h = 1.0 / 3;
  study.levels[1].status = RunStatus::failed;
  study.levels[1].reason = "out of \"memory\"";
  study.quantities = {{.name = "u_l2", .values = {0.1, no_figure}, .errors = {0.1, no_figure}}};
  study.quantities[0].order = ObservedOrder{.order = 2, .last = 1};
  study.quantities[0].theory = 2;
  return study;
}

}  // namespace

TEST_CASE("text in a field of a CSV file is quoted, and the quotes in it doubled") {
  CHECK(quoted("a, b") == "\"a, b\"");
  CHECK(quoted("say \"no\"") == "\"say \"\"no\"\"\"");
  CHECK(quoted("") == "\"\"");
}

TEST_CASE("converge.csv has a row a level of each series, with the varied values before it and no field for a NaN") {
  const TemporaryFolder folder;
  ConvergenceStudy cubic = study_of("cubic");
  cubic.quantities.push_back({.name = "tip.u", .values = {5, 6}, .errors = {no_figure, no_figure}});
  write_studies({study_of("linear"), cubic}, folder.path());
  const std::vector<std::string> csv = lines(folder.path() / "converge.csv");
  REQUIRE(csv.size() == 5);
  CHECK(csv[0] ==
        "grid.basis,probe,level,h,points,step,evaluations,wall_s,u_l2,u_max,u_energy,stress_l2,stress_read_l2,tip.u,"
        "size,status");
  CHECK(csv[1] ==
        "linear,\"[1,2]\",1,0.33333333333333331,0,0,0,0,0.10000000000000001,,,,,,0.33333333333333331,equilibrium");
  CHECK(csv[4] == "cubic,\"[1,2]\",2,0,0,0,0,0,,,,,,6,0,failed");
}

TEST_CASE("converge.json has null for what is no number, orders with their levels from 1, and a list of series") {
  const TemporaryFolder folder;
  write_study(study_of("linear"), folder.path());
  const Json series = json_of(folder.path() / "converge.json");
  CHECK(series["varied"] == std::vector<std::string>{"grid.basis", "probe"});
  const Json& one = series["series"].at(0);
  CHECK(one["set"] == std::vector<std::string>{"grid.basis=linear", "probe=[1,2]"});
  CHECK(one["levels"][0]["h"].get<double>() == 1.0 / 3);
  CHECK(one["levels"][1]["reason"] == "out of \"memory\"");
  CHECK(one["quantities"]["u_l2"]["values"][0].get<double>() == 0.1);
  CHECK(one["quantities"]["u_l2"]["values"][1].is_null());
  CHECK(one["orders"]["u_l2"]["levels"] == std::vector<int>{1, 2});
  CHECK(one["orders"]["u_l2"]["low"].is_null());
  CHECK(one["dominant"].is_null());
  ConvergenceStudy alone = study_of("linear");
  alone.varied.clear();
  alone.sources = {{"space", 0.5}, {"time", no_figure}};
  write_study(alone, folder.path());
  const Json study = json_of(folder.path() / "converge.json");
  CHECK_FALSE(study.contains("series"));
  CHECK(study["dominant"] == "space");
  CHECK(study["sources"][1]["change"].is_null());
}

TEST_CASE("compare.csv and compare.json have each figure of a row, and none for one that a run does not have") {
  const TemporaryFolder folder;
  Comparison comparison;
  comparison.chebyshev_estimate = 4;
  comparison.runs.resize(2);
  ComparedRun& first = comparison.runs[0];
  first.strategy = "viscous", first.integrator = "leapfrog", first.step_fraction = 0.1;
  first.status = ComparedStatus::converged;
  first.evaluations = 6;
  first.wall_s = Spread{.median = 2, .least = 1, .most = 3};
  first.setup_s = 0.5;
  first.error = 1.0 / 3;
  first.samples = {{.evaluations = 1, .error = 1, .residual = no_figure, .distance = {}}};
  comparison.runs[1].strategy = "newton";
  comparison.runs[1].reason = "because, \"so\"";
  write_comparison(comparison, folder.path());
  const std::vector<std::string> csv = lines(folder.path() / "compare.csv");
  REQUIRE(csv.size() == 3);
  CHECK(csv[1] ==
        "viscous,leapfrog,0.10000000000000001,,converged,0,6,0,1.5,2,1,3,0.5,0.33333333333333331,,,,0,\"\",2.5,");
  CHECK(csv[2] == "newton,,,,refused,0,0,0,,,,,0,,,,,0,\"because, \"\"so\"\"\",,");
  const Json json = json_of(folder.path() / "compare.json");
  CHECK(json["runs"][0]["total_s"] == 2.5);
  CHECK(json["runs"][0]["error"].get<double>() == 1.0 / 3);
  CHECK(json["runs"][0]["samples"][0][2].is_null());
  CHECK(json["runs"][0]["samples"][0][3].is_null());
  CHECK(json["runs"][1]["wall_s"].is_null());
  CHECK(json["runs"][1]["error"].is_null());
  CHECK(json["omega_1"].is_null());
}
