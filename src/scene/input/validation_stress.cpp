// Checks of the stress that bodies begin with.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/own_loads.hpp"

namespace stillpoint {
namespace {

/// The material of a body keeps a stress at which nothing is deformed, which a law without history cannot.
void check_laws_keep_a_stress(SceneCheck& check, const char* what) {
  const Scene& scene = check.scene();
  std::vector<std::string> names;
  for (const LawInfo& law : check.catalogue().laws)
    if (law.history_dependent) names.emplace_back(law.name);
  for (const BodySpec& body : scene.bodies) {
    const LawInfo* const law = check.law_of(body.material);
    if (check.wrong_if(law && !law->history_dependent, fmt::format("material.{}.law", body.material),
                       "{} needs a law that keeps a stress{}; the stress of '{}' is 0 if nothing is deformed", what,
                       names.empty() ? "" : ", such as " + either(names), law ? law->name : ""))
      return;
  }
}

/// Water at rest bears on no ground but that in which it is a part of the stress.
void check_water_table(SceneCheck& check) {
  const Scene& scene = check.scene();
  const std::string key = "initial.geostatic.water_table";
  check.refuse_if(!scene.geostatic->water_table, "initial.geostatic", {"water_density"}, "goes with water_table");
  if (!scene.geostatic->water_table) return;
  const double level = *scene.geostatic->water_table;
  check.wrong_if(level > scene.geostatic->surface, key, "must not lie above the surface of the ground at {}, not {}",
                 scene.geostatic->surface, level);
  for (const BodySpec& body : scene.bodies) {
    const auto material = scene.materials.find(body.material);
    if (material == scene.materials.end() || body.min.size() < 2 || !(body.min[1] < level)) continue;
    check.wrong_if(!material->second.undrained, key,
                   "lies above the bottom of {}, and '{}' is drained: there the stress is the effective one and the "
                   "weight that of ground under water; expected undrained = true, or rho less that of water below "
                   "the water table and no water_table",
                   body.name.empty() ? "the body" : in_quotes(body.name), body.material);
  }
}

void check_geostatic(SceneCheck& check, const std::optional<NamedBox>& body) {
  const Scene& scene = check.scene();
  const std::string key = "initial.geostatic";
  if (!scene.geostatic || check.wrong_if(scene.dim == 1, key, "a level surface needs two dimensions")) return;
  check.wrong_if(!scene.initial_u.empty(), "initial.u",
                 "does not go with initial.geostatic, which is the stress of the undeformed body");
  check_weight(check, key);
  check_laws_keep_a_stress(check, "initial.geostatic");
  const Expression& K0 = scene.geostatic->K0;
  if (check.sound(key + ".K0") && K0.constant())
    check.wrong_if(!(K0({}, 0) > 0), key + ".K0", "must be greater than 0, not {}", K0({}, 0));
  if (body && check.sound(key + ".surface"))
    check.wrong_if(scene.geostatic->surface < body->max[1], key + ".surface",
                   "must not lie below the top of the {} at {}, not {}", body->name, body->max[1],
                   scene.geostatic->surface);
  check_water_table(check);
}

/// A uniform stress, in place of that of level ground.
void check_uniform_stress(SceneCheck& check) {
  const Scene& scene = check.scene();
  const std::string key = "initial.stress";
  if (scene.initial_stress.empty() || !check.sound(key)) return;
  if (check.wrong_if(scene.geostatic.has_value(), key, "does not go with initial.geostatic, which is a stress too"))
    return;
  check.wrong_if(!scene.initial_u.empty(), "initial.u",
                 "does not go with initial.stress, which is the stress of the undeformed body");
  check_laws_keep_a_stress(check, "initial.stress");
}

/// A law whose stiffness grows with pressure from nothing has to begin under one.
void check_pressure(SceneCheck& check) {
  const Scene& scene = check.scene();
  const bool is_stage = scene.present_stage && scene.present_stage->at > 0;
  for (const BodySpec& body : scene.bodies) {
    const LawInfo* const law = check.law_of(body.material);
    if (!law || !law->needs_pressure || is_stage || !scene.initial_from.empty()) continue;
    const std::string key = fmt::format("material.{}.law", body.material);
    const bool is_given = scene.geostatic || !scene.initial_stress.empty();
    const bool is_read = check.sound("initial.stress") && check.sound("initial.geostatic") && check.sound("initial");
    if (check.wrong_if(!is_given && is_read, key,
                       "'{}' has no stiffness without pressure; expected an initial stress that presses: [initial] "
                       "stress, or [initial.geostatic]",
                       law->name))
      return;
    if (scene.initial_stress.size() < 3) continue;
    const double p = -(scene.initial_stress[0] + scene.initial_stress[1] + scene.initial_stress[2]) / 3;
    if (check.wrong_if(!(p > 0), "initial.stress",
                       "is a mean pressure of {:.6g} Pa, under which '{}' has no stiffness; expected one above 0: "
                       "tension is positive",
                       p, law->name))
      return;
  }
}

}  // namespace

void check_weight(SceneCheck& check, const std::string& key) {
  const Scene& scene = check.scene();
  const auto& b = scene.body_force;
  if (own_load(scene.own_load)) {
    check.add("body_force.own",
              fmt::format("does not go with {}, which is the stress of a constant weight alone", key));
  } else if (b.size() != static_cast<std::size_t>(scene.dim)) {
    check.wrong_if(!check.written("body_force"), key, "needs a [body_force]: the weight that the stress bears");
  } else {
    check.wrong_if(
        !std::ranges::all_of(b, &Expression::constant) || b[0]({}, 0) != 0 || (scene.dim == 3 && b[2]({}, 0) != 0),
        "body_force.value", "must be constant and vertical, {}, if {} is asked for",
        scene.dim == 2 ? "[0, b]" : "[0, b, 0]", key);
  }
}

void check_initial_stress(SceneCheck& check, const std::optional<NamedBox>& body) {
  check_geostatic(check, body);
  check_uniform_stress(check);
  check_pressure(check);
}

}  // namespace stillpoint
