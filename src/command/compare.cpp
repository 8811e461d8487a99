// stillpoint compare: integrators × damping strategies on one scene, speed against error.
#include <stillpoint/compare.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "base/text.hpp"
#include "command/commands.hpp"
#include "command/study_output.hpp"
#include "command/terminal.hpp"

namespace stillpoint::command {
namespace {

std::string seconds(double s) {
  return s < 1e-3 ? fmt::format("{:.0f} us", 1e6 * s)
         : s < 1  ? fmt::format("{:.2f} ms", 1e3 * s)
                  : fmt::format("{:.2f} s", s);
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();
std::string small(double value) { return std::isnan(value) ? "-" : fmt::format("{:.1e}", value); }

// The rows in the order in which a user would choose: runs that converged first, the fastest at the top.
std::vector<const ComparedRun*> ranked(const Comparison& c) {
  std::vector<const ComparedRun*> rows;
  for (const ComparedRun& run : c.runs) rows.push_back(&run);
  std::ranges::stable_sort(rows, {}, [&](const ComparedRun* run) {
    const double cost = run->wall_s ? run->wall_s->median : 1e9;
    return std::tuple(run->status, c.transient ? -static_cast<double>(run->evaluations) : cost);
  });
  return rows;
}

void print_heading(const Comparison& c) {
  fmt::print("{}\n", c.title.empty() ? c.scene : c.title);
  fmt::print("  {} degrees of freedom, {} points, {} for the times{}\n", c.dofs, c.points,
             counted(static_cast<std::size_t>(c.threads), "thread"),
             c.chooses_threads ? ", or one where that is quicker" : "");
  fmt::print("  reference: {}\n", c.reference);
  if (c.chebyshev_estimate) {
    fmt::print("  kappa {:.4g}; Chebyshev estimate for an error of {:g}: {:.0f} evaluations\n", *c.kappa, c.goal,
               *c.chebyshev_estimate);
  }
  if (c.ramp_difference) {
    fmt::print("  one load step of Newton's method differs from a slow ramp by {:.2e}\n", *c.ramp_difference);
  }
}

void print_table(const Comparison& c) {
  print_heading(c);
  const bool overshoot = std::ranges::any_of(c.runs, [](const ComparedRun& run) { return run.overshoot.has_value(); });
  std::size_t width = 0;
  for (const ComparedRun& run : c.runs) width = std::max(width, run.label().size());
  fmt::print("\n  {:<{}}{:>12}{:>13}{:>12}{:>11}{:>11}{:>8}{:>11}{:>11}{:>11}{}\n", "", width, "status", "evaluations",
             "x estimate", "set-up", "time", "+-", "error", "residual", "distance", overshoot ? "  overshoot" : "");
  for (const ComparedRun* run : ranked(c)) {
    const bool converged = run->status == ComparedStatus::converged;
    const auto ratio = c.over_chebyshev_estimate(*run);
    const Spread wall = run->wall_s.value_or(Spread{});
    fmt::print("  {:<{}}{:>12}{:>13}{:>12}{:>11}{:>11}{:>8}{:>11}{:>11}{:>11}", run->label(), width,
               to_string(run->status), run->evaluations, ratio && converged ? fmt::format("{:.2f}", *ratio) : "-",
               run->setup_s > 0 ? seconds(run->setup_s) : "-", run->wall_s ? seconds(wall.median) : "-",
               wall.median > 0 ? fmt::format("{:.0f} %", 50 * (wall.most - wall.least) / wall.median) : "-",
               small(run->error), small(run->residual), small(run->distance.value_or(none)));
    if (overshoot) fmt::print("{:>11}", small(run->overshoot.value_or(none)));
    fmt::print("\n");
  }
  for (const ComparedRun& run : c.runs) {
    if (run.status != ComparedStatus::converged) fmt::print("  {}: {}\n", run.label(), run.reason);
  }
  for (const std::string& note : c.notes) fmt::print("  note: {}\n", note);
  fmt::print("  {} in all, {} of it timed runs\n", seconds(c.wall_s), seconds(c.timed_s));
}

}  // namespace

int compare(const CompareArguments& arguments) {
  const std::filesystem::path out =
      arguments.out.empty() ? std::filesystem::path("out") / (arguments.scene.file.stem().string() + "-compare")
                            : arguments.out;
  const OutputFolder folder(out);
  watch_for_interrupt();
  CountLine line;
  CompareOptions options = arguments.options;
  options.interrupted = interrupted;
  if (!arguments.quiet) options.progress = [&line](const StudyProgress& progress) { line.show(progress); };
  const Comparison comparison =
      stillpoint::compare(load_scene(arguments.scene.file, arguments.scene.overrides), options);
  line.finish();
  write_comparison(comparison, out);
  if (!arguments.quiet) {
    print_table(comparison);
    fmt::print("  written: {}\n", out.string());
  }
  return interrupted() ? 3 : 0;
}

}  // namespace stillpoint::command
