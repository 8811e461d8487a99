// What holds, pushes and loads the bodies, and the stress that they begin with.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/input/toml_reader.hpp"

namespace stillpoint {
namespace {

void check_supports(SceneCheck& check) {
  Scene& scene = check.scene();
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    SupportSpec& support = scene.supports[k];
    const std::string key = fmt::format("support[{}].at", k);
    check.inside(support.at, scene.grid.min, scene.grid.max, "grid", key);
    for (std::size_t before = 0; before < k && !support.at.empty(); ++before)
      if (scene.supports[before].at == support.at && scene.supports[before].component == support.component)
        check.add(key, fmt::format("support[{}] holds this place already", before));
  }
}

void check_walls(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (!scene.walls.empty() && scene.mass.kind != MassKind::lumped)
    check.add("wall[0]", "a wall stops node by node, which needs mass.kind = \"lumped\"");
  std::set<std::string> names;
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const std::string& name = scene.walls[k].name;
    if (name.empty()) return;  // has been said, and may be the one that the grid follows
    if (!names.insert(name).second)
      check.add(fmt::format("wall[{}].name", k), fmt::format("there is a wall {} already", in_quotes(name)));
  }
  const std::string& follow = scene.grid.follow;
  if (follow.empty() || names.contains(follow)) return;
  check.add("grid.follow", names.empty()
                               ? fmt::format("there is no wall {}; describe it in a table [[wall]]", in_quotes(follow))
                               : unknown_word("there is no wall", follow, {names.begin(), names.end()}));
}

void check_tractions(SceneCheck& check) {
  const Scene& scene = check.scene();
  const bool box = scene.bodies.size() == 1 && scene.bodies[0].polygon.empty() && scene.bodies[0].file.empty();
  for (std::size_t k = 0; k < scene.tractions.size() && !box; ++k)
    check.add(fmt::format("traction[{}]", k),
              fmt::format("needs a scene with one body that is a box, which has faces; there {}",
                          scene.bodies.size() > 1        ? fmt::format("are {} bodies", scene.bodies.size())
                          : scene.bodies[0].file.empty() ? "is a polygon"
                                                         : "are points from a file"));
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
    check.add("body_force.value", "must be constant and vertical, [0, b], where initial.geostatic is asked for");
  }
  for (const BodySpec& spec : scene.bodies) {
    const auto material = scene.materials.find(spec.material);
    if (material == scene.materials.end() || material->second.law.empty() || has_history(material->second)) continue;
    check.add(fmt::format("material.{}.law", material->first),
              fmt::format("initial.geostatic needs a law that keeps a stress, such as drucker-prager; the stress of "
                          "'{}' is 0 where nothing is deformed",
                          material->second.law));
    break;
  }
  if (body && check.written(key + ".surface") && scene.geostatic->surface < body->max[1])
    check.add(key + ".surface", fmt::format("must not lie below the top of the {} at {}, not {}", body->name,
                                            body->max[1], scene.geostatic->surface));
}

}  // namespace

void check_loads(SceneCheck& check, bool grid, const std::optional<BodyBox>& body) {
  Scene& scene = check.scene();
  if (grid) check_supports(check);
  check_walls(check);
  for (std::size_t k = 0; k < scene.forces.size() && body; ++k)
    check.inside(scene.forces[k].at, body->min, body->max, body->name, fmt::format("force[{}].at", k));
  check_tractions(check);
  check_geostatic(check, body);
}

}  // namespace stillpoint
