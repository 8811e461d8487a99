// Checks of the loads on the bodies.
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/body_border.hpp"
#include "scene/contact_bodies.hpp"
#include "scene/controlled_loads.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/own_loads.hpp"

namespace stillpoint {
namespace {

/// A problem with those bodies that stages are yet to add whose borders can be told before they are checked: boxes, and
/// polygons in the plane.
Problem with_later_bodies(const Scene& scene) {
  Problem later;
  later.dim = scene.dim;
  later.grid = scene.grid;
  const auto dim = static_cast<std::size_t>(scene.dim);
  if (scene.grid.min.size() != dim || scene.grid.max.size() != dim) return later;
  const auto is_corner = [](const std::vector<double>& corner) { return corner.size() == 2; };
  for (BodySpec body : scene.later_bodies) {
    body.min.take(scene.grid.min);
    body.max.take(scene.grid.max);
    const bool has_box = body.min.size() == dim && body.max.size() == dim;
    const bool is_polygon = dim == 2 && body.shape() == BodyShape::polygon && body.polygon.size() > 2 &&
                            std::ranges::all_of(body.polygon, is_corner);
    if (has_box && (body.is_box() || is_polygon)) later.bodies.push_back(std::move(body));
  }
  return later;
}

/// What is wrong with a load on a body that a stage is yet to add, and what to do.
std::string not_there_yet(const Scene& scene, const BodySpec& body, const std::string& load) {
  const auto stage = std::ranges::find_if(
      scene.stages, [&](const StageSpec& one) { return std::ranges::count(one.add, body.name) > 0; });
  return fmt::format(
      "lies on body {}, which is not there yet: the stage at t = {:.6g} adds it; {} in hold of that "
      "stage or of a later one",
      in_quotes(body.name), stage == scene.stages.end() ? 0 : stage->at,
      load.empty() ? "give the load a name and list it" : "list " + in_quotes(load));
}

/// What to do about a load that was in order in the stages before; empty in the first one.
std::string how_it_ends(const Scene& scene, const std::string& load) {
  if (!scene.present_stage || !(scene.present_stage->at > 0)) return "";
  return fmt::format("; if the load ends with this stage, {} in its release",
                     load.empty() ? "give it a name and list that" : "list " + in_quotes(load));
}

/// A line has to lie on one side of one body. load: the name of the load.
void check_line(SceneCheck& check, const std::string& key, const std::vector<std::vector<double>>& line,
                const std::string& load) {
  if (!check.two_positions(key, line)) return;
  const std::array from{line[0][0], line[0][1]}, to{line[1][0], line[1][1]};
  const std::vector<BorderLine> sides = border_lines(check.scene(), from, to);
  if (sides.empty()) {
    const Problem later = with_later_bodies(check.scene());
    if (const std::vector<BorderLine> of_later = border_lines(later, from, to); !of_later.empty())
      return check.add(key, not_there_yet(check.scene(), later.bodies[of_later.front().body], load));
  }
  const std::string ends = how_it_ends(check.scene(), load);
  if (check.wrong_if(sides.empty(), key,
                     "no straight side of a box or a polygon holds both positions, nor the outline of points from a "
                     "file; expected positions on the border, with no corner between them but those of such an "
                     "outline{}",
                     ends))
    return;
  check.wrong_if(sides.front().body != sides.back().body, key,
                 "bodies {} and {} touch here, so that nothing can load one of them{}", sides.front().body + 1,
                 sides.back().body + 1, ends);
}

/// A surface has to be one that the only body of another shape than a box has. load: the name of the load.
void check_surface(SceneCheck& check, const std::string& key, BodySurface surface, const std::string& load) {
  const Scene& scene = check.scene();
  const std::optional<std::size_t> number = body_with_surface(scene);
  if (!number && std::ranges::none_of(scene.bodies, &BodySpec::has_shape)) {
    const auto later = std::ranges::find_if(scene.later_bodies, &BodySpec::has_shape);
    if (later != scene.later_bodies.end()) return check.add(key, not_there_yet(scene, *later, load));
  }
  if (check.wrong_if(!number, key, "needs a scene with one body that is no box but another shape{}",
                     how_it_ends(scene, load)))
    return;
  const BodySpec& body = scene.bodies[*number];
  const std::string why = why_no_surface(body, surface);
  if (check.wrong_if(!why.empty(), key, "{}", why)) return;
  double length = 0;
  for (std::size_t d = 0; d < 3; ++d) length = std::max(length, (body.max[d] - body.min[d]) / 8);
  check.wrong_if(surface_pieces(body, surface, length).empty(), key, "all of it is cut off by the body's min and max");
}

/// A traction lies on a part of a body's surface. The bodies are in order.
void check_surface_of_traction(SceneCheck& check, const std::string& name, const TractionSpec& traction) {
  const Scene& scene = check.scene();
  const BodySpec& body = scene.bodies[0];
  const bool box = scene.bodies.size() == 1 && body.is_box();
  if (box && traction.face && check.sound(name + ".from") && check.sound(name + ".to")) {
    const auto part = part_of_face(*traction.face, traction.from, traction.to, body.min, body.max);
    for (std::size_t axis = 0; axis < part.size(); ++axis)
      check.check_interval(name, part[axis], axis, {body.min, body.max, "body"});
  }
  if (check.given(name + ".line", !traction.line.empty()) && check.sound(name + ".line"))
    check_line(check, name + ".line", traction.line, traction.name);
  if (traction.surface) check_surface(check, name + ".surface", *traction.surface, traction.name);
  const std::string what = scene.bodies.size() > 1 ? fmt::format("are {} bodies", scene.bodies.size())
                           : !body.file.empty()    ? "are points from a file"
                           : scene.dim == 2        ? "is a polygon"
                                                   : "is another shape";
  check.wrong_if(check.given(name + ".face", traction.face.has_value()) && !traction.surface && !box, name,
                 "needs a scene with one body that is a box, which has faces; there {}{}{}", what,
                 scene.dim == 2     ? "; give line = [from, to]"
                 : body.has_shape() ? "; give surface"
                                    : "",
                 how_it_ends(scene, traction.name));
}

/// A force acts at a position in the box around the bodies. Where it lies on one that a stage is yet to add, that has
/// to come first.
void check_place_of_force(SceneCheck& check, const std::string& key, const PointForceSpec& force,
                          const NamedBox& body) {
  const Scene& scene = check.scene();
  const std::vector<double>& at = force.at;
  const auto dim = static_cast<std::size_t>(scene.dim);
  if (!check.sound(key) || at.size() != dim) {
    check.inside(at, body, key);
    return;
  }
  bool is_outside = false;
  for (std::size_t d = 0; d < dim; ++d) is_outside = is_outside || !(at[d] >= body.min[d] && at[d] <= body.max[d]);
  const bool are_known =
      std::ranges::none_of(scene.bodies, [](const BodySpec& one) { return one.shape() == BodyShape::points; });
  if (!scene.later_bodies.empty() && (is_outside || (are_known && bodies_at(scene, at).empty()))) {
    const Problem later = with_later_bodies(scene);
    if (const std::vector<std::size_t> of_later = bodies_at(later, at); !of_later.empty())
      return check.add(key, not_there_yet(scene, later.bodies[of_later.front()], force.name));
  }
  const std::string ends = how_it_ends(scene, force.name);
  if (!check.wrong_if(is_outside && !ends.empty(), key, "lies outside the {} of this stage{}", body.name, ends))
    check.inside(at, body, key);
}

/// A force belongs to one of two bodies that move apart.
void check_body_of_force(SceneCheck& check, const std::string& key, const std::vector<double>& at) {
  const Scene& scene = check.scene();
  if (scene.contacts.empty() || !check.sound(key) || at.size() != static_cast<std::size_t>(scene.dim)) return;
  const std::vector<std::size_t> bodies = bodies_at(scene, at);
  for (const std::size_t a : bodies) {
    for (const std::size_t b : bodies) {
      if (a < b &&
          check.wrong_if(have_contact(scene, a, b), key,
                         "lies where {} and {} meet, which have a contact, so that it would load one or the other; "
                         "expected a position inside one of them",
                         name_of_body(scene, a), name_of_body(scene, b)))
        return;
    }
  }
}

void check_tractions(SceneCheck& check, bool bodies) {
  const Scene& scene = check.scene();
  const std::string box = "give face, a side of the body's box, or ";
  for (std::size_t k = 0; k < scene.tractions.size(); ++k) {
    const std::string name = fmt::format("traction[{}]", k);
    const TractionSpec& traction = scene.tractions[k];
    check.one_of(name, {"value", !traction.value.empty()}, {"pressure", traction.pressure.has_value()},
                 "give either value, which keeps its direction, or pressure, which follows the face",
                 "give value, which keeps its direction, or pressure, which follows the face");
    if (scene.dim == 3) {
      check.one_of(name, {"face", traction.face.has_value()}, {"surface", traction.surface.has_value()},
                   "give either face or surface, not both", box + "surface, of a body that is no box");
    } else {
      check.one_of(name, {"face", traction.face.has_value()}, {"line", !traction.line.empty()},
                   "give either face or line, not both",
                   scene.dim == 2 ? box + "line, a part of its border" : "give face, an end of the body");
    }
    check.refuse_if(!traction.face, name, {"from", "to"}, "goes with a face, of which it loads a part");
    if (bodies) check_surface_of_traction(check, name, traction);
  }
}

/// Supports and loads, of which stages tell by their names, have one name space.
void check_names_of_loads(SceneCheck& check) {
  const Scene& scene = check.scene();
  std::map<std::string, std::string> owners;  // what has a name
  for (const auto* supports : {&scene.supports, &scene.later_supports})
    for (const SupportSpec& support : *supports)
      if (!support.name.empty()) owners.try_emplace(support.name, "support");
  const auto take = [&](const std::string& table, const auto& loads, const char* what) {
    for (std::size_t k = 0; k < loads.size(); ++k) {
      if (loads[k].name.empty()) continue;
      const auto [owner, is_first] = owners.try_emplace(loads[k].name, what);
      if (is_first) continue;
      check.add(
          {.where = scene.location(fmt::format("{}[{}].name", table, k)),
           .message = fmt::format("{}.name: there is a {} {} already; supports and loads have names of their own, "
                                  "by which stages begin and end them",
                                  name_of_load(loads[k]), owner->second, in_quotes(loads[k].name))});
    }
  };
  take("traction", scene.tractions, "traction");
  take("later_traction", scene.later_tractions, "traction");
  take("force", scene.forces, "force");
  take("later_force", scene.later_forces, "force");
}

void check_body_force(SceneCheck& check) {
  const Scene& scene = check.scene();
  check.wrong_if(check.written("body_force") && !check.written("body_force.value") && !check.written("body_force.own"),
                 "body_force", "the key 'value' is missing");
  if (!scene.own_load.empty() && !own_load(scene.own_load))
    check.add("body_force.own", unknown_own_load(scene.own_load));
}

/// Checks the loads of one proportion, which are as large as their displacement makes them.
void check_load_control(SceneCheck& check) {
  const Scene& scene = check.scene();
  check.wrong_if(!scene.load && !scene.later_load && scene.stop.load_growth > 0, "stop.load_growth",
                 "asks for the limit of a load that [load] drives");
  if (!scene.load) return;
  check.wrong_if(scene.load->at > 0 && !scene.present_stage, "load.at",
                 "must be the time of a [[stage]], and there is none at t = {}", scene.load->at);
  const Problem driven = reference_loads(scene);
  const std::vector<std::string> names = names_of_loads(scene);
  check.wrong_if(names.empty(), "load", "drives the loads of a scene, of which there are none");
  for (const std::string& name : scene.load->of)
    if (std::ranges::find(names, name) == names.end())
      check.add("load.of", unknown_word("there is no load", name, names));
  driven.for_each_formula([&](const std::string& key, const Expression& formula) {
    check.wrong_if(key != "load.displacement" && formula.uses('t'), "load",
                   "a load that it drives depends on t ({}); the time belongs into load.displacement", formula.text());
  });
  check.wrong_if(own_load_varies(driven), "load",
                 "a load that it drives, {}, depends on t; the time belongs into load.displacement",
                 in_quotes(scene.own_load));
  check.wrong_if(scene.geostatic && driven.has_body_force(), "initial.geostatic",
                 "is the stress of a weight that acts from the start; [load] drives it, from nothing");
  check.wrong_if(scene.solve.is_static(), "load",
                 "'{}' is a static solver, without the time in which a displacement could drive a load; take "
                 "solve.method = \"relaxation\"",
                 scene.solve.method);
  check.wrong_if(!(scene.stop.time > 0), "stop.time",
                 "expected with [load]: until then the displacement drives the loads");
}

}  // namespace

void check_loads(SceneCheck& check, const std::optional<NamedBox>& body) {
  const Scene& scene = check.scene();
  for (std::size_t k = 0; k < scene.forces.size() && body; ++k) {
    const std::string key = fmt::format("force[{}].at", k);
    check_place_of_force(check, key, scene.forces[k], *body);
    check_body_of_force(check, key, scene.forces[k].at);
  }
  check_tractions(check, body.has_value());
  check_names_of_loads(check);
  check_body_force(check);
  check_load_control(check);
}

}  // namespace stillpoint
