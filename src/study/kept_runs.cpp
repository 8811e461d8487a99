#include "study/kept_runs.hpp"

#include <stillpoint/state_archive.hpp>

#include <fstream>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "base/atomic_file.hpp"

namespace stillpoint {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// NaN is null in JSON; every other number is restored bit by bit.
double number_of(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}
std::vector<double> numbers_of(const Json& list) {
  std::vector<double> values;
  for (const Json& value : list) values.push_back(number_of(value));
  return values;
}

using Named = std::vector<std::pair<std::string, double>>;
Json list_of(const Named& values) {
  Json list = Json::array();
  for (const auto& [name, value] : values) list.push_back({name, number(value)});
  return list;
}
Named named_of(const Json& list) {
  Named values;
  for (const Json& pair : list) values.emplace_back(pair.at(0).get<std::string>(), number_of(pair.at(1)));
  return values;
}

Json json_of(const LevelRun& run) {
  const ConvergenceLevel& level = run.level;
  return {{"set", level.set},
          {"status", static_cast<int>(level.status)},
          {"reason", level.reason},
          {"step", number(level.step)},
          {"points", level.points},
          {"dofs", level.dofs},
          {"evaluations", level.evaluations},
          {"wall_s", number(level.wall_s)},
          {"floor", number(run.floor)},
          {"norms", list_of(run.norms)},
          {"no_energy", run.no_energy},
          {"probes", list_of(run.probes)},
          {"probe_errors", numbers(run.probe_errors)},
          {"u", numbers(run.u)},
          {"stress", numbers(run.stress)},
          {"volume", numbers(run.volume)},
          {"notes", run.notes}};
}

LevelRun run_of(const Json& json) {
  LevelRun run;
  run.is_there = true;
  run.level.set = json.at("set").get<std::vector<std::string>>();
  run.level.status = static_cast<RunStatus>(json.at("status").get<int>());
  run.level.exit_status = 0;
  run.level.reason = json.at("reason").get<std::string>();
  run.level.step = number_of(json.at("step"));
  run.level.points = json.at("points").get<std::size_t>();
  run.level.dofs = json.at("dofs").get<std::size_t>();
  run.level.evaluations = json.at("evaluations").get<long>();
  run.level.wall_s = number_of(json.at("wall_s"));
  run.floor = number_of(json.at("floor"));
  run.norms = named_of(json.at("norms"));
  run.no_energy = json.at("no_energy").get<std::string>();
  run.probes = named_of(json.at("probes"));
  run.probe_errors = numbers_of(json.at("probe_errors"));
  run.u = numbers_of(json.at("u"));
  run.stress = numbers_of(json.at("stress"));
  run.volume = numbers_of(json.at("volume"));
  run.notes = json.at("notes").get<std::vector<std::string>>();
  return run;
}

}  // namespace

KeptRuns::KeptRuns(std::filesystem::path folder, bool resumes, const Scene& scene)
    : folder_(std::move(folder)), resumes_(resumes) {
  Json files = Json::array();
  for (const BodySpec& body : scene.bodies) {
    if (body.file.empty()) continue;
    const std::string text = text_of(body.file);
    files.push_back(checksum(0, text.data(), text.size()));
  }
  scene_ = {{"version", versions_of_libraries().at("stillpoint")},
            {"scene text", scene.text},
            {"list of --set", scene.overrides},
            {"file of points", files}};
}

std::optional<LevelRun> KeptRuns::find(const std::string& name, const std::vector<std::string>& set) const {
  const std::filesystem::path file = file_of(name);
  if (folder_.empty() || !resumes_ || !std::filesystem::exists(file)) return std::nullopt;
  const auto refuse = [&](const std::string& why) -> StateError {
    return StateError(fmt::format("{}: {}; leave out --resume to begin afresh", file.string(), why));
  };
  try {
    const Json json = Json::parse(text_of(file));
    for (const auto& [what, value] : scene_.items())
      if (json.at("of").at(what) != value)
        throw refuse(fmt::format("is a run with another {}; expected that of this study", what));
    LevelRun run = run_of(json.at("run"));
    if (run.level.set != set) throw refuse("is a run that was refined in another way; expected that of this study");
    return run;
  } catch (const Json::exception&) {
    throw refuse("is damaged, or no run of a study");
  }
}

void KeptRuns::begin(const std::string& name) const {
  if (!folder_.empty() && !resumes_) std::filesystem::remove(file_of(name));
}

void KeptRuns::keep(const std::string& name, const LevelRun& run) const {
  if (folder_.empty() || !run.is_there) return;
  const Json whole = {{"of", scene_}, {"run", json_of(run)}};
  write_file(file_of(name), whole.dump() + "\n");
}

}  // namespace stillpoint
