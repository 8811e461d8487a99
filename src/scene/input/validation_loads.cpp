// What loads the bodies, and the stress that they begin with.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/body_surface.hpp"
#include "scene/border_line.hpp"
#include "scene/controlled_loads.hpp"
#include "scene/input/face_interval_check.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/own_loads.hpp"
#include "scene/support_kind.hpp"

namespace stillpoint {
namespace {

/// The side that a line lies on.
void check_line(SceneCheck& check, const std::string& key, const std::vector<std::vector<double>>& line) {
  if (line.size() != 2) return check.add(key, fmt::format("must be two positions, [from, to], not {}", line.size()));
  const std::array<double, 2> from{line[0][0], line[0][1]}, to{line[1][0], line[1][1]};
  if (from == to) return check.add(key, "the two positions are the same");
  const std::vector<BorderLine> sides = border_lines(check.scene(), from, to);
  if (sides.empty())
    check.add(key,
              "no straight side of a box or a polygon holds both positions, nor the outline of points from a file; "
              "expected positions on the border, with no corner between them but those of such an outline");
  if (!sides.empty() && sides.front().body != sides.back().body)
    check.add(key, fmt::format("bodies {} and {} touch here, so that nothing can load one of them",
                               sides.front().body + 1, sides.back().body + 1));
}

/// The body that a surface belongs to.
void check_surface(SceneCheck& check, const std::string& key, BodySurface surface) {
  const Scene& scene = check.scene();
  const std::optional<std::size_t> number = body_with_surface(scene);
  if (!number) return check.add(key, "needs a scene with one body that is no box but another shape");
  const BodySpec& body = scene.bodies[*number];
  if (const std::string why = why_no_surface(body, surface); !why.empty()) return check.add(key, why);
  double length = 0;
  for (std::size_t d = 0; d < 3; ++d) length = std::max(length, (body.max[d] - body.min[d]) / 8);
  if (surface_pieces(body, surface, length).empty()) check.add(key, "all of it is cut off by the body's min and max");
}

void check_tractions(SceneCheck& check, bool bodies) {
  const Scene& scene = check.scene();
  const bool box = scene.bodies.size() == 1 && scene.bodies[0].is_box();
  for (std::size_t k = 0; k < scene.tractions.size(); ++k) {
    const std::string name = fmt::format("traction[{}]", k);
    const TractionSpec& traction = scene.tractions[k];
    check.one_of(name, {"value", !traction.value.empty()}, {"pressure", traction.pressure.has_value()},
                 "give either value, which keeps its direction, or pressure, which follows the face",
                 "give value, which keeps its direction, or pressure, which follows the face");
    if (scene.dim == 3) {
      check.one_of(name, {"face", traction.face.has_value()}, {"surface", traction.surface.has_value()},
                   "give either face or surface, not both",
                   "give face, a side of the body's box, or surface, of a body that is no box");
    } else {
      check.one_of(name, {"face", traction.face.has_value()}, {"line", !traction.line.empty()},
                   "give either face or line, not both",
                   scene.dim == 2 ? "give face, a side of the body's box, or line, a part of its border"
                                  : "give face, an end of the body");
    }
    if (!scene.tractions[k].face) check.refuse(name, {"from", "to"}, "goes with a face, of which it loads a part");
    if (!bodies) continue;
    if (box && scene.tractions[k].face && check.sound(name + ".from") && check.sound(name + ".to")) {
      const BodySpec& body = scene.bodies[0];
      const auto part =
          part_of_face(*scene.tractions[k].face, scene.tractions[k].from, scene.tractions[k].to, body.min, body.max);
      for (std::size_t axis = 0; axis < part.size(); ++axis)
        check_interval(check, name, part[axis], axis, body.min[part[axis].along], body.max[part[axis].along], "body");
    }
    if (check.given(name + ".line", !traction.line.empty()) && check.sound(name + ".line"))
      check_line(check, name + ".line", scene.tractions[k].line);
    if (scene.tractions[k].surface) check_surface(check, name + ".surface", *scene.tractions[k].surface);
    if (!check.given(name + ".face", traction.face.has_value()) || traction.surface || box) continue;
    const std::string what = scene.bodies.size() > 1         ? fmt::format("are {} bodies", scene.bodies.size())
                             : !scene.bodies[0].file.empty() ? "are points from a file"
                             : scene.dim == 2                ? "is a polygon"
                                                             : "is another shape";
    check.add(name, fmt::format("needs a scene with one body that is a box, which has faces; there {}{}", what,
                                scene.dim == 2                ? "; give line = [from, to]"
                                : scene.bodies[0].has_shape() ? "; give surface"
                                                              : ""));
  }
}

void check_body_force(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (check.written("body_force") && !check.written("body_force.value") && !check.written("body_force.own"))
    check.add("body_force", "the key 'value' is missing");
  if (scene.own_load.empty() || own_load(scene.own_load)) return;
  check.add("body_force.own", unknown_own_load(scene.own_load));
}

/// Loads of one proportion are as large as their displacement makes them.
void check_load_control(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (!scene.load) {
    if (scene.stop.load_growth > 0) check.add("stop.load_growth", "asks for the limit of a load that [load] drives");
    return;
  }
  const std::vector<std::string> names = names_of_loads(scene);
  if (names.empty()) check.add("load", "drives the loads of a scene, of which there are none");
  for (const std::string& name : scene.load->of)
    if (std::ranges::find(names, name) == names.end())
      check.add("load.of", unknown_word("there is no load", name, names));
  reference_loads(scene).for_each_formula([&](const std::string& key, const Expression& formula) {
    if (key != "load.displacement" && formula.uses('t'))
      check.add("load", fmt::format("a load that it drives depends on t ({}); the time belongs into load.displacement",
                                    formula.text()));
  });
  if (own_load_varies(reference_loads(scene)))
    check.add("load", fmt::format("a load that it drives, {}, depends on t; the time belongs into load.displacement",
                                  in_quotes(scene.own_load)));
  if (scene.geostatic && reference_loads(scene).has_body_force())
    check.add("initial.geostatic",
              "is the stress of a weight that acts from the start; [load] drives it, from nothing");
  if (scene.solve.is_static())
    check.add("load",
              fmt::format("'{}' is a static solver, without the time in which a displacement could drive a load; "
                          "take solve.method = \"relaxation\"",
                          scene.solve.method));
  if (!(scene.stop.time > 0))
    check.add("stop.time", "expected with [load]: until then the displacement drives the loads");
}

/// ", such as drucker-prager"
std::string laws_that_keep_a_stress(const SceneCheck& check) {
  std::vector<std::string> names;
  for (const LawInfo& law : check.catalogue().laws)
    if (law.history_dependent) names.emplace_back(law.name);
  return names.empty() ? "" : ", such as " + either(names);
}

void check_geostatic(SceneCheck& check, const std::optional<BodyBox>& body) {
  const Scene& scene = check.scene();
  if (!scene.geostatic) return;
  const std::string key = "initial.geostatic";
  if (scene.dim == 1) return check.add(key, "a level surface needs two dimensions");
  if (!scene.initial_u.empty())
    check.add("initial.u", "does not go with initial.geostatic, which is the stress of the undeformed body");
  const auto& b = scene.body_force;
  if (own_load(scene.own_load)) {
    check.add("body_force.own", "does not go with initial.geostatic, which is the stress of a constant weight alone");
  } else if (b.size() != static_cast<std::size_t>(scene.dim)) {
    if (!check.written("body_force")) check.add(key, "needs a [body_force]: the weight that the stress bears");
  } else if (!std::ranges::all_of(b, &Expression::constant) || b[0]({}, 0) != 0 ||
             (scene.dim == 3 && b[2]({}, 0) != 0)) {
    check.add("body_force.value", fmt::format("must be constant and vertical, {}, if initial.geostatic is asked for",
                                              scene.dim == 2 ? "[0, b]" : "[0, b, 0]"));
  }
  for (const BodySpec& spec : scene.bodies) {
    const auto material = scene.materials.find(spec.material);
    if (material == scene.materials.end()) continue;
    const LawInfo* const law = law_of(check, material->second);
    if (!law || law->history_dependent) continue;
    check.add(fmt::format("material.{}.law", material->first),
              fmt::format("initial.geostatic needs a law that keeps a stress{}; the stress of '{}' is 0 if nothing is "
                          "deformed",
                          laws_that_keep_a_stress(check), law->name));
    break;
  }
  if (body && check.sound(key + ".surface") && scene.geostatic->surface < body->max[1])
    check.add(key + ".surface", fmt::format("must not lie below the top of the {} at {}, not {}", body->name,
                                            body->max[1], scene.geostatic->surface));
}

}  // namespace

void check_loads(SceneCheck& check, const std::optional<BodyBox>& body) {
  const Scene& scene = check.scene();
  for (std::size_t k = 0; k < scene.forces.size() && body; ++k)
    check.inside(scene.forces[k].at, body->min, body->max, body->name, fmt::format("force[{}].at", k));
  check_tractions(check, body.has_value());
  check_body_force(check);
  check_load_control(check);
  check_geostatic(check, body);
}

}  // namespace stillpoint
