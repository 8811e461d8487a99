// The options of each command, and which of them are asked for.
#include "command/command_line.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/gpl.hpp"
#include "base/text.hpp"
#include "command/commands.hpp"
#include "command/launcher.hpp"

namespace stillpoint::command {
namespace {

// What CLI11 says of numbers that are not positive has 309 digits.
std::string positive(const std::string& text) {
  double value = 0;
  if (CLI::detail::lexical_cast(text, value) && value > 0) return {};
  return "expected a number above 0, found " + text;
}

CLI::Option& add_scene(CLI::App& app, SceneArguments& arguments) {
  CLI::Option& scene = *app.add_option("SCENE", arguments.file, "scene file (TOML)")->required();
  app.add_option("--set", arguments.overrides,
                 "change a key of the scene, e.g. --set damping.c=0.45 (a bare word is a string)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return scene;
}

CLI::App& add_compare(CLI::App& app, CompareArguments& arguments) {
  CLI::App& compare = *app.add_subcommand("compare", "integrators x damping strategies: speed against error");
  CompareOptions& options = arguments.options;
  add_scene(compare, arguments.scene);
  compare.add_option("--out", arguments.out, "folder to write into (default: out/<scene>-compare)")->type_name("DIR");
  compare
      .add_option("--strategies", options.strategies,
                  "of damping, and static solvers; with ':multigrid' behind a name for that mass (default: all)")
      ->delimiter(',')
      ->type_name("NAME,...");
  compare
      .add_option(
          "--integrators", options.integrators,
          "with ':adaptive' behind a name for adaptive steps (default: leapfrog, and some with viscous damping)")
      ->delimiter(',')
      ->type_name("NAME,...");
  compare.add_option("--fractions", options.step_fractions, "of the critical step (default: 0.9)")
      ->delimiter(',')
      ->check(positive)
      ->type_name("X,...");
  compare.add_option("--tolerances", options.tolerances, "rtol of adaptive steps (default: 1e-3)")
      ->delimiter(',')
      ->check(positive)
      ->type_name("X,...");
  compare.add_option("--goal", options.goal, "relative error to reach (default: 1e-6)")->check(CLI::Range(1e-15, 0.5));
  compare.add_option("--limit", options.limit, "evaluations at most, in Chebyshev estimates (default: 50)")
      ->check(positive);
  compare.add_option("--seconds", options.seconds, "wall time at most of one run (default: 30)")->check(positive);
  compare.add_option("--repeats", options.repeats, "timed runs of each (default: 3)")->check(CLI::Range(0, 1000));
  compare.add_option("--seed", options.seed, "of the order in which runs are timed");
  compare
      .add_option("--threads", options.threads,
                  "threads to use (default: all, or for the times one where a run finds that quicker)")
      ->check(CLI::Range(1, 1024));
  compare.add_flag("--overshoot", options.overshoot, "also how far each ends from a slow ramp of the load");
  compare.add_flag("--quiet", arguments.quiet, "print nothing but errors");
  return compare;
}

CLI::App& add_converge(CLI::App& app, ConvergeArguments& arguments) {
  CLI::App& converge = *app.add_subcommand("converge", "error on ever finer levels, with observed orders");
  ConvergeOptions& options = arguments.options;
  add_scene(converge, arguments.scene);
  converge.add_option("--out", arguments.out, "folder to write into (default: out/<scene>-converge)")->type_name("DIR");
  converge.add_option("--refine", arguments.refine, "what becomes finer: h, points, step, rtol, motion (default: h)")
      ->delimiter(',')
      ->check(CLI::IsMember({"h", "points", "step", "rtol", "motion"}))
      ->type_name("NAME,...");
  converge
      .add_option(
          "--vary", arguments.vary,
          "a series of levels for each value of a key, e.g. --vary grid.basis=linear,quadratic; of two keys for "
          "each pair")
      ->type_name("KEY=VALUE,...")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  converge.add_option("--levels", options.levels, "levels (default: 4)")->check(CLI::Range(2, 20));
  converge.add_option("--ratio", options.ratio, "of sizes from level to level (default: 2)")
      ->check(CLI::Range(1.1, 100.0));
  converge.add_option("--threads", options.threads, "levels side by side (default: all)")->check(CLI::Range(1, 1024));
  converge.add_flag("--resume", options.resumes,
                    "take the finished runs that are kept in the folder; run only the others");
  converge.add_flag("!--no-sources", options.finds_dominant, "do not look for the largest error");
  converge.add_flag("--quiet", arguments.quiet, "print nothing but errors");
  return converge;
}

CLI::App& add_safety(CLI::App& app, SafetyArguments& arguments) {
  CLI::App& safety = *app.add_subcommand("safety", "factor of safety by strength reduction, as a bracket");
  SafetyOptions& options = arguments.options;
  add_scene(safety, arguments.scene);
  safety.add_option("--out", arguments.out, "folder to write into (default: out/<scene>-safety)")->type_name("DIR");
  safety.add_option("--from", options.from, "first factor, with which the body rests (default: 1)")->check(positive);
  safety.add_option("--to", options.to, "largest factor to try (default: 3)")->check(positive);
  safety.add_option("--width", options.width, "of the bracket (default: 0.01)")->check(positive);
  safety.add_option("--threads", options.threads, "threads to use (default: all)")->check(CLI::Range(1, 1024));
  safety.add_flag("--quiet", arguments.quiet, "print nothing but errors");
  return safety;
}

CLI::App& add_plot(CLI::App& app, PlotArguments& arguments) {
  CLI::App& plot = *app.add_subcommand("plot", "draw what the folder of a run or a study holds");
  plot.add_option("KIND", arguments.kind, "history or fields of runs; compare or converge, of a study of that name")
      ->check(CLI::IsMember({"history", "fields", "compare", "converge"}))
      ->required();
  plot.add_option("DIR", arguments.folders, "folders of runs, side by side, or that of a study")->required();
  plot.add_option("--out", arguments.out, "picture to write: png, pdf, svg, ... (default: DIR/<kind>.png)")
      ->type_name("FILE");
  plot.add_option("--field", arguments.field,
                  "of fields: plastic_strain, stress_xy, u, u_x, layers, ... (default: plastic_strain, or u)")
      ->type_name("NAME");
  plot.add_option("--cut", arguments.cuts, "of fields in space: take away what lies before x=VALUE, y= or z=")
      ->type_name("AXIS=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  plot.add_option("--stages", arguments.stages, "of fields: so many at most (default: 6, or 3 of each of several runs)")
      ->check(CLI::Range(1, 1000));
  plot.add_flag("--show", arguments.shows, "open a window with it as well");
  return plot;
}

// A check for the number of threads: the word "auto" becomes 0.
std::string number_or_auto(std::string& text) {
  constexpr std::string_view all_or_one = "auto";
  if (text != all_or_one) return CLI::Range(1, 1024)(text);
  text = "0";
  return {};
}

// CLI11 says of a misspelt command no more than that arguments were not expected.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return std::ranges::find(names, argv[1]) == names.end() ? unknown_word("unknown command", argv[1], names) : "";
}

}  // namespace

int dispatch(int argc, char** argv) {
  CLI::App app("Quasi-static equilibrium by dynamic relaxation in the material point method", "stillpoint");
  app.set_version_flag("--version", STILLPOINT_VERSION + std::string(missing_without_gpl()));

  RunArguments run_arguments;
  CLI::App& run_app = *app.add_subcommand("run", "relax a scene; writes summary.json and history.csv");
  CLI::Option& scene = add_scene(run_app, run_arguments.scene);
  CLI::Option& out =
      *run_app.add_option("--out", run_arguments.out, "folder to write into (default: out/<scene>)")->type_name("DIR");
  CLI::Option& resume = *run_app
                             .add_option("--resume", run_arguments.resume,
                                         "go on with a run that was ended, from the checkpoint in its folder")
                             ->type_name("DIR");
  scene.required(false);
  resume.excludes(&out)->excludes(run_app.get_option("--set"));
  run_app
      .add_option(
          "--threads", run_arguments.threads,
          "at most so many threads, and one where that is quicker; auto, the default: all that there are, or one")
      ->transform(CLI::Validator(number_or_auto, ""))
      ->type_name("N|auto");
  run_app.add_flag("--quiet", run_arguments.quiet, "print nothing but errors");

  CompareArguments compare_arguments;
  CLI::App& compare_app = add_compare(app, compare_arguments);

  ConvergeArguments converge_arguments;
  CLI::App& converge_app = add_converge(app, converge_arguments);

  SafetyArguments safety_arguments;
  CLI::App& safety_app = add_safety(app, safety_arguments);

  SceneArguments scene_arguments;
  CLI::App& check_app = *app.add_subcommand("check", "say what would be modelled; nothing runs");
  add_scene(check_app, scene_arguments);
  CLI::App& spectrum_app =
      *app.add_subcommand("spectrum", "frequencies, critical damping and critical steps of a scene");
  add_scene(spectrum_app, scene_arguments);

  PlotArguments plot_arguments;
  CLI::App& plot_app = add_plot(app, plot_arguments);

  std::string topic;
  CLI::App& list_app = *app.add_subcommand("list", "what there is to choose from");
  list_app
      .add_option("TOPIC", topic,
                  "integrators, dampings, relaxations, solvers, materials, solutions, bases or keys (default: all)")
      ->check(CLI::IsMember(
          {"integrators", "dampings", "relaxations", "solvers", "materials", "solutions", "bases", "keys"}));
  std::string format = "text";
  list_app.add_option("--format", format, "of keys: text, markdown or schema (a JSON schema for editors)")
      ->check(CLI::IsMember({"text", "markdown", "schema"}));

  if (const std::string wrong = unknown_command(app, argc, argv); !wrong.empty()) {
    fmt::print(stderr, "{}\n", wrong);
    return bad_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  }
  if (app.get_subcommands().empty()) {  // checked here, so that a misspelt subcommand is reported by its name
    fmt::print(stderr, "{}", app.help());
    return bad_input;
  }
  if (run_app.parsed() && run_arguments.scene.file.empty() && run_arguments.resume.empty()) {
    fmt::print(stderr, "run: expected a SCENE, or --resume DIR\n");
    return bad_input;
  }
  if (run_app.parsed() && !run_arguments.scene.file.empty() && !run_arguments.resume.empty()) {
    fmt::print(stderr, "run: --resume {} goes on with the scene of that folder; leave out {}\n",
               run_arguments.resume.string(), run_arguments.scene.file.string());
    return bad_input;
  }
  const bool is_study = compare_app.parsed() || converge_app.parsed() || safety_app.parsed();
  if (is_study && refuses(launched_copies(), "one copy, whose --threads take the cores of one machine"))
    return bad_input;
  if (run_app.parsed()) return run(run_arguments);
  if (compare_app.parsed()) return compare(compare_arguments);
  if (converge_app.parsed()) return converge(converge_arguments);
  if (safety_app.parsed()) {
    if (const std::string wrong = safety_arguments.options.validate(); !wrong.empty()) {
      fmt::print(stderr, "--{}\n", wrong);
      return bad_input;
    }
    return safety(safety_arguments);
  }
  if (check_app.parsed()) return check(scene_arguments);
  if (spectrum_app.parsed()) return spectrum(scene_arguments);
  if (plot_app.parsed()) return plot(plot_arguments);
  if (format != "text" && topic != "keys") {
    fmt::print(stderr, "--format {}: goes with the topic keys only\n", format);
    return bad_input;
  }
  return list(topic, format);
}

}  // namespace stillpoint::command
