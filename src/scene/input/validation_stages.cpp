// Checks of the stages of a run, and of what they do not go with.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/input/stage_presence.hpp"
#include "scene/stages.hpp"

namespace stillpoint {
namespace {

/// A law without history knows no stress but that of its deformation, which another material did not have.
void check_new_materials(SceneCheck& check, const StageSpec& stage, const std::string& key) {
  const Scene& scene = check.scene();
  check.wrong_if(stage.change.size() != stage.material.size(), key + ".material",
                 "must be a material for each of the {} bodies that change, not {}", stage.change.size(),
                 stage.material.size());
  std::vector<std::string> names;
  for (const auto& [name, material] : scene.materials) names.push_back(name);
  for (std::size_t k = 0; k < stage.material.size(); ++k) {
    const std::string one = fmt::format("{}.material[{}]", key, k);
    const auto material = scene.materials.find(stage.material[k]);
    if (material == scene.materials.end()) {
      check.add_unknown(one, "material", "[material.<name>]", stage.material[k], names);
      continue;
    }
    const LawInfo* const law = check.law_of(stage.material[k]);
    check.wrong_if(law && !law->history_dependent, one,
                   "'{}' is a law without history, whose stress follows from its own deformation alone: it cannot take "
                   "over the stress of another material",
                   material->second.law);
  }
}

void check_changed_once(SceneCheck& check, const StageSpec& stage, const std::string& key) {
  for (std::size_t k = 0; k < stage.change.size(); ++k) {
    const auto here = stage.change.begin() + static_cast<std::ptrdiff_t>(k);
    check.wrong_if(std::find(stage.change.begin(), here, *here) != here, fmt::format("{}.change[{}]", key, k),
                   "body {} changes twice at the same time", in_quotes(*here));
  }
}

/// A body is placed without stress, or under the weight of what is placed above it.
void check_new_bodies(SceneCheck& check, const StageSpec& stage, const std::string& key) {
  const Scene& scene = check.scene();
  bool places_a_body = false;
  for (std::size_t k = 0; k < stage.add.size(); ++k) {
    const auto body = std::ranges::find(scene.later_bodies, stage.add[k], &BodySpec::name);
    if (body == scene.later_bodies.end()) continue;
    places_a_body = true;
    const std::string one = fmt::format("{}.add[{}]", key, k), name = in_quotes(stage.add[k]);
    const LawInfo* const law = check.law_of(body->material);
    check.wrong_if(!stage.K0 && law && law->needs_pressure, one,
                   "{} is placed without stress, and '{}' has no stiffness without pressure; give {}.K0, with which it "
                   "bears its weight, or take another law for it",
                   name, law ? law->name : "", key);
    check.wrong_if(stage.K0 && law && !law->history_dependent, one,
                   "the stress of '{}', the law of {}, is 0 where nothing is deformed, so that {} cannot be placed "
                   "under its weight; leave out {}.K0, or take a law that keeps a stress",
                   law ? law->name : "", name, name, key);
    check.wrong_if(stage.K0 && body->shape() == BodyShape::points, one,
                   "where {}, of points from a file, ends is not known, and so the weight above them; leave out {}.K0, "
                   "or give it a shape",
                   name, key);
  }
  const std::string K0 = key + ".K0";
  if (!stage.K0 || check.wrong_if(!places_a_body, K0, "is of bodies that the stage adds, and it adds none") ||
      check.wrong_if(scene.dim == 1, K0, "needs two dimensions, of which the second is the vertical"))
    return;
  check_weight(check, K0);
  check.wrong_if(stage.K0->constant() && !((*stage.K0)({}, 0) > 0), K0, "must be greater than 0, not {}",
                 (*stage.K0)({}, 0));
}

/// What stages cannot be had with.
void check_company_of_stages(SceneCheck& check) {
  const Scene& scene = check.scene();
  const std::string first = scene.initial_from.empty() ? "stage[0]" : "initial.from";
  check.wrong_if(
      scene.later_load && std::ranges::find(scene.stages, scene.later_load->at, &StageSpec::at) == scene.stages.end(),
      "load.at", "must be the time of a [[stage]], and there is none at t = {}",
      scene.later_load ? scene.later_load->at : 0);
  for (std::size_t k = 0; k < scene.probes.size(); ++k)
    check.wrong_if(scene.probes[k].point.has_value(), fmt::format("probe[{}].point", k),
                   "points have other numbers in other stages; take at");
  const auto springs = [&](const SupportSpec& support) { return holds_by_springs(scene.grid, support); };
  const std::vector<std::string> supports = named(scene.supports, scene.later_supports);
  const auto changes = [&](const StageSpec& stage) {
    const auto is_support = [&](const std::string& name) { return std::ranges::count(supports, name) > 0; };
    return std::ranges::any_of(stage.hold, is_support) || std::ranges::any_of(stage.release, is_support);
  };
  check.wrong_if(
      !scene.grid.cells.empty() && std::ranges::any_of(scene.stages, changes) &&
          (std::ranges::any_of(scene.supports, springs) || std::ranges::any_of(scene.later_supports, springs)),
      first,
      "supports that hold by springs stay as they are: no stage can hold or release a support beside them "
      "yet");
}

}  // namespace

void check_stages(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (!scene.phase.at_stages) return;
  check_company_of_stages(check);
  BodyPresence bodies(check);
  HeldPresence held(check);
  const std::size_t offset = scene.present_stage ? 1 : 0;
  double before = 0;
  const auto check_wait = [&](const StageSpec& stage, const std::string& key) {
    check.wrong_if(stage.equilibrium && !scene.stop.wants_equilibrium(), key + ".equilibrium",
                   "there is no test of equilibrium: give stop.residual");
    check.wrong_if(scene.solve.is_static() && stage.ramp.is_asked(), key + ".ramp",
                   "'{}' is a static solver, which has no time; solve.load_steps divides what a stage changes",
                   scene.solve.method);
  };
  if (scene.present_stage) {
    const StageSpec& first = *scene.present_stage;
    check_wait(first, "stage[0]");
    check.refuse_if(true, "stage[0]", {"add", "remove", "K0", "hold", "release", "change", "material", "ramp"},
                    "at t = 0 there is what the scene has: leave it out, or give a later time");
  }
  for (std::size_t k = 0; k < scene.stages.size(); ++k) {
    const StageSpec& stage = scene.stages[k];
    const std::string key = fmt::format("stage[{}]", k + offset);
    if (check.wrong_if(!(stage.at > before), key + ".at", "must be later than {}, not {}", before, stage.at)) return;
    before = stage.at;
    check_wait(stage, key);
    bodies.end(key + ".remove", stage.remove);
    bodies.begin(key + ".add", stage.add);
    if (check.wrong_if(bodies.no_body_is_left(), key + ".remove", "no body is left then")) return;
    bodies.expect(key + ".change", stage.change);
    check_changed_once(check, stage, key);
    held.end(key + ".release", stage.release);
    held.begin(key + ".hold", stage.hold);
    check_new_materials(check, stage, key);
    check_new_bodies(check, stage, key);
    const bool is_last = k + 1 == scene.stages.size();
    const double end = is_last ? scene.stop.time : scene.stages[k + 1].at;
    check.wrong_if(stage.ramp.is_asked() && end > 0 && stage.at + stage.ramp > end, key + ".ramp",
                   "must be over when the {} at t = {}", is_last ? "run ends" : "next stage begins", end);
  }
  check.wrong_if(scene.stop.time > 0 && !(scene.stop.time > before), "stop.time",
                 "must be later than the last stage, at t = {}", before);
}

}  // namespace stillpoint
