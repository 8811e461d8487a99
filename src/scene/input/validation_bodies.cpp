// Checks of the bodies: keys that go together, positions in the grid, numbers of points, and that their materials are
// there.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/body_solid.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

/// True if the body lies in the grid and has a size.
bool check_box(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string min = check.body_key(k, "min"), max = check.body_key(k, "max");
  if (!check.sound(min) || !check.sound(max) || body.min.empty() || body.max.empty()) return false;
  const bool min_inside = check.inside(body.min, check.grid_box(), min);
  if (!check.inside(body.max, check.grid_box(), max) || !min_inside) return false;
  for (std::size_t axis = 0; axis < body.min.size(); ++axis)
    if (check.wrong_if(!(body.max[axis] > body.min[axis]), check.axis_key(max, axis),
                       "must be greater than {} = {}, not {}", check.axis_key(min, axis), body.min[axis],
                       body.max[axis]))
      return false;
  return true;
}

/// True if a mesh in the plane lies in the grid; what is wrong with its file was reported.
bool check_mesh(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  if (body.polygon.empty()) return false;
  const GridSpec& grid = check.scene().grid;
  for (std::size_t d = 0; d < 2; ++d)
    if (check.wrong_if(body.min[d] < grid.min[d] || body.max[d] > grid.max[d], check.body_key(k, "mesh"),
                       "reaches from {:.6g} to {:.6g} along {}, out of the grid, {} to {}", body.min[d], body.max[d],
                       "xy"[d], grid.min[d], grid.max[d]))
      return false;
  return true;
}

/// True if the corners of a polygon lie in the grid and enclose an area.
bool check_polygon(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string key = check.body_key(k, "polygon");
  bool inside = !body.polygon.empty() || check.sound(key);
  for (std::size_t c = 0; c < body.polygon.size(); ++c)
    inside = check.inside(body.polygon[c], check.grid_box(), fmt::format("{}[{}]", key, c)) && inside;
  return inside && check_corners(check, k);
}

/// Reports what is wrong with the files that bodies and rigid bodies name; a fault of a file as a whole is reported at
/// the key.
void report_files(SceneCheck& check, const std::vector<FileMistake>& files) {
  for (const FileMistake& one : files) {
    const std::string table =
        one.owner == FileMistake::Owner::body ? check.body_table(one.number) : fmt::format("rigid[{}]", one.number);
    if (!check.wrong_if(one.mistake.where.line == 0, table + "." + one.key, "{} {}", in_quotes(one.file.string()),
                        one.mistake.message))
      check.add(one.mistake);
  }
}

/// The cells that a body spans along an axis; the whole grid if the body is not in order.
double cells_along(SceneCheck& check, const BodySpec& body, std::size_t axis, bool in_order) {
  const GridSpec& grid = check.scene().grid;
  return in_order ? cells_between(grid, axis, body.min[axis], body.max[axis]) : grid.cells[axis];
}

/// Checks the approximate number of points.
void check_number_of_points(SceneCheck& check, const std::vector<bool>& in_order) {
  const Scene& scene = check.scene();
  constexpr double most = 5e7;  // about 10 GB of material points
  double all = 0;
  for (std::size_t k = 0; k < scene.bodies.size() && !scene.grid.cells.empty() && all <= most; ++k) {
    const BodySpec& body = scene.bodies[k];
    if (!body.file.empty()) continue;
    double points = in_order[k] ? share_of_box(body) : 1;
    for (std::size_t axis = 0; axis < scene.grid.cells.size(); ++axis)
      points *= cells_along(check, body, axis, in_order[k]) * body.points_per_cell[axis];
    all += points;
    check.wrong_if(all > most, check.body_key(k, "points_per_cell"),
                   "{:.3g} material points are more than this program takes ({:g})", all, most);
  }
}

void check_material(SceneCheck& check, std::size_t k) {
  const Scene& scene = check.scene();
  const std::string& name = scene.bodies[k].material;
  if (name.empty()) return;
  const std::string key = check.body_key(k, "material");
  const auto found = scene.materials.find(name);
  if (found == scene.materials.end()) {
    std::vector<std::string> names;
    for (const auto& material : scene.materials) names.push_back(material.first);
    return check.add_unknown(key, "material", "[material.<name>]", name, names);
  }
  const LawInfo* const law = check.catalogue().law(found->second.law);
  const std::string why = law ? why_no_state(fmt::format("law '{}'", law->name), law->states, scene.state) : "";
  check.wrong_if(!why.empty(), key, "{}", why);
}

/// Keys of a body that exclude each other, or need one another.
void check_keys(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string table = check.body_table(k);
  const auto written = [&](const char* key) { return check.written(table + "." + key); };
  const bool file = written("file"), polygon = written("polygon"), sphere = written("sphere");
  const bool mesh = written("mesh"), round = sphere || written("cylinder"),
             axisymmetric = check.scene().state == StressState::axisymmetric;
  check.refuse_if(file, table,
                  {"min", "max", "polygon", "sphere", "cylinder", "stl", "mesh", "area", "thickness", "points_per_cell",
                   "placement", "jitter", "volumes", "seed"},
                  "does not go with file, which holds the points and their volumes");
  check.refuse_if(!file && polygon && check.scene().dim == 2, table, {"min", "max"},
                  "does not go with polygon; give one of them");
  constexpr const char* one_shape = "does not go with {}; a body has one shape";
  check.refuse_if(!file && polygon, table, {"sphere", "cylinder", "stl", "mesh"}, one_shape, "polygon");
  check.refuse_if(!file && !polygon && sphere, table, {"cylinder", "stl", "mesh"}, one_shape, "sphere");
  check.refuse_if(!file && !polygon && !sphere && round, table, {"stl", "mesh"}, one_shape, "cylinder");
  check.refuse_if(!file && !polygon && !round && written("stl"), table, {"mesh"}, one_shape, "stl");
  check.refuse_if(mesh && check.scene().dim == 2, table, {"min", "max"}, "does not go with mesh; give one of them");
  check.refuse_if(!mesh, table, {"group"}, "goes with mesh, of which it is a physical group");
  check.wrong_if(round && !written("radius"), table + (sphere ? ".sphere" : ".cylinder"), "needs a radius");
  check.refuse_if(!round, table, {"radius", "inner_radius"}, "goes with sphere or cylinder");
  check.refuse_if(!polygon, table, {"axis"}, "goes with polygon, which is drawn out along it");
  check.wrong_if(body.jitter > 0 && body.placement == Placement::random, table + ".jitter",
                 "does not go with placement = \"random\": random points have no spacing");
  check.wrong_if(body.state && *body.state != check.scene().state, table + ".state", "must be the same in all bodies");
  check.refuse_if(axisymmetric, table, {"thickness"}, "an axisymmetric body goes all the way round and has none");
}

/// True if the body, in a grid that is in order, has a volume there.
bool is_in_order(SceneCheck& check, std::size_t k, const std::vector<FileMistake>& files) {
  const BodySpec& body = check.scene().bodies[k];
  if (!body.file.empty()) return std::ranges::none_of(files, [k](const FileMistake& one) { return one.is_of_body(k); });
  if (check.scene().dim == 2 && !body.mesh.empty()) return check_mesh(check, k);
  if (check.scene().dim == 2 && check.given(check.body_key(k, "polygon"), !body.polygon.empty()))
    return check_polygon(check, k);
  return check_box(check, k) && (check.scene().dim != 3 || !has_shape_key(check, k) || check_solid(check, k));
}

}  // namespace

std::optional<NamedBox> check_bodies(SceneCheck& check, bool grid, const std::vector<FileMistake>& files) {
  const Scene& scene = check.scene();
  const std::size_t count = scene.bodies.size();
  constexpr std::size_t most = 10'000;  // that can be compared two by two
  if (check.wrong_if(count > most, "body", "{} bodies are more than this program takes ({})", count, most))
    return std::nullopt;
  report_files(check, files);
  std::vector<bool> in_order(count, false);
  for (std::size_t k = 0; k < count; ++k) {
    in_order[k] = grid && is_in_order(check, k, files);
    check_keys(check, k);
    check_material(check, k);
  }
  for (std::size_t k = 0; k < count; ++k) check.contact_name(scene.bodies[k].name, check.body_key(k, "name"));
  check.unique_names("body", scene.bodies);
  check_materials(check);
  if (grid) check_number_of_points(check, in_order);

  if (count == 0 || std::ranges::find(in_order, false) != in_order.end()) return std::nullopt;
  if (check.problems().empty()) check_overlaps(check);
  auto [min, max] = box_around(scene.bodies);
  return NamedBox{std::move(min), std::move(max), count == 1 ? "body" : "bodies"};
}

long known_points(SceneCheck& check) {
  const Scene& scene = check.scene();
  long all = 0;
  for (const BodySpec& body : scene.bodies) {
    if (!body.is_box()) return 0;
    long points = scene.grid.cells.empty() ? 0 : 1;
    for (std::size_t axis = 0; axis < scene.grid.cells.size(); ++axis) {
      const double before = cells_before(scene.grid, axis, body.min[axis]);
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
