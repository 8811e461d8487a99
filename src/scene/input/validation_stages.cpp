// Checks of the stages of a run, and of what they do not go with.
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/controlled_loads.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/stages.hpp"

namespace stillpoint {
namespace {

template <class Part>
std::vector<std::string> named(const std::vector<Part>& present, const std::vector<Part>& later) {
  std::vector<std::string> names;
  for (const auto* parts : {&present, &later})
    for (const Part& part : *parts)
      if (!part.name.empty()) names.push_back(part.name);
  return names;
}

/// The names of the bodies, rigid bodies, supports or loads that there are at a time, as one stage follows another.
class Presence {
 public:
  template <class Part>
  Presence(SceneCheck& check, const std::string& what, const std::vector<Part>& present, const std::vector<Part>& later)
      : check_(check), what_(what), all_(named(present, later)) {
    for (const Part& part : present) now_.insert(part.name);
    for (const Part& part : later) later_.insert(part.name);
  }

  /// Each of these looks at one name of a list.
  void begin(const std::string& key, const std::vector<std::string>& names, std::size_t k) {
    check_one(key, names, k, "{} {} comes twice", [&](const std::string& name) {
      const bool is_first = came_.insert(name).second;
      return now_.insert(name).second && is_first;
    });
  }
  void end(const std::string& key, const std::vector<std::string>& names, std::size_t k) {
    check_one(key, names, k, why_not_there(names[k]), [&](const std::string& name) { return now_.erase(name) > 0; });
  }
  void expect(const std::string& key, const std::vector<std::string>& names, std::size_t k) {
    check_one(key, names, k, why_not_there(names[k]), [&](const std::string& name) { return now_.contains(name); });
  }
  bool none_is_left() const { return now_.empty(); }
  const std::vector<std::string>& all() const { return all_; }
  bool knows(const std::string& name) const { return std::ranges::find(all_, name) != all_.end(); }

 private:
  const char* why_not_there(const std::string& name) const {
    if (!later_.contains(name) || came_.contains(name)) return "{} {} is not there then";
    return "{} {} comes with a later stage, and is not there before; what was taken away cannot come back, so that "
           "what comes needs a name of its own";
  }

  /// Reports a name that nothing has, and with this message one that is not in order.
  template <class IsInOrder>
  void check_one(const std::string& key, const std::vector<std::string>& names, std::size_t k, const char* message,
                 const IsInOrder& is_in_order) {
    const std::string one = fmt::format("{}[{}]", key, k);
    if (!knows(names[k])) {
      check_.add_unknown(one, what_, "[[" + what_ + "]] with a name", names[k], all_);
    } else if (!is_in_order(names[k])) {
      check_.add(one, fmt::format(fmt::runtime(message), what_, in_quotes(names[k])));
    }
  }

  SceneCheck& check_;
  std::string what_;
  std::vector<std::string> all_;
  std::set<std::string> now_, later_, came_;
};

/// The bodies and the rigid bodies that there are, which come and go by the same keys.
class BodyPresence {
 public:
  explicit BodyPresence(SceneCheck& check)
      : check_(check),
        bodies_(check, "body", check.scene().bodies, check.scene().later_bodies),
        rigid_(check, "rigid body", check.scene().rigid, check.scene().later_rigid) {}

  void end(const std::string& key, const std::vector<std::string>& names) {
    check_one_by_one(key, names, &Presence::end);
  }
  void begin(const std::string& key, const std::vector<std::string>& names) {
    check_one_by_one(key, names, &Presence::begin);
  }
  void expect(const std::string& key, const std::vector<std::string>& names) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string one = fmt::format("{}[{}]", key, k);
      if (!check_.wrong_if(rigid_.knows(names[k]), one, "{} is a rigid body, which has no material",
                           in_quotes(names[k])))
        bodies_.expect(key, names, k);
    }
  }
  bool no_body_is_left() const { return bodies_.none_is_left(); }

 private:
  void check_one_by_one(const std::string& key, const std::vector<std::string>& names,
                        void (Presence::*check)(const std::string&, const std::vector<std::string>&, std::size_t)) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool is_rigid = rigid_.knows(names[k]);
      if (!check_.wrong_if(is_rigid && bodies_.knows(names[k]), fmt::format("{}[{}]", key, k),
                           "a body and a rigid body have the name {}; give each one of its own", in_quotes(names[k])))
        ((is_rigid ? rigid_ : bodies_).*check)(key, names, k);
    }
  }

  SceneCheck& check_;
  Presence bodies_, rigid_;
};

/// The supports and the loads that there are, which begin and end by the same keys.
class HeldPresence {
 public:
  explicit HeldPresence(SceneCheck& check)
      : check_(check),
        supports_(check, "support", check.scene().supports, check.scene().later_supports),
        tractions_(check, "load", check.scene().tractions, check.scene().later_tractions),
        forces_(check, "load", check.scene().forces, check.scene().later_forces) {}

  void end(const std::string& key, const std::vector<std::string>& names) {
    check_one_by_one(key, names, &Presence::end);
  }
  void begin(const std::string& key, const std::vector<std::string>& names) {
    check_one_by_one(key, names, &Presence::begin);
  }

 private:
  void check_one_by_one(const std::string& key, const std::vector<std::string>& names,
                        void (Presence::*check)(const std::string&, const std::vector<std::string>&, std::size_t)) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string one = fmt::format("{}[{}]", key, k);
      Presence* const known = that_knows(names[k]);
      if (!known) {
        refuse_unknown(one, names[k]);
      } else if (!check_.wrong_if(drives(names[k]), one,
                                  "load {} is one of those that [load] drives, which begin together, by load.at; "
                                  "expected load.of without it",
                                  in_quotes(names[k]))) {
        (known->*check)(key, names, k);
      }
    }
  }
  Presence* that_knows(const std::string& name) {
    for (Presence* const one : {&supports_, &tractions_, &forces_})
      if (one->knows(name)) return one;
    return nullptr;
  }
  void refuse_unknown(const std::string& key, const std::string& name) {
    const Scene& scene = check_.scene();
    const bool is_body = std::ranges::count(scene.named_bodies, name) > 0,
               is_rigid =
                   std::ranges::find(scene.rigid_as_written, name, &RigidSpec::name) != scene.rigid_as_written.end();
    if (check_.wrong_if(!name.empty() && (is_body || is_rigid), key,
                        "{} is a {}, which add and remove name; here stand names of supports and loads",
                        in_quotes(name), is_body ? "body" : "rigid body"))
      return;
    std::vector<std::string> names;
    for (const Presence* const one : {&supports_, &tractions_, &forces_})
      names.insert(names.end(), one->all().begin(), one->all().end());
    check_.add_unknown(key, "support or load", "[[support]], [[traction]] or [[force]] with a name", name, names);
  }
  /// Whether [load] drives a load of this name.
  bool drives(const std::string& name) const {
    const Scene& scene = check_.scene();
    const auto any = [&](const auto& loads) {
      return std::ranges::any_of(
          loads, [&](const auto& load) { return load.name == name && is_driven(scene, name_of_load(load)); });
    };
    return any(scene.tractions) || any(scene.later_tractions) || any(scene.forces) || any(scene.later_forces);
  }

  SceneCheck& check_;
  Presence supports_, tractions_, forces_;
};

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

/// What a run that begins with the points of another one does not go with.
void check_other_run(SceneCheck& check) {
  const Scene& scene = check.scene();
  const std::string from = "initial.from";
  check.refuse_if(scene.initial_from.empty(), "initial", {"displacements"}, "goes with from, another run");
  if (scene.initial_from.empty()) return;
  std::error_code none;
  check.wrong_if(!std::filesystem::is_regular_file(scene.initial_from, none), from, "there is no file {}",
                 scene.initial_from.string());
  check.refuse_if(true, "initial", {"stress"}, "does not go with initial.from, whose stress it is");
  check.wrong_if(scene.geostatic.has_value(), "initial.geostatic", "does not go with initial.from, whose stress it is");
  const auto materials = materials_in_use(scene, check.catalogue());
  const auto is_elastic = [&](const MaterialSpec* one) { return !check.catalogue().law(one->law)->history_dependent; };
  check.wrong_if(scene.displacements_from_zero && scene.phase.deformation == DeformationRule::positions &&
                     std::ranges::any_of(materials, is_elastic),
                 "initial.displacements",
                 "elastic points take their deformation from their displacements; take phase.deformation = "
                 "\"accumulated\"");
  check.wrong_if(
      scene.displacements_from_zero && scene.phase.quadrature == Quadrature::domains, "initial.displacements",
      "domains remember their displacements by their corners; take phase.quadrature = \"points\" in both runs");
  check.refuse_if(true, "initial", {"u", "v"},
                  "does not go with initial.from, where bodies are as another run left them");
}

}  // namespace

void check_stages(SceneCheck& check) {
  const Scene& scene = check.scene();
  check_other_run(check);
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
