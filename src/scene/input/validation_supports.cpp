// Checks of the supports and walls that hold and push the bodies.
#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

/// A support or a wall on a face of the grid.
struct FaceOwner {
  std::string name;
  Face face;
  int component;  // −1: all
  std::vector<FaceInterval> part;

  bool meets(const FaceOwner& other) const {
    bool meet = face == other.face && (component < 0 || other.component < 0 || component == other.component);
    for (std::size_t k = 0; k < std::min(part.size(), other.part.size()); ++k)
      meet = meet && part[k].from < other.part[k].to && other.part[k].from < part[k].to;
    return meet;
  }
};

/// At most one support or wall stands on a part of a face of the grid, or a support for each component that is named.
void check_faces(SceneCheck& check) {
  const Scene& scene = check.scene();
  std::vector<FaceOwner> owners;
  const auto take = [&](const FaceOwner& owner) {
    const auto before = std::ranges::find_if(owners, [&](const FaceOwner& other) { return other.meets(owner); });
    if (before == owners.end()) return owners.push_back(owner);
    check.add(owner.name + ".face", fmt::format("{} stands on this face already", before->name));
  };
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    const SupportSpec& support = scene.supports[k];
    const std::string name = fmt::format("support[{}]", k);
    if (!support.face) continue;
    const std::vector<double> least(static_cast<std::size_t>(scene.dim), -kInfinity), most(least.size(), kInfinity);
    take({name, *support.face,
          check.given(name + ".component", support.component.is_asked()) ? support.component.value() : -1,
          part_of_face(*support.face, support.from, support.to, least, most)});
  }
  for (std::size_t k = 0; k < scene.walls.size(); ++k)
    if (const std::string wall = fmt::format("wall[{}]", k); check.sound(wall + ".face"))
      take({wall, scene.walls[k].face, -1, {}});
}

/// The held part of a face lies on the face, and ends at nodes if these are what is held.
void check_part(SceneCheck& check, const std::string& name, const SupportSpec& support, const FaceInterval& part,
                std::size_t k) {
  const GridSpec& grid = check.scene().grid;
  const std::size_t along = part.along;
  if (!check.check_interval(name, part, k, check.grid_box()) || holds_by_springs(grid, support)) return;
  for (const auto& [key, end] : {std::pair(".from", part.from), {".to", part.to}}) {
    const int below = cell_at(grid, along, end);
    check.wrong_if(!is_on_line(grid, along, end), check.end_key(name, key, k),
                   "{:g} is no node of the grid, whose nodes are what is held; expected {:g} or {:g}, a quadratic or "
                   "cubic basis, or a stiffness, by which springs hold any part",
                   end, line_position(grid, along, below), line_position(grid, along, below + 1));
  }
}

/// A motion that varies along a face takes values alone as unknowns there, or springs.
void check_varying_motion(SceneCheck& check, const std::string& name, const SupportSpec& support) {
  const GridSpec& grid = check.scene().grid;
  if (!support.face || !support.motion.uses_position() || check.scene().dim == 1) return;
  check.wrong_if(
      grid.basis == BasisKind::hermite && !holds_by_springs(grid, support), name + ".u",
      "varies along the face, where a hermite basis has slopes as unknowns besides; expected another basis, or a "
      "stiffness, by which springs hold each place");
}

void check_supports(SceneCheck& check, bool grid) {
  const Scene& scene = check.scene();
  std::map<std::pair<std::vector<double>, int>, std::size_t> owners;  // of positions and components
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    const SupportSpec& support = scene.supports[k];
    const std::string name = fmt::format("support[{}]", k);
    const bool whole_face = check.given(name + ".face", support.face.has_value()) &&
                            !check.given(name + ".component", support.component.is_asked());
    check.wrong_if(support.component.asked().value_or(0) >= 3 && scene.state != StressState::axisymmetric,
                   name + ".component", "r and z are the axes of an axisymmetric scene; expected x or y");
    check.one_of(name, {"at", !support.at.empty()}, {"face", support.face.has_value()},
                 "give either at or face, not both", "give at, a position, or face, a side of the grid");
    check.refuse_if(!whole_face, name, {"kind"},
                    "goes with a face as a whole; component says what is held otherwise, or at a position");
    check.refuse_if(!support.face, name, {"from", "to"}, "goes with a face, of which it holds a part");
    check.refuse_if(scene.dim == 1 && support.face, name, {"stiffness"},
                    "goes with a position in one dimension: give at in place of face");
    if (grid && !scene.grid.cells.empty() && scene.dim > 1 && support.face && support.on_part() &&
        check.sound(name + ".from") && check.sound(name + ".to")) {
      const std::vector<FaceInterval> part = held_part(scene.grid, support);
      for (std::size_t axis = 0; axis < part.size(); ++axis) check_part(check, name, support, part[axis], axis);
    }
    check_varying_motion(check, name, support);
    if (!grid || support.at.empty()) continue;
    check.inside(support.at, check.grid_box(), name + ".at");
    const auto [owner, is_first] = owners.try_emplace({support.at, support.component}, k);
    check.wrong_if(!is_first, name + ".at", "support[{}] holds this position already", owner->second);
  }
  check.unique_names("support", scene.supports);
}

void check_walls(SceneCheck& check) {
  const Scene& scene = check.scene();
  check.wrong_if(!scene.walls.empty() && scene.mass.kind != MassKind::lumped, "wall[0]",
                 "a wall stops node by node, which needs mass.kind = \"lumped\"");
  for (std::size_t k = 0; k < scene.walls.size(); ++k)
    check.wrong_if(scene.dim == 1 && scene.walls[k].friction > 0, fmt::format("wall[{}].friction", k),
                   "there is none in one dimension");
  const std::set<std::string> names = check.unique_names("wall", scene.walls);
  // A wall without a name has been reported, and may be the one that the grid follows.
  if (std::ranges::find(scene.walls, "", &WallSpec::name) != scene.walls.end()) return;
  if (const std::string& follow = scene.grid.follow; !follow.empty() && !names.contains(follow))
    check.add_unknown("grid.follow", "wall", "[[wall]]", follow, {names.begin(), names.end()});
}

}  // namespace

void check_supports_and_walls(SceneCheck& check, bool grid) {
  check_faces(check);
  check_supports(check, grid);
  check_walls(check);
}

}  // namespace stillpoint
