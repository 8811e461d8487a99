// What holds, pushes and loads the bodies, and the stress that they begin with.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/border_line.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

/// At most one support or wall stands on a face of the grid, or a support for each component that is named.
void check_faces(SceneCheck& check) {
  const Scene& scene = check.scene();
  constexpr int all = -1;  // components
  std::map<std::pair<Face, int>, std::string> owners;
  const auto take = [&](Face face, const std::string& owner, int component) {
    for (int other = all; other < scene.dim; ++other) {
      const auto before = owners.find({face, other});
      if (before != owners.end() && (component == all || other == all || component == other))
        return check.add(owner + ".face", fmt::format("{} stands on this face already", before->second));
    }
    owners.emplace(std::pair{face, component}, owner);
  };
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    const SupportSpec& support = scene.supports[k];
    const std::string name = fmt::format("support[{}]", k);
    if (support.face) take(*support.face, name, check.written(name + ".component") ? support.component : all);
  }
  for (std::size_t k = 0; k < scene.walls.size(); ++k)
    if (const std::string wall = fmt::format("wall[{}]", k);
        check.written(wall + ".face") && check.sound(wall + ".face"))
      take(scene.walls[k].face, wall, all);
}

void check_supports(SceneCheck& check, bool grid) {
  Scene& scene = check.scene();
  std::map<std::pair<std::vector<double>, int>, std::size_t> owners;  // of positions and components
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    SupportSpec& support = scene.supports[k];
    const std::string name = fmt::format("support[{}]", k);
    const bool whole_face = check.written(name + ".face") && !check.written(name + ".component");
    check.one_of(name, "at", "face", "give either at or face, not both",
                 "give at, a position, or face, a side of the grid");
    if (!whole_face)
      check.refuse(name, {"kind"},
                   "goes with a face as a whole; component says what is held otherwise, or at a position");
    if (!grid || support.at.empty()) continue;
    check.inside(support.at, scene.grid.min, scene.grid.max, "grid", name + ".at");
    const auto [owner, is_first] = owners.try_emplace({support.at, support.component}, k);
    if (!is_first) check.add(name + ".at", fmt::format("support[{}] holds this position already", owner->second));
  }
}

void check_walls(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (!scene.walls.empty() && scene.mass.kind != MassKind::lumped)
    check.add("wall[0]", "a wall stops node by node, which needs mass.kind = \"lumped\"");
  for (std::size_t k = 0; k < scene.walls.size() && scene.dim == 1; ++k)
    if (scene.walls[k].friction > 0) check.add(fmt::format("wall[{}].friction", k), "there is none in one dimension");
  const std::set<std::string> names = check.unique_names("wall", scene.walls);
  // A wall without a name has been reported, and may be the one that the grid follows.
  if (std::ranges::find(scene.walls, "", &WallSpec::name) != scene.walls.end()) return;
  const std::string& follow = scene.grid.follow;
  if (follow.empty() || names.contains(follow)) return;
  check.add("grid.follow", names.empty()
                               ? fmt::format("there is no wall {}; describe it in a table [[wall]]", in_quotes(follow))
                               : unknown_word("there is no wall", follow, {names.begin(), names.end()}));
}

/// The side that a line lies on.
void check_line(SceneCheck& check, const std::string& key, const std::vector<std::vector<double>>& line) {
  if (line.size() != 2) return check.add(key, fmt::format("must be two positions, [from, to], not {}", line.size()));
  const std::array<double, 2> from{line[0][0], line[0][1]}, to{line[1][0], line[1][1]};
  if (from == to) return check.add(key, "the two positions are the same");
  const std::vector<BorderLine> sides = border_lines(check.scene(), from, to);
  if (sides.empty())
    check.add(key,
              "no straight side of a box or a polygon holds both positions; expected positions on its border, with "
              "no corner between them");
  if (sides.size() > 1)
    check.add(key, fmt::format("bodies {} and {} touch here, so that nothing can load one of them", sides[0].body + 1,
                               sides[1].body + 1));
}

void check_tractions(SceneCheck& check, bool bodies) {
  const Scene& scene = check.scene();
  const bool box = scene.bodies.size() == 1 && scene.bodies[0].polygon.empty() && scene.bodies[0].file.empty();
  for (std::size_t k = 0; k < scene.tractions.size(); ++k) {
    const std::string name = fmt::format("traction[{}]", k);
    check.one_of(name, "value", "pressure",
                 "give either value, which keeps its direction, or pressure, which follows the face",
                 "give value, which keeps its direction, or pressure, which follows the face");
    check.one_of(name, "face", "line", "give either face or line, not both",
                 scene.dim == 1 ? "give face, an end of the body"
                                : "give face, a side of the body's box, or line, a part of its border");
    if (!bodies) continue;
    if (check.written(name + ".line") && check.sound(name + ".line"))
      check_line(check, name + ".line", scene.tractions[k].line);
    if (!check.written(name + ".face") || box) continue;
    const std::string what = scene.bodies.size() > 1        ? fmt::format("are {} bodies", scene.bodies.size())
                             : scene.bodies[0].file.empty() ? "is a polygon"
                                                            : "are points from a file";
    check.add(name, fmt::format("needs a scene with one body that is a box, which has faces; there {}; give line = "
                                "[from, to]",
                                what));
  }
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
  if (scene.dim != 2) return check.add(key, "a level surface needs two dimensions");
  if (!scene.initial_u.empty())
    check.add("initial.u", "does not go with initial.geostatic, which is the stress of the undeformed body");
  const auto& b = scene.body_force;
  if (b.size() != 2) {
    if (!check.written("body_force")) check.add(key, "needs a [body_force]: the weight that the stress bears");
  } else if (!b[0].constant() || !b[1].constant() || b[0]({}, 0) != 0) {
    check.add("body_force.value", "must be constant and vertical, [0, b], if initial.geostatic is asked for");
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
  if (body && check.written(key + ".surface") && scene.geostatic->surface < body->max[1])
    check.add(key + ".surface", fmt::format("must not lie below the top of the {} at {}, not {}", body->name,
                                            body->max[1], scene.geostatic->surface));
}

}  // namespace

void check_loads(SceneCheck& check, bool grid, const std::optional<BodyBox>& body) {
  Scene& scene = check.scene();
  check_faces(check);
  check_supports(check, grid);
  check_walls(check);
  for (std::size_t k = 0; k < scene.forces.size() && body; ++k)
    check.inside(scene.forces[k].at, body->min, body->max, body->name, fmt::format("force[{}].at", k));
  check_tractions(check, body.has_value());
  check_geostatic(check, body);
}

}  // namespace stillpoint
