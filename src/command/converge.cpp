// stillpoint converge: one scene on successively finer levels, its errors and their orders.
#include <stillpoint/converge.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command/commands.hpp"
#include "command/study_output.hpp"
#include "command/terminal.hpp"

namespace stillpoint::command {
namespace {

std::string error_text(double value) { return std::isfinite(value) ? fmt::format("{:.2e}", value) : "-"; }

std::string order_of(const StudiedQuantity& quantity) {
  if (!quantity.order) return "-";
  const ObservedOrder& order = *quantity.order;
  std::string text = fmt::format("{:.2f}", order.order);
  if (std::isfinite(order.low)) text += fmt::format(" ({:.2f} to {:.2f})", order.low, order.high);
  if (quantity.theory) text += fmt::format(", theory {:g}", *quantity.theory);
  return text;
}

void print_table(const ConvergenceStudy& study) {
  std::vector<std::string> names;
  for (const Refinement refinement : study.refined) names.push_back(to_string(refinement));
  fmt::print("{}{}{}\n  refined: {}; errors against {}\n\n", study.title.empty() ? study.scene : study.title,
             study.varied.empty() ? "" : ", ", fmt::join(study.varied, ", "), fmt::join(names, ", "),
             study.reference.empty() ? "nothing" : study.reference);
  fmt::print("  {:>5}{:>11}{:>9}{:>12}{:>10}", "level", names.front(), "points", "evaluations", "time");
  for (const StudiedQuantity& quantity : study.quantities)
    fmt::print("{:>{}}", quantity.name, std::max<std::size_t>(11, quantity.name.size() + 2));
  fmt::print("\n");
  for (std::size_t k = 0; k < study.levels.size(); ++k) {
    const ConvergenceLevel& level = study.levels[k];
    fmt::print("  {:>5}{:>11.3g}{:>9}{:>12}{:>8.2f} s", k + 1, level.size, level.points, level.evaluations,
               level.wall_s);
    for (const StudiedQuantity& quantity : study.quantities)
      fmt::print("{:>{}}", error_text(quantity.errors[k]), std::max<std::size_t>(11, quantity.name.size() + 2));
    fmt::print("\n");
  }
  fmt::print("\n");
  for (const StudiedQuantity& quantity : study.quantities) {
    fmt::print("  order of {:<16} {}{}\n", quantity.name, order_of(quantity),
               quantity.extrapolated ? fmt::format(", extrapolated {:.9g}", *quantity.extrapolated) : "");
  }
  if (!study.sources.empty()) {
    std::vector<std::string> sources;
    for (const ErrorSource& source : study.sources)
      sources.push_back(fmt::format("{} {:.1e}", source.name, source.change));
    fmt::print("  largest error     {} (how far {} moves if each alone is refined: {})\n", study.sources.front().name,
               study.source_quantity, fmt::join(sources, ", "));
  }
  for (const std::string& note : study.notes) fmt::print("  note: {}\n", note);
}

// The scene for each series.
std::vector<VariedScene> varied_scenes(const ConvergeArguments& arguments) {
  std::vector<VariedScene> scenes;
  for (const std::vector<std::string>& varied : settings_of_series(arguments.vary)) {
    std::vector<std::string> overrides = arguments.scene.overrides;
    overrides.insert(overrides.end(), varied.begin(), varied.end());
    scenes.push_back({load_scene(arguments.scene.file, overrides), varied});
  }
  return scenes;
}

void tell_of_interrupt(const std::vector<ConvergenceStudy>& series, const std::filesystem::path& kept) {
  std::size_t runs = 0, finished = 0;
  for (const ConvergenceStudy& study : series) runs += study.runs, finished += study.finished_runs;
  if (std::ranges::none_of(series, &ConvergenceStudy::interrupted)) return;
  fmt::print(stderr,
             "interrupted: {} of {} runs were finished and are kept in {}; the same command with --resume goes on\n",
             finished, runs, kept.string());
}

}  // namespace

int converge(const ConvergeArguments& arguments) {
  const std::filesystem::path out =
      arguments.out.empty() ? std::filesystem::path("out") / (arguments.scene.file.stem().string() + "-converge")
                            : arguments.out;
  const OutputFolder folder(out);
  watch_for_interrupt();
  CountLine line;
  ConvergeOptions options = arguments.options;
  options.refine.clear();
  for (const std::string& name : arguments.refine) options.refine.push_back(*refinement_of(name));
  options.interrupted = interrupted;
  if (!arguments.quiet) options.progress = [&line](const StudyProgress& progress) { line.show(progress); };
  options.keep = out / "runs";
  const std::vector<ConvergenceStudy> series = converge_varied(varied_scenes(arguments), options);
  line.finish();
  write_studies(series, out);
  if (!arguments.quiet) {
    for (const ConvergenceStudy& study : series) {
      print_table(study);
      fmt::print("\n");
    }
    fmt::print("  written: {}\n", out.string());
  }
  tell_of_interrupt(series, options.keep);
  int status = 0;  // the worst status of the levels
  for (const ConvergenceStudy& study : series) {
    if (study.interrupted) status = std::max(status, 3);
    for (const ConvergenceLevel& level : study.levels)
      status = std::max(status, level.exit_status == 2 ? 4 : level.exit_status);
  }
  return status;
}

}  // namespace stillpoint::command
