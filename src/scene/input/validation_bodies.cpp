// Bodies: where they lie in the grid, how many points they have, what they are made of.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/body_solid.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/input/validation_solids.hpp"
#include "scene/outline.hpp"

namespace stillpoint {
namespace {

/// True if the body lies in the grid and has a size.
bool check_box(SceneCheck& check, std::size_t k) {
  const GridSpec& grid = check.scene().grid;
  const BodySpec& body = check.scene().bodies[k];
  if (!check.sound(check.body_key(k, "min")) || !check.sound(check.body_key(k, "max"))) return false;
  if (body.min.empty() || body.max.empty()) return false;
  const bool min_inside = check.inside(body.min, grid.min, grid.max, "grid", check.body_key(k, "min"));
  const bool max_inside = check.inside(body.max, grid.min, grid.max, "grid", check.body_key(k, "max"));
  if (!min_inside || !max_inside) return false;
  for (std::size_t axis = 0; axis < body.min.size(); ++axis) {
    if (body.max[axis] > body.min[axis]) continue;
    const std::string max = check.body_key(k, "max"), min = check.body_key(k, "min");
    check.add(check.axis_key(max, axis), fmt::format("must be greater than {} = {}, not {}", check.axis_key(min, axis),
                                                     body.min[axis], body.max[axis]));
    return false;
  }
  return true;
}

/// The same of a polygon.
bool check_polygon(SceneCheck& check, std::size_t k) {
  const GridSpec& grid = check.scene().grid;
  const BodySpec& body = check.scene().bodies[k];
  const std::string key = check.body_key(k, "polygon");
  if (body.polygon.empty()) return check.sound(key) && check_corners(check, k);
  bool inside = true;
  for (std::size_t c = 0; c < body.polygon.size(); ++c)
    inside = check.inside(body.polygon[c], grid.min, grid.max, "grid", fmt::format("{}[{}]", key, c)) && inside;
  return inside && check_corners(check, k);
}

/// What is wrong with the files that bodies name: with a file as a whole it is said where it is named.
void report_files(SceneCheck& check, const std::vector<FileMistake>& files) {
  for (const FileMistake& one : files) {
    const BodySpec& body = check.scene().bodies[one.body];
    const std::string name = (one.key == "stl" ? body.stl : body.file).string();
    if (one.mistake.where.line == 0) {
      check.add(check.body_key(one.body, one.key), fmt::format("{} {}", in_quotes(name), one.mistake.message));
    } else {
      check.add(one.mistake);
    }
  }
}

/// The cells that a body spans along an axis; the whole grid if the body is not in order.
double cells_along(SceneCheck& check, const BodySpec& body, std::size_t axis, bool in_order) {
  return in_order ? (body.max[axis] - body.min[axis]) / check.cell_length(axis) : check.scene().grid.cells[axis];
}

/// Checks the number of points, about.
void check_number_of_points(SceneCheck& check, const std::vector<bool>& in_order) {
  const Scene& scene = check.scene();
  constexpr double most = 5e7;  // about 10 GB of material points
  double all = 0;
  for (std::size_t k = 0; k < scene.bodies.size() && !scene.grid.cells.empty(); ++k) {
    const BodySpec& body = scene.bodies[k];
    if (!body.file.empty()) continue;
    double points = in_order[k] ? share_of_box(body) : 1;
    for (std::size_t axis = 0; axis < scene.grid.cells.size(); ++axis)
      points *= cells_along(check, body, axis, in_order[k]) * body.points_per_cell[axis];
    all += points;
    if (all > most)
      return check.add(check.body_key(k, "points_per_cell"),
                       fmt::format("{:.3g} material points are more than this program takes ({:g})", all, most));
  }
}

void check_material(SceneCheck& check, std::size_t k) {
  const Scene& scene = check.scene();
  const std::string& name = scene.bodies[k].material;
  if (name.empty()) return;
  const auto found = scene.materials.find(name);
  if (found == scene.materials.end()) {
    std::vector<std::string> names;
    for (const auto& material : scene.materials) names.push_back(material.first);
    check.add(check.body_key(k, "material"),
              names.empty()
                  ? fmt::format("there is no material {}; describe it in a table [material.<name>]", in_quotes(name))
                  : unknown_word("there is no material", name, names));
    return;
  }
  const LawInfo* const law = law_of(check, found->second);
  if (!law || std::ranges::find(law->states, scene.state) != law->states.end()) return;
  std::vector<std::string_view> states;
  for (const StressState state : law->states) states.push_back(to_string(state));
  check.add(check.body_key(k, "material"), fmt::format("law '{}' has no state '{}'; it has {}", law->name,
                                                       to_string(scene.state), fmt::join(states, ", ")));
}

/// A material that dilates more than it rubs would create energy.
void check_dilation(SceneCheck& check, const MaterialSpec& material) {
  const auto phi = material.parameters.find("phi"), psi = material.parameters.find("psi");
  if (phi == material.parameters.end() || psi == material.parameters.end()) return;
  if (psi->second <= phi->second) return;
  check.add(fmt::format("material.{}.psi", material.name),
            fmt::format("must be at most phi = {}, not {}", phi->second, psi->second));
}

/// Keys of a body that exclude each other.
void check_keys(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  std::string table = check.body_key(k, "");
  table.pop_back();
  if (check.written(table + ".file")) {
    check.refuse(table,
                 {"min", "max", "polygon", "sphere", "cylinder", "stl", "area", "thickness", "points_per_cell",
                  "placement", "jitter", "volumes", "seed"},
                 "does not go with file, which holds the points and their volumes");
  } else if (check.written(table + ".polygon") && check.scene().dim == 2) {
    check.refuse(table, {"min", "max"}, "does not go with polygon; give one of them");
  }
  check_shape_keys(check, table);
  if (body.jitter > 0 && body.placement == Placement::random)
    check.add(table + ".jitter", "does not go with placement = \"random\": random points have no spacing");
  if (body.state && *body.state != check.scene().state) check.add(table + ".state", "must be the same in all bodies");
  if (check.scene().state == StressState::axisymmetric)
    check.refuse(table, {"thickness"}, "an axisymmetric body goes all the way round and has none");
}

}  // namespace

std::optional<BodyBox> check_bodies(SceneCheck& check, bool grid, const std::vector<FileMistake>& files) {
  const Scene& scene = check.scene();
  const std::size_t count = scene.bodies.size();
  constexpr std::size_t most = 10'000;  // that can be compared two by two
  if (count > most) {
    check.add("body", fmt::format("{} bodies are more than this program takes ({})", count, most));
    return std::nullopt;
  }
  report_files(check, files);
  std::vector<bool> in_order(count, false);
  for (std::size_t k = 0; k < count; ++k) {
    if (!scene.bodies[k].file.empty()) {
      in_order[k] = grid && std::ranges::find(files, k, &FileMistake::body) == files.end();
    } else if (scene.dim == 2 && check.given(check.body_key(k, "polygon"), !scene.bodies[k].polygon.empty())) {
      in_order[k] = grid && check_polygon(check, k);
    } else if (scene.dim == 3 && has_shape_key(check, k)) {
      in_order[k] = grid && check_box(check, k) && check_solid(check, k);
    } else {
      in_order[k] = grid && check_box(check, k);
    }
    check_keys(check, k);
    check_material(check, k);
  }
  for (const auto& [name, material] : scene.materials) check_dilation(check, material);
  if (grid) check_number_of_points(check, in_order);

  if (count == 0 || std::ranges::find(in_order, false) != in_order.end()) return std::nullopt;
  if (check.problems().empty()) check_overlaps(check);
  auto [min, max] = box_around(scene.bodies);
  return BodyBox{std::move(min), std::move(max), count == 1 ? "body" : "bodies"};
}

long known_points(SceneCheck& check) {
  const Scene& scene = check.scene();
  long all = 0;
  for (const BodySpec& body : scene.bodies) {
    if (!body.is_box()) return 0;
    long points = scene.grid.cells.empty() ? 0 : 1;
    for (std::size_t axis = 0; axis < scene.grid.cells.size(); ++axis) {
      const double before = (body.min[axis] - scene.grid.min[axis]) / check.cell_length(axis);
      const double cells = cells_along(check, body, axis, /*in_order=*/true);
      const auto is_whole = [](double number) { return std::abs(number - std::round(number)) <= kSliver; };
      if (!is_whole(before) || !is_whole(before + cells)) return 0;
      points *= std::lround(cells) * body.points_per_cell[axis];
    }
    all += points;
  }
  return all;
}

}  // namespace stillpoint
