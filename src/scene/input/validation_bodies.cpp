// Checks of the bodies: keys that go together, positions in the grid, numbers of points, and materials.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/body_solid.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/pore_water.hpp"

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

/// A material that dilates more than it rubs would create energy.
void check_dilation(SceneCheck& check, const MaterialSpec& material) {
  constexpr const char* fault = "must be at most phi = {}, not {}";
  const auto phi = material.parameters.find("phi"), psi = material.parameters.find("psi");
  if (phi == material.parameters.end() || psi == material.parameters.end()) return;
  check.wrong_if(psi->second > phi->second, fmt::format("material.{}.psi", material.name), fault, phi->second,
                 psi->second);
  for (std::size_t k = 0; k < material.softening.size(); ++k) {
    const StrengthRow& row = material.softening[k];
    check.wrong_if(row.psi > row.phi, fmt::format("material.{}.softening[{}][3]", material.name, k), fault, row.phi,
                   row.psi);
  }
}

/// Water fills the pores of all directions: a side that is free to contract would need a law of its own.
void check_change_of_volume(SceneCheck& check, const std::string& key, bool is_elastic) {
  using enum StressState;
  std::vector<StressState> states = {plane_strain, axisymmetric, space};
  if (is_elastic) states.insert(states.begin(), uniaxial_strain);
  const std::string why = why_no_state("undrained ground", states, check.scene().state);
  check.wrong_if(!why.empty(), key, "{}", why);
}

void check_water(SceneCheck& check, const MaterialSpec& material) {
  const auto key = [&](const char* name) { return fmt::format("material.{}.{}", material.name, name); };
  for (const char* name : {"water_modulus", "porosity", "undrained_dilatancy"})
    check.wrong_if(!material.undrained && check.written(key(name)), key(name), "goes with undrained = true");
  check.wrong_if(material.undrained && check.written(key("porosity")) && !material.water_modulus, key("porosity"),
                 "goes with water_modulus");
  if (!material.undrained) return;
  const LawInfo* const law = check.catalogue().law(material.law);
  const bool is_elastic = law && !law->history_dependent;
  check_change_of_volume(check, key("undrained"), is_elastic);
  // The stress of an elastic law is proportional to E, with its water only if that is so as well.
  check.wrong_if(is_elastic && material.water_modulus && material.by_place.contains("E"), key("water_modulus"),
                 "does not go with an E that is a formula of the position: with '{}' water is as much stiffer as the "
                 "skeleton is, so that the undrained Poisson's ratio is 0.495 everywhere",
                 material.law);
  check.wrong_if(!is_elastic && !material.water_modulus && material.by_place.contains("E"), key("undrained"),
                 "needs a water_modulus beside an E that is a formula of the position");
  check.wrong_if(!material.water_modulus && !has_E_and_nu(material), key("undrained"),
                 "needs a water_modulus: with a law that has no E and nu there is no undrained Poisson's ratio");
  double psi = 0;
  if (const auto found = material.parameters.find("psi"); found != material.parameters.end()) psi = found->second;
  for (const StrengthRow& row : material.softening) psi = std::max(psi, row.psi);
  check.wrong_if(
      psi > 0 && !material.undrained_dilatancy, key("undrained"),
      "does not go with dilatancy, which would draw the water apart and make the ground stronger without end; "
      "expected psi = 0, not {}, or undrained_dilatancy = true",
      psi);
}

/// Names of state variables become fields and columns beside those that every body has.
void check_state_variables(SceneCheck& check, const MaterialSpec& material) {
  constexpr std::array taken = {"position",     "u", "v", "strain", "stress", "effective_stress", "volume",
                                "pore_pressure"};
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (std::size_t k = 0; k < material.statev.size(); ++k) {
    const std::string& name = material.statev[k];
    const std::string key = fmt::format("material.{}.statev[{}]", material.name, k);
    if (name.empty()) continue;
    if (check.wrong_if(!std::ranges::all_of(name, fits) || std::isdigit(static_cast<unsigned char>(name[0])) != 0, key,
                       "{} cannot be the name of a field; expected letters, digits and '_', beginning with a letter",
                       in_quotes(name)))
      continue;
    check.wrong_if(std::ranges::find(taken, name) != taken.end(), key,
                   "there is a field {} already; expected another name", in_quotes(name));
    check.wrong_if(std::find(material.statev.begin(), material.statev.begin() + static_cast<std::ptrdiff_t>(k), name) !=
                       material.statev.begin() + static_cast<std::ptrdiff_t>(k),
                   key, "there are two state variables {}", in_quotes(name));
  }
}

void check_fault_of_law(SceneCheck& check, const MaterialSpec& material) {
  const LawInfo* const law = check.catalogue().law(material.law);
  if (!law || !law->fault || (law->from_library && material.library.empty())) return;
  const bool is_read = std::ranges::all_of(
      law->parameters, [&](const ParameterInfo& p) { return material.parameters.contains(std::string(p.name)); });
  if (!is_read) return;
  if (const auto fault = law->fault(material))
    check.add(fmt::format("material.{}.{}", material.name, fault->key), fault->message);
}

void check_softening(SceneCheck& check, const MaterialSpec& material) {
  const std::vector<StrengthRow>& rows = material.softening;
  const auto key = [&](const char* name) { return fmt::format("material.{}.{}", material.name, name); };
  const bool varies = material.by_place.contains("c");
  constexpr const char* why = "does not go with a cohesion that is a formula of the position";
  check.wrong_if(!rows.empty() && varies, key("softening"), why);
  check.wrong_if(varies && check.written(key("c_residual")), key("c_residual"), why);
  const auto strain = material.parameters.find("softening_strain");
  const bool softens = !rows.empty() || (strain != material.parameters.end() && strain->second > 0);
  check.wrong_if(material.softening_length && !softens, key("softening_length"),
                 "goes with softening, or softening_strain > 0");
  const auto volume = material.choices.find("volume");
  check.wrong_if(material.by_place.contains("e0") && volume != material.choices.end() && volume->second == "fixed",
                 key("e0"), "is a formula of the position, which goes with volume = \"evolves\"");
  check.wrong_if(rows.size() > most_strength_rows, fmt::format("material.{}.softening", material.name),
                 "has {} rows; expected at most {}", rows.size(), most_strength_rows);
  for (std::size_t k = 1; k < rows.size(); ++k)
    check.wrong_if(!(rows[k].plastic_strain > rows[k - 1].plastic_strain),
                   fmt::format("material.{}.softening[{}][0]", material.name, k),
                   "must be larger than {}, that of the row before, not {}", rows[k - 1].plastic_strain,
                   rows[k].plastic_strain);
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
  for (const auto& [name, material] : scene.materials) {
    check_dilation(check, material);
    check_softening(check, material);
    check_water(check, material);
    check_state_variables(check, material);
    check_fault_of_law(check, material);
  }
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
