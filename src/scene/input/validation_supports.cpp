// What holds and pushes the bodies: supports and walls.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/face_interval_check.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/support_kind.hpp"

namespace stillpoint {
namespace {

/// What stands on a face of the grid.
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
    for (const FaceOwner& before : owners)
      if (before.meets(owner))
        return check.add(owner.name + ".face", fmt::format("{} stands on this face already", before.name));
    owners.push_back(owner);
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

/// The same of a support, and on nodes if these are what is held.
void check_part(SceneCheck& check, const std::string& name, const SupportSpec& support, const FaceInterval& part,
                std::size_t k) {
  const GridSpec& grid = check.scene().grid;
  const std::size_t along = part.along;
  if (!check_interval(check, name, part, k, grid.min[along], grid.max[along], "grid")) return;
  if (holds_by_springs(grid, support)) return;
  for (const char* key : {".from", ".to"}) {
    const double end = key[1] == 'f' ? part.from : part.to;
    if (is_on_line(grid, along, end)) continue;
    const double cells = (end - grid.min[along]) / grid.cell_length(along);
    const int below = std::clamp(static_cast<int>(std::floor(cells)), 0, grid.cells[along] - 1);
    check.add(end_key(check, name, key, k),
              fmt::format("{:g} is no node of the grid, whose nodes are what is held; expected {:g} or {:g}, a "
                          "quadratic or cubic basis, or a stiffness, by which springs hold any part",
                          end, line_position(grid, along, below), line_position(grid, along, below + 1)));
  }
}

/// A motion that varies along a face takes values of its own at the nodes there, or springs.
void check_varying_motion(SceneCheck& check, const std::string& name, const SupportSpec& support) {
  const BasisKind basis = check.scene().grid.basis;
  if (!support.face || !support.motion.uses_position() || check.scene().dim == 1) return;
  if (basis == BasisKind::linear || holds_by_springs(check.scene().grid, support)) return;
  check.add(name + ".u",
            fmt::format("varies along the face, where {}; expected a linear basis, or a stiffness, by which springs "
                        "hold each place",
                        basis == BasisKind::hermite
                            ? "a hermite basis has slopes as unknowns besides"
                            : "the unknowns of a quadratic or cubic basis are no values at positions"));
}

void check_supports(SceneCheck& check, bool grid) {
  const Scene& scene = check.scene();
  std::map<std::pair<std::vector<double>, int>, std::size_t> owners;  // of positions and components
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    const SupportSpec& support = scene.supports[k];
    const std::string name = fmt::format("support[{}]", k);
    const bool whole_face = check.given(name + ".face", support.face.has_value()) &&
                            !check.given(name + ".component", support.component.is_asked());
    if (support.component.asked().value_or(0) >= 3 && scene.state != StressState::axisymmetric)
      check.add(name + ".component", "r and z are the axes of an axisymmetric scene; expected x or y");
    check.one_of(name, {"at", !support.at.empty()}, {"face", support.face.has_value()},
                 "give either at or face, not both", "give at, a position, or face, a side of the grid");
    if (!whole_face)
      check.refuse(name, {"kind"},
                   "goes with a face as a whole; component says what is held otherwise, or at a position");
    if (!support.face) check.refuse(name, {"from", "to"}, "goes with a face, of which it holds a part");
    if (scene.dim == 1 && support.face)
      check.refuse(name, {"stiffness"}, "goes with a position in one dimension: give at in place of face");
    if (grid && !scene.grid.cells.empty() && scene.dim > 1 && support.face && support.on_part() &&
        check.sound(name + ".from") && check.sound(name + ".to")) {
      const std::vector<FaceInterval> part = held_part(scene.grid, support);
      for (std::size_t axis = 0; axis < part.size(); ++axis) check_part(check, name, support, part[axis], axis);
    }
    check_varying_motion(check, name, support);
    if (!grid || support.at.empty()) continue;
    check.inside(support.at, scene.grid.min, scene.grid.max, "grid", name + ".at");
    const auto [owner, is_first] = owners.try_emplace({support.at, support.component}, k);
    if (!is_first) check.add(name + ".at", fmt::format("support[{}] holds this position already", owner->second));
  }
  check.unique_names("support", scene.supports);
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

}  // namespace

std::string end_key(const SceneCheck& check, const std::string& name, const char* end, std::size_t k) {
  return check.scene().dim == 2 ? name + end : fmt::format("{}{}[{}]", name, end, k);
}

bool check_interval(SceneCheck& check, const std::string& name, const FaceInterval& part, std::size_t k, double min,
                    double max, const char* box) {
  bool inside = true;
  for (const char* key : {".from", ".to"}) {
    const double end = key[1] == 'f' ? part.from : part.to;
    if (end >= min && end <= max) continue;
    check.add(end_key(check, name, key, k),
              fmt::format("{:g} lies outside the {}, whose face reaches from {:g} to {:g}", end, box, min, max));
    inside = false;
  }
  if (!inside || part.from < part.to) return inside;
  check.add(end_key(check, name, check.written(name + ".to") ? ".to" : ".from", k),
            fmt::format("the part from {:g} to {:g} is empty; expected from < to", part.from, part.to));
  return false;
}

void check_supports_and_walls(SceneCheck& check, bool grid) {
  check_faces(check);
  check_supports(check, grid);
  check_walls(check);
}

}  // namespace stillpoint
