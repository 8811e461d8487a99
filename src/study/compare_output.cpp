#include <stillpoint/compare.hpp>

#include <cmath>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "base/json.hpp"
#include "output/report/report_page.hpp"
#include "study/csv_text.hpp"

namespace stillpoint {
namespace {

std::string cell(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{:.17g}", *value) : "";
}

std::string csv(const Comparison& c) {
  std::string text =
      "strategy,integrator,step_fraction,rtol,status,steps,evaluations,first_evaluations,over_lower_bound,wall_s,"
      "wall_least_s,wall_most_s,setup_s,error,residual,distance,overshoot,memory_bytes,reason,total_s,mass\n";
  for (const ComparedRun& run : c.runs) {
    const auto& wall = run.wall_s;
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{:.6g},{},{},{},{},{},{},{},{}\n", run.strategy, run.integrator,
        cell(run.step_fraction), cell(run.rtol), to_string(run.status), run.steps, run.evaluations,
        run.first_evaluations, cell(c.over_chebyshev_estimate(run)),
        cell(wall ? std::optional(wall->median) : std::nullopt), cell(wall ? std::optional(wall->least) : std::nullopt),
        cell(wall ? std::optional(wall->most) : std::nullopt), run.setup_s, cell(run.error), cell(run.residual),
        cell(run.distance), cell(run.overshoot), run.memory_bytes, quoted(run.reason), cell(run.total_s()), run.mass);
  }
  return text;
}

Json json(const Comparison& c) {
  Json runs = Json::array();
  for (const ComparedRun& run : c.runs) {
    Json samples = Json::array();
    for (const ComparedSample& sample : run.samples) {
      samples.push_back({sample.evaluations, number(sample.error), number(sample.residual), number(sample.distance)});
    }
    Json wall = nullptr;
    if (run.wall_s) wall = {{"median", run.wall_s->median}, {"least", run.wall_s->least}, {"most", run.wall_s->most}};
    Json parts = Json::object();
    for (const auto& [part, seconds] : run.setup_parts) parts[part] = number(seconds);
    runs.push_back({{"label", run.label()},
                    {"strategy", run.strategy},
                    {"integrator", run.integrator},
                    {"mass", run.mass},
                    {"step_fraction", number(run.step_fraction)},
                    {"rtol", number(run.rtol)},
                    {"status", to_string(run.status)},
                    {"reason", run.reason},
                    {"steps", run.steps},
                    {"evaluations", run.evaluations},
                    {"first_evaluations", run.first_evaluations},
                    {"estimating", run.estimating},
                    {"over_lower_bound", number(c.over_chebyshev_estimate(run))},
                    {"setup_s", number(run.setup_s)},
                    {"setup_parts_s", parts},
                    {"wall_s", wall},
                    {"total_s", number(run.total_s())},
                    {"error", number(run.error)},
                    {"residual", number(run.residual)},
                    {"distance", number(run.distance)},
                    {"overshoot", number(run.overshoot)},
                    {"memory_bytes", run.memory_bytes},
                    {"samples", samples}});
  }
  return {{"scene", c.scene},
          {"title", c.title},
          {"dofs", c.dofs},
          {"points", c.points},
          {"threads", c.threads},
          {"chooses_threads", c.chooses_threads},
          {"transient", c.transient},
          {"goal", c.goal},
          {"goal_of", c.by_residual ? "residual" : "error"},
          {"omega_1", number(c.omega_1)},
          {"omega_max", number(c.omega_max)},
          {"kappa", number(c.kappa)},
          {"lower_bound", number(c.chebyshev_estimate)},
          {"reference", c.reference},
          {"reference_residual", number(c.reference_residual)},
          {"ramp_difference", number(c.ramp_difference)},
          {"sample", {"evaluations", "error", "residual", "distance"}},
          {"wall_s", c.wall_s},
          {"timed_s", c.timed_s},
          {"runs", runs},
          {"notes", c.notes},
          {"versions", versions_of_libraries()}};
}

}  // namespace

std::string to_json(const Comparison& comparison) { return file_text(json(comparison)); }

void write_comparison(const Comparison& comparison, const std::filesystem::path& folder) {
  write_file(folder / "compare.csv", csv(comparison));
  const Json whole = json(comparison);
  write_file(folder / "compare.json", file_text(whole));
  const std::string page = report_page(comparison.title.empty() ? comparison.scene : comparison.title,
                                       {{"kind", "compare"},
                                        {"comparison", whole},
                                        {"scene", {{"text", comparison.scene_text}, {"set", comparison.overrides}}}});
  write_file(folder / report_name, page);
}

}  // namespace stillpoint
