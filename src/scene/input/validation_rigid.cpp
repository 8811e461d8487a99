// Checks of the rigid bodies: their names and motions, and the bodies that they touch.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/dimensions.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

/// The checks of the motion of one rigid body, and of the bodies that it names.
class RigidCheck {
 public:
  RigidCheck(SceneCheck& check, std::size_t k)
      : check_(check), spec_(check.scene().rigid[k]), table_(fmt::format("rigid[{}]", k)) {}

  void run() {
    check_motion();
    check_freedom();
    check_bodies();
  }

 private:
  std::string key(const std::string& name) const { return table_ + "." + name; }

  void check_formulas(const char* name, const std::vector<Expression>& formulas, std::size_t count) {
    const std::string path = key(name);
    if (formulas.empty() || !check_.sound(path) ||
        check_.wrong_if(formulas.size() != count, path, "expected {} values, found {}", count, formulas.size()))
      return;
    for (std::size_t k = 0; k < count; ++k) {
      const std::string one = fmt::format("{}[{}]", path, k);
      if (!check_.wrong_if(formulas[k].uses_position(), one,
                           "depends on the position, but a rigid body moves as a whole; expected a formula of t"))
        check_.wrong_if(!std::isfinite(formulas[k]({}, 0)), one, "is {} at t = 0; expected a finite number",
                        formulas[k]({}, 0));
    }
  }

  void check_motion() {
    const auto dim = static_cast<std::size_t>(check_.scene().dim);
    check_formulas("motion", spec_.motion, dim);
    check_formulas("rotation", spec_.rotation, dimension_info(check_.scene().dim).turns.size());
    const bool turns = check_.given(key("rotation"), !spec_.rotation.empty());
    const bool has_centre = check_.given(key("about"), !spec_.about.empty());
    // It is the centre of a rotation, and of the moment that is reported, which a body has that does not turn as well.
    if (has_centre && check_.sound(key("about")))
      check_.wrong_if(spec_.about.size() != dim, key("about"), "expected {} coordinates, found {}", dim,
                      spec_.about.size());
    if (check_.scene().state != StressState::axisymmetric) return;
    check_.wrong_if(!spec_.motion.empty() && !rests(spec_.motion[0]), key("motion[0]"),
                    "what is turned about the axis of symmetry moves along it alone; expected 0");
    check_.wrong_if(turns, key("rotation"), "would turn the axis of symmetry away; leave it out");
  }

  void check_freedom() {
    const Scene& scene = check_.scene();
    const bool pushed = check_.given(key("force"), !spec_.force.empty());
    if (!spec_.free) {
      check_.wrong_if(spec_.mass > 0, key("mass"), "goes with free = true; another rigid body moves by its formulas");
      check_.wrong_if(pushed, key("force"), "goes with free = true; another rigid body moves by its formulas");
      return;
    }
    check_formulas("force", spec_.force, static_cast<std::size_t>(scene.dim));
    check_.wrong_if(check_.given(key("motion"), !spec_.motion.empty()), key("motion"),
                    "a free rigid body moves to where its forces balance; leave out one of 'free' and 'motion'");
    check_.wrong_if(check_.given(key("rotation"), !spec_.rotation.empty()), key("rotation"),
                    "a free rigid body does not turn; leave out one of 'free' and 'rotation'");
    check_.wrong_if(!pushed && !(spec_.mass > 0 && scene.has_body_force()), key("free"),
                    "nothing moves it: expected a force, or a mass and a body_force");
    const bool weighs = spec_.mass > 0;
    check_.wrong_if(
        weighs && (!scene.own_load.empty() || std::ranges::any_of(scene.body_force, &Expression::uses_position)),
        key("mass"), "the body force depends on the position; give the weight as 'force'");
    if (scene.state == StressState::axisymmetric && pushed && check_.sound(key("force")))
      check_.wrong_if(!rests(spec_.force[0]), key("force[0]"),
                      "what is turned about the axis of symmetry moves along it alone; expected 0");
  }

  void check_bodies() {
    if (!check_.sound(key("bodies"))) return;
    check_.wrong_if(spec_.bodies.empty() && check_.written(key("bodies")), key("bodies"),
                    "names no body; leave it out to touch all");
    check_body_names(check_, key("bodies"), spec_.bodies);
  }

  SceneCheck& check_;
  const RigidSpec& spec_;
  std::string table_;
};

/// The names of rigid bodies stand in history.csv beside those of supports, walls and probes.
void check_names(SceneCheck& check) {
  const Scene& scene = check.scene();
  check.unique_names("rigid", scene.rigid, "rigid body");
  for (std::size_t k = 0; k < scene.rigid.size(); ++k) {
    const std::string table = fmt::format("rigid[{}]", k), key = table + ".name", &name = scene.rigid[k].name;
    // A file without the key was told so as it was read.
    if (check.wrong_if(name.empty() && check.sound(table) && check.sound(key), table, "the key 'name' is missing") ||
        name.empty())
      continue;
    check.contact_name(name, key);
    const auto taken = [&](const char* what, const auto& entries) {
      const auto is_same = [&](const auto& entry) { return entry.name == name; };
      check.wrong_if(std::ranges::any_of(entries, is_same), key, "there is a {} {} already", what, in_quotes(name));
    };
    taken("support", scene.supports);
    check.wrong_if(std::ranges::count(scene.named_supports, name) > 0 &&
                       std::ranges::none_of(scene.supports, [&](const SupportSpec& one) { return one.name == name; }),
                   key, "there is a support {} in another stage", in_quotes(name));
    taken("wall", scene.walls);
    taken("probe", scene.probes);
  }
}

}  // namespace

void check_rigid_bodies(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (scene.rigid.empty() ||
      check.wrong_if(scene.dim == 1, "rigid[0]", "there is none in a scene with dim = {}", scene.dim))
    return;
  for (std::size_t k = 0; k < scene.rigid.size(); ++k) {
    check_rigid_shape(check, k);
    RigidCheck(check, k).run();
  }
  check_names(check);
}

}  // namespace stillpoint
