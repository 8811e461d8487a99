#include "scene/stages.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace stillpoint {
namespace {

using Names = std::vector<std::string>;

bool is_among(const Names& names, const std::string& name) {
  return !name.empty() && std::ranges::find(names, name) != names.end();
}

template <class Part>
Names names_of(const std::vector<Part>& parts) {
  Names names;
  for (const Part& part : parts)
    if (!part.name.empty()) names.push_back(part.name);
  return names;
}

// The entry of an array of tables under which a part stood, and that under which it stands now.
struct Renamed {
  std::string from, to;
};

// Lets the locations of all keys below the entries follow; those of other entries of these tables go.
void rename(Locations& where, const Names& tables, const std::vector<Renamed>& entries) {
  Locations renamed;
  for (const auto& written : where) {
    const std::string& key = written.first;
    const auto is_below = [&key](const std::string& entry) {
      return key.starts_with(entry) &&
             (key.size() == entry.size() || key[entry.size()] == '.' || key[entry.size()] == '[');
    };
    const auto entry = std::ranges::find_if(entries, is_below, &Renamed::from);
    if (entry != entries.end()) {
      renamed[entry->to + key.substr(entry->from.size())] = written.second;
    } else if (std::ranges::none_of(tables, [&](const std::string& table) { return key.starts_with(table + "["); })) {
      renamed[key] = written.second;
    }
  }
  where = std::move(renamed);
}

// Moves the parts that `goes` names from one list to the end of another, and lets the locations follow.
template <class Part, class Goes>
void move_parts(std::vector<Part>& from, const std::string& table_from, std::vector<Part>& to,
                const std::string& table_to, Locations& where, const Goes& goes) {
  std::vector<Renamed> entries;
  std::vector<Part> stay;
  for (std::size_t k = 0; k < to.size(); ++k) {
    const std::string entry = fmt::format("{}[{}]", table_to, k);
    entries.push_back({entry, entry});
  }
  for (std::size_t k = 0; k < from.size(); ++k) {
    const bool goes_now = goes(from[k]);
    std::vector<Part>& list = goes_now ? to : stay;
    entries.push_back(
        {fmt::format("{}[{}]", table_from, k), fmt::format("{}[{}]", goes_now ? table_to : table_from, list.size())});
    list.push_back(std::move(from[k]));
  }
  from = std::move(stay);
  rename(where, {table_from, table_to}, entries);
}

template <class Part>
void drop_parts(std::vector<Part>& parts, const std::string& table, Locations& where, const Names& names) {
  std::vector<Part> gone;
  const std::string aside = "gone_" + table;
  move_parts(parts, table, gone, aside, where, [&](const Part& part) { return is_among(names, part.name); });
}

constexpr const char* body = "body";
constexpr const char* later_body = "later_body";
constexpr const char* support = "support";
constexpr const char* later_support = "later_support";
constexpr const char* rigid = "rigid";
constexpr const char* later_rigid = "later_rigid";
constexpr const char* force = "force";
constexpr const char* later_force = "later_force";
constexpr const char* traction = "traction";
constexpr const char* later_traction = "later_traction";

template <class Part>
void number(std::vector<Part>& parts) {
  for (std::size_t k = 0; k < parts.size(); ++k) parts[k].number = k;
}

}  // namespace

void set_later_parts_aside(Problem& problem, Locations& where) {
  if (problem.phase.at_stages) return;
  number(problem.bodies);
  number(problem.supports);
  number(problem.rigid);
  number(problem.forces);
  number(problem.tractions);
  problem.phase.at_stages = !problem.stages.empty() || !problem.initial_from.empty();
  if (!problem.phase.at_stages) return;
  problem.named_supports = names_of(problem.supports);
  problem.named_bodies = names_of(problem.bodies);
  problem.rigid_as_written = problem.rigid;
  if (problem.stages.empty()) return;
  Names added, held;
  for (const StageSpec& stage : problem.stages) {
    std::ranges::copy(stage.add, std::back_inserter(added));
    std::ranges::copy(stage.hold, std::back_inserter(held));
  }
  const auto comes = [](const Names& names) {
    return [&names](const auto& part) { return is_among(names, part.name); };
  };
  move_parts(problem.bodies, body, problem.later_bodies, later_body, where, comes(added));
  move_parts(problem.supports, support, problem.later_supports, later_support, where, comes(held));
  move_parts(problem.rigid, rigid, problem.later_rigid, later_rigid, where, comes(added));
  move_parts(problem.forces, force, problem.later_forces, later_force, where, comes(held));
  move_parts(problem.tractions, traction, problem.later_tractions, later_traction, where, comes(held));
  if (problem.load && problem.load->at > 0) problem.load.swap(problem.later_load);
  if (problem.stages.front().at > 0) return;
  problem.present_stage = problem.stages.front();  // which changes nothing
  problem.stages.erase(problem.stages.begin());
}

double end_of_stage(const Problem& problem) {
  if (!problem.stages.empty()) return problem.stages.front().at;
  return std::max(problem.stop.time, problem.present_stage ? problem.present_stage->at : 0);
}

// By default half of a stage: the other half is to come to rest. A stage without an end is as long as the one before.
void resolve_stages(Problem& problem) {
  double begin = problem.present_stage ? problem.present_stage->at : 0, length = 0;
  for (std::size_t k = 0; k < problem.stages.size(); ++k) {
    StageSpec& stage = problem.stages[k];
    const double before = stage.at - begin, end = problem.stop.time;
    begin = stage.at;
    if (k + 1 < problem.stages.size()) {
      length = problem.stages[k + 1].at - begin;
    } else {
      length = end > 0 ? end - begin : before;
    }
    stage.ramp.take(problem.solve.is_static() ? 0 : length / 2, "half of the stage");
  }
}

void begin_next_stage(Scene& scene) {
  const StageSpec stage = scene.stages.front();
  scene.stages.erase(scene.stages.begin());
  scene.present_stage = stage;
  // Points go on as they were made.
  scene.phase.quadrature = scene.phase.quadrature.value();
  scene.phase.transfer = scene.phase.transfer.value();
  scene.geostatic.reset();
  scene.initial_stress.clear();
  scene.initial_from.clear();
  scene.initial_u.clear();
  scene.initial_v.clear();
  drop_parts(scene.bodies, body, scene.where, stage.remove);
  drop_parts(scene.supports, support, scene.where, stage.release);
  drop_parts(scene.rigid, rigid, scene.where, stage.remove);
  drop_parts(scene.forces, force, scene.where, stage.release);
  drop_parts(scene.tractions, traction, scene.where, stage.release);
  const auto comes = [](const Names& names) {
    return [&names](const auto& part) { return is_among(names, part.name); };
  };
  move_parts(scene.later_bodies, later_body, scene.bodies, body, scene.where, comes(stage.add));
  move_parts(scene.later_supports, later_support, scene.supports, support, scene.where, comes(stage.hold));
  move_parts(scene.later_rigid, later_rigid, scene.rigid, rigid, scene.where, comes(stage.add));
  move_parts(scene.later_forces, later_force, scene.forces, force, scene.where, comes(stage.hold));
  move_parts(scene.later_tractions, later_traction, scene.tractions, traction, scene.where, comes(stage.hold));
  if (scene.later_load && scene.later_load->at <= stage.at) scene.load.swap(scene.later_load);
  for (std::size_t k = 0; k < std::min(stage.change.size(), stage.material.size()); ++k) {
    const auto changed = std::ranges::find(scene.bodies, stage.change[k], &BodySpec::name);
    if (changed != scene.bodies.end()) changed->material = stage.material[k];
  }
}

std::vector<BodySpec> bodies_of_all_stages(const Problem& problem) {
  std::vector<BodySpec> all = problem.bodies;
  std::ranges::copy(problem.later_bodies, std::back_inserter(all));
  return all;
}

}  // namespace stillpoint
