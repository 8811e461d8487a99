// stillpoint run: relaxes a scene and prints a short table.
#include <stillpoint/integrator.hpp>
#include <stillpoint/run.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_file.hpp"
#include "base/text.hpp"
#include "base/thread_team.hpp"
#include "command/command_line.hpp"
#include "command/commands.hpp"
#include "command/failure.hpp"
#include "command/launcher.hpp"
#include "command/terminal.hpp"
#include "output/checkpoint_file.hpp"
#include "parallel/of_all.hpp"
#include "parallel/start_ranks.hpp"
#include "plan/catalogue.hpp"

namespace stillpoint::command {
namespace {

std::string way_to_rest(const Summary& s) {
  if (const StaticMethodInfo* method = catalogue().static_method(s.method))
    return fmt::format("{}, static", method->name);
  const StrategyInfo& strategy = *catalogue().strategy(s.damping);
  const bool hosted = strategy.is_relaxation && find_method(s.integrator).hosts_relaxations;
  return hosted ? s.damping + ", an iteration of its own" : fmt::format("{}, {} damping", s.integrator, s.damping);
}

// The distance from equilibrium as text; empty if it is not known.
std::string distance_of(const Summary& s) {
  std::string said;
  if (s.distance) said = fmt::format("   distance from equilibrium {:.3e}", *s.distance);
  if (s.distance_kind == "estimate") said += ", an estimate";
  if (s.way_left && std::isfinite(*s.way_left)) said += fmt::format("   way left by its motion {:.1e}", *s.way_left);
  return said;
}

void print_table(const Summary& s, const std::filesystem::path& out) {
  const auto row = [](std::string_view what, const std::string& value) {
    fmt::print("{}", wrapped(fmt::format("  {:<17} ", what), value, width_of_terminal()));
  };
  fmt::print("{}\n", s.title.empty() ? s.scene : s.title);
  row("status", fmt::format("{}: {}", to_string(s.status), s.reason));
  row("model", fmt::format("{} points, {} degrees of freedom, {}", s.points, s.dofs,
                           counted(static_cast<std::size_t>(s.phases), "phase")));
  row("method", fmt::format("{}{}, step {:.4g} s", way_to_rest(s),
                            s.c ? fmt::format(", c = {:.6g}", *s.c) : std::string(), s.dt));
  row("frequencies", fmt::format("omega_1 {}, omega_max {:.6g}",
                                 s.omega_1 ? fmt::format("{:.6g}", *s.omega_1) : "not needed", s.omega_max));
  row("reached", fmt::format("t = {:.6g} s in {} steps, {} force evaluations", s.t, s.steps, s.rhs_evaluations));
  for (std::size_t k = 0; k < s.stages.size(); ++k) {
    const StageFigures& stage = s.stages[k];
    const bool is_claimed = stage.status != RunStatus::end_time;
    row(fmt::format("stage {}", k + 1),
        fmt::format("t = {:.6g} to {:.6g} s: {}, residual {:.3e}", stage.begin, stage.end,
                    is_claimed ? to_string(stage.status) : "ended before an equilibrium", stage.residual));
  }
  row("residual", fmt::format("{:.3e}   kinetic energy {:.3e} J{}", s.residual, s.kinetic_energy, distance_of(s)));
  if (s.error) {
    row("error (exact)",
        fmt::format("u {:.3e} (L2), {:.3e} (max){}", s.error->u_rel_l2, s.error->u_rel_max,
                    s.error->stress_rel_l2 ? fmt::format(", stress {:.3e} (L2)", *s.error->stress_rel_l2) : ""));
  }
  row("wall time", fmt::format("{:.4g} s, {:.1f} ns a point and step, {}{}", s.wall_s, s.ns_per_point_step,
                               s.ranks > 1 ? counted(static_cast<std::size_t>(s.ranks), "rank") + " of " : "",
                               counted(static_cast<std::size_t>(s.threads), "thread")));
  if (s.mass_error && s.momentum_error && s.added_mass) {
    const std::string turn =
        s.angular_momentum_error ? fmt::format(", angular momentum to {:.1e}", *s.angular_momentum_error) : "";
    row("conserved", fmt::format("mass to {:.1e}, momentum to {:.1e}{}; {:.1f} % inertia added at light nodes",
                                 *s.mass_error, *s.momentum_error, turn, 100 * *s.added_mass));
  }
  if (s.external_work) {
    const double work = *s.external_work;
    row("external work",
        fmt::format("{:.6g} J", work) +
            (work != 0 ? fmt::format("; kinetic energy is {:.1e} of it", s.kinetic_energy / std::abs(work)) : ""));
  }
  if (s.rate_share)
    row("rate",
        fmt::format("damping and inertia are {:.2g} % of what drives the body, on average", 100 * *s.rate_share));
  if (s.resting_points && s.held_force)
    row("at rest",
        fmt::format("{:.3g} % of the points, on average, held by up to {:.2g} % of the forces in the body; the "
                    "residual is that of what moves",
                    100 * *s.resting_points, 100 * *s.held_force));
  for (const auto& [name, fields] : s.probes) {
    std::string values;
    for (const auto& [field, value] : fields) values += fmt::format("{} = {:.9g}  ", field, value);
    const auto position = s.probe_positions.find(name);
    if (position != s.probe_positions.end()) values += fmt::format(" at x = {:.6g}", fmt::join(position->second, ", "));
    row((fields.front().first == "normal" ? "force on " : "probe ") + name, values);
  }
  if (s.load)
    row("load factor", fmt::format("{:.6g}, the largest {:.6g}, at a mean displacement of {:.4g} m", s.load->factor,
                                   s.load->largest_factor, s.load->displacement));
  for (const auto& [name, force] : s.reactions)
    row("reaction of " + name, fmt::format("({:.9g}) N on the body", fmt::join(force, ", ")));
  for (const auto& [name, moment] : s.reaction_moments)
    row("moment of " + name, fmt::format("({:.9g}) N m about the origin", fmt::join(moment, ", ")));
  std::map<std::string, std::string> contacts;
  for (const auto& [column, value] : s.contacts) {
    const std::size_t dot = column.rfind('.');
    contacts[column.substr(0, dot)] += fmt::format("{} = {:.9g}  ", column.substr(dot + 1), value);
  }
  for (const auto& [name, figures] : contacts) row("contact of " + name, figures);
  for (const SupportGap& weak : s.weak_supports) {
    row("weak " + weak.support,
        fmt::format("gives way by {:.3g} m at most, {:.2g} of the largest displacement", weak.gap, weak.share));
  }
  for (const std::string& note : s.notes) row("note", note);
  row("written", fmt::format("{}", out.string()));
}

std::filesystem::path checkpoint_of(const std::filesystem::path& folder_or_file) {
  if (!std::filesystem::exists(folder_or_file))
    throw StateError(fmt::format("--resume {}: there is no such folder", folder_or_file.string()));
  if (!std::filesystem::is_directory(folder_or_file)) return absolute(folder_or_file);  // whose folder has a name
  std::filesystem::path last = folder_or_file / "checkpoint.h5", previous = previous_checkpoint(last);
  if (std::filesystem::exists(last)) return last;
  if (std::filesystem::exists(previous)) return previous;
  throw StateError(
      fmt::format("--resume {}: there is no checkpoint.h5 in it to go on from; a run leaves one if its scene has "
                  "[checkpoint]",
                  folder_or_file.string()));
}

// Throws StateError on all ranks unless all of them have the same scene, from the same state, and are of one version.
void require_one_run(const Ranks& ranks, const Scene& scene, const std::filesystem::path& checkpoint) {
  std::string run = fmt::format("{}\n{}\n{}\n", STILLPOINT_VERSION, scene.text, fmt::join(scene.overrides, "\n"));
  if (!checkpoint.empty()) {
    std::array<char, 512> head{};  // with the checksum of what follows
    std::ifstream(checkpoint, std::ios::binary).read(head.data(), head.size());
    run.append(head.begin(), head.end());
  }
  const std::vector<std::uint64_t> all = of_all(&ranks, checksum(0, run.data(), run.size()));
  const auto other = std::ranges::find_if(all, [&](std::uint64_t one) { return one != all.front(); });
  if (other == all.end()) return;
  throw StateError(
      fmt::format("ranks 0 and {} have different scenes, --set or checkpoints, or other versions of the "
                  "program; expected the same on all machines",
                  other - all.begin()));
}

int run_scene(const RunArguments& arguments, const std::shared_ptr<const Ranks>& ranks) {
  const bool resumes = !arguments.resume.empty();
  const std::filesystem::path checkpoint = resumes ? checkpoint_of(arguments.resume) : std::filesystem::path();
  const Scene scene = resumes ? load_scene_of(checkpoint) : load_scene(arguments.scene.file, arguments.scene.overrides);
  if (ranks) require_one_run(*ranks, scene, checkpoint);
  const std::filesystem::path out = !arguments.out.empty() ? arguments.out
                                    : resumes              ? checkpoint.parent_path()
                                                           : std::filesystem::path("out") / scene.name;
  ProgressLine line;
  SimulationOptions options{
      .out = out, .resume = checkpoint, .threads = arguments.threads, .interrupted = interrupted, .ranks = ranks};
  if (!arguments.quiet) options.progress = [&line](const Progress& progress) { line.show(progress); };
  const Summary summary = stillpoint::run(scene, options);
  line.finish();
  if (!arguments.quiet) print_table(summary, out);
  if (summary.exit_status != 0 && (!ranks || ranks->rank() == 0))
    fmt::print(stderr, "stillpoint: {}: {}\n", to_string(summary.status), summary.reason);
  return summary.exit_status;
}

// One of the ranks of a run. All of them do the same; the first leaves the files, and says what there is to say.
int run_as_rank(RunArguments arguments, const std::shared_ptr<const Ranks>& ranks) {
  try {
    // What a launcher leaves free of a machine's cores is theirs in equal shares.
    if (arguments.threads == 0) arguments.threads = std::max(1, loop_threads() / ranks->on_this_machine());
    if (ranks->rank() > 0) arguments.quiet = true;
    return run_scene(arguments, ranks);
  } catch (...) {
    const auto [status, message] = failure_of_exception();
    if (ranks->fails_with_all(status, message)) fmt::print(stderr, "{}\n", message);
    return status;
  }
}

}  // namespace

int run(const RunArguments& arguments) {
  watch_for_interrupt();
  const Copies copies = launched_copies();
  if (copies.count == 1) return run_scene(arguments, nullptr);
  const char* const other = "a launcher of the MPI that this program is built with, Open MPI";
  if (!std::getenv("PMIX_RANK")) {  // by which Open MPI's launchers, and Slurm's for it, tell a copy its rank
    refuses(copies, other);
    return bad_input;
  }
  std::shared_ptr<const Ranks> ranks;
  try {
    ranks = start_ranks();
  } catch (const std::runtime_error& error) {
    refuses(copies, error.what());
    return bad_input;
  }
  if (ranks->count() != copies.count) {
    refuses(copies, other);
    return bad_input;
  }
  return run_as_rank(arguments, ranks);
}

}  // namespace stillpoint::command
