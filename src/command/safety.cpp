// stillpoint safety: the factor of safety by strength reduction, as a bracket with its reasons.
#include <stillpoint/safety.hpp>

#include <algorithm>

#include <fmt/format.h>

#include "command/commands.hpp"
#include "command/study_output.hpp"
#include "command/terminal.hpp"

namespace stillpoint::command {
namespace {

void print_table(const SafetyStudy& study) {
  fmt::print("{}\n\n  {:>9}{:>12}{:>15}{:>14}{:>11}\n", study.title.empty() ? study.scene : study.title, "factor",
             "verdict", "displacement", "evaluations", "time");
  std::vector<SafetyTrial> trials = study.trials;
  std::ranges::sort(trials, {}, &SafetyTrial::factor);
  const auto rests = [](const SafetyTrial& trial) { return trial.verdict == SafetyVerdict::rests; };
  for (const SafetyTrial& trial : trials)
    fmt::print("  {:>9.4f}{:>12}{:>13} m{:>14}{:>9.2f} s\n", trial.factor, to_string(trial.verdict),
               fmt::format("{}{:.3e}", rests(trial) ? "" : "> ", trial.displacement), trial.evaluations, trial.wall_s);
  if (!std::ranges::all_of(trials, rests)) fmt::print("  >: when the motion was followed no further\n");
  for (const SafetyTrial& trial : trials) {
    const bool is_end = trial.factor == study.factor_low || trial.factor == study.factor_high;
    if (is_end || trial.verdict == SafetyVerdict::undecided)
      fmt::print("  {:.4f} {}: {}\n", trial.factor, to_string(trial.verdict), trial.reason);
  }
  for (const std::string& note : study.notes) fmt::print("  note: {}\n", note);
  if (study.factor_low && study.factor_high) {
    fmt::print("\n  factor of safety between {:.4f}, at rest, and {:.4f}, moving{}\n", *study.factor_low,
               *study.factor_high, study.is_found() ? "" : ", wider than was asked");
  } else if (study.factor_low) {
    fmt::print("\n  at rest up to {:.4f}; no factor that moves was found\n", *study.factor_low);
  }
}

}  // namespace

int safety(const SafetyArguments& arguments) {
  const std::filesystem::path out =
      arguments.out.empty() ? std::filesystem::path("out") / (arguments.scene.file.stem().string() + "-safety")
                            : arguments.out;
  const OutputFolder folder(out);
  watch_for_interrupt();
  CountLine line;
  SafetyOptions options = arguments.options;
  options.interrupted = interrupted;
  if (!arguments.quiet) options.progress = [&line](const StudyProgress& progress) { line.show(progress); };
  const SafetyStudy study = stillpoint::safety(load_scene(arguments.scene.file, arguments.scene.overrides), options);
  line.finish();
  write_safety(study, out);
  if (!arguments.quiet) {
    print_table(study);
    fmt::print("  written: {}\n", out.string());
  }
  return study.is_found() ? 0 : 3;
}

}  // namespace stillpoint::command
