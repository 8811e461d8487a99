// The rows of the table of keys. A row's default is that of the member of Scene, if none is told here.
#include "scene/input/scene_keys.hpp"

#include <algorithm>
#include <functional>

namespace stillpoint {
namespace {

TableInfo constants() {
  TableInfo info{"constants", "numbers, or formulas of each other, for use in every formula"};
  info.keys = {{.name = "<name>", .help = "a constant", .kind = Kind::number}};
  info.read = [](const TableInfo& self, const toml::table& root, Scene& scene, Reading& reading) {
    for (const FoundTable& found : find_tables(self, root, reading)) resolve_constants(found.table, reading);
    scene.constants = reading.constants;
  };
  return info;
}

void add_grid(Tables& tables) {
  const std::vector<std::string_view> by_pieces = {"x", "y", "z"};
  const auto pieces = [](Dims dims) {
    return KeyInfo{.unit = "m",
                   .list = true,
                   .row = "[from, to, cells] or [from, to, cells, ratio]",
                   .row_lengths = {3, 4},
                   .dims = dims};
  };
  tables
      .add({"grid", "the background grid", Repeat::once, "a scene has a background grid with min, max and cells"},
           &Scene::grid)
      .key("min", &GridSpec::min, "lower corner", {.unit = "m", .required = true, .unless = by_pieces})
      .key("max", &GridSpec::max, "upper corner", {.unit = "m", .required = true, .unless = by_pieces})
      .key("cells", &GridSpec::cells, "along each coordinate, equal ones",
           {.range = kCells, .required = true, .unless = by_pieces})
      .key(
          "x", [](GridSpec & grid) -> auto& { return grid.pieces[0]; },
          "the axis x piece by piece, in place of min, max and cells: every axis or none; ratio: of the last cell of a "
          "piece to its first, in geometric progression",
          pieces(kAnyDim))
      .key(
          "y", [](GridSpec & grid) -> auto& { return grid.pieces[1]; }, "the axis y, likewise", pieces(kNotLine))
      .key(
          "z", [](GridSpec & grid) -> auto& { return grid.pieces[2]; }, "the axis z, likewise", pieces(kSpace))
      .key("basis", &GridSpec::basis, "of the nodes", {.words = {"linear", "quadratic", "cubic", "hermite"}})
      .key("follow", &GridSpec::follow, "the wall with which its face of the grid moves from phase to phase");
}

/// The state at the beginning.
[[gnu::no_sanitize_address]] void add_initial(Tables& tables) {
  tables.add({"initial", "the state at t = 0"}, std::identity())
      .key("u", &Scene::initial_u, "displacement", {.unit = "m", .variables = "x", .fallback = "0"})
      .key("v", &Scene::initial_v, "velocity", {.unit = "m/s", .variables = "x", .fallback = "0"})
      .key("from", &Scene::initial_from,
           "a checkpoint of another scene: bodies of the same names begin with its points, at rest, and with what they "
           "remember")
      .key("displacements", &Scene::displacements_from_zero, "with from: whether they count from there on",
           {.words = {"kept", "zero"}})
      .key("stress", &Scene::initial_stress,
           "Cauchy's, the same everywhere, of laws that keep one; in undrained ground the effective one; components as "
           "of "
           "exact.stress",
           {.unit = "Pa", .fallback = "0", .of_stress = true});

  tables
      .add({"initial.geostatic",
            "level ground: sigma_yy is the weight above, sigma_xx = sigma_zz = K0 sigma_yy of the effective stress"},
           &Scene::geostatic)
      .key("K0", &GeostaticSpec::K0, "coefficient of earth pressure at rest, above 0",
           {.variables = "x", .required = true})
      .key("surface", &GeostaticSpec::surface, "height of the surface", {.unit = "m", .required = true})
      .key("water_table", &GeostaticSpec::water_table,
           "height of the water that stands in the pores of undrained materials", {.unit = "m", .fallback = "none"})
      .key("water_density", &GeostaticSpec::water_density, "of that water", {.range = kPositive, .unit = "kg/m3"});
}

}  // namespace

[[gnu::no_sanitize_address]] std::vector<TableInfo> scene_tables(const Catalogue& catalogue) {
  Tables tables;
  tables.add({"", "at the top of the file"}, std::identity())
      .key("title", &Scene::title, "of the scene", {.may_be_empty = true})
      .key("dim", &Scene::dim, "1, 2 or 3 dimensions", {.range = from(1, 3)});
  tables.all.push_back(constants());
  add_grid(tables);
  add_body(tables);
  for (TableInfo& material : material_tables(catalogue)) tables.all.push_back(std::move(material));
  tables.add({"mass", "the mass matrix"}, &Scene::mass)
      .key("kind", &MassSpec::kind,
           "of the mass matrix; lumped by default if dim > 1; multigrid, towards equilibrium only: fictitious, with "
           "M⁻¹ a cycle of multigrid on the elastic stiffness, so that steps do not grow with the body",
           {.words = {"consistent", "lumped", "multigrid"}})
      .key("scaling", &MassSpec::factor,
           "of the inertia, not of the weight; or each node by the bound of its stiffness",
           {.range = kPositive, .words = {"gershgorin"}},
           [](MassSpec& mass) { mass.scaling = MassScaling::gershgorin; });

  tables.add({"phase", "when a phase ends: the points move on and the grid starts again"}, &Scene::phase)
      .key("max_motion", &PhaseSpec::max_motion, "share of a cell that some point has moved; 0: after every step",
           {.range = kShare, .words = {"none"}, .fallback = "0.1 if a law has a history, otherwise none"},
           [](PhaseSpec& phase) { phase.max_motion = PhaseSpec::never; })
      .key("max_strain", &PhaseSpec::max_strain, "or a displacement gradient since the phase began",
           {.range = kPositive})
      .key("rest", &PhaseSpec::rest,
           "parts rest that move by less than this share of the largest motion, while less than this share of the "
           "forces in them is out of balance; 0: none",
           {.range = kShare})
      .key("transfer", &PhaseSpec::transfer, "of velocities from grid to points",
           {.words = {"flip", "pic", "apic", "xpic"},
            .fallback = "apic for elastic bodies of domains, if damped; otherwise flip"})
      .key("flip_share", &PhaseSpec::flip_share,
           "of flip: 1 takes increments of the nodal velocity, 0 the velocity itself", {.range = from(0, 1)})
      .key("xpic_order", &PhaseSpec::xpic_order, "of xpic", {.range = from(1, 20)})
      .key("deformation", &PhaseSpec::deformation,
           "of elastic points when a phase begins: from where they are, or multiplied up from phase to phase",
           {.words = {"positions", "accumulated"}, .fallback = "positions; accumulated at points of a linear basis"})
      .key("quadrature", &PhaseSpec::quadrature,
           "functions are taken at the points, or interpolated over the domains that they stand for",
           {.words = {"points", "domains"},
            .fallback = "domains for elastic boxes of uniform points on a line or in a plane, if damped and dilatation "
                        "is that of points; otherwise points"})
      .key("dilatation", &PhaseSpec::dilatation,
           "the change of volume that a law answers to: that of each point, or so that nearly incompressible material "
           "does not lock (F-bar, B-bar) the mean of a cell's points, or a mean over splines of one degree less than "
           "the basis, which keeps the order of cubic ones",
           {.words = {"points", "cells", "splines"}, .dims = kNotLine});
  add_boundary(tables);
  add_initial(tables);
  add_stages(tables);
  for (TableInfo& exact : exact_tables(catalogue)) tables.all.push_back(std::move(exact));
  add_method(tables, catalogue);
  add_output(tables);
  for (TableInfo& above : tables.all) {
    const std::string prefix = above.path.empty() ? "" : std::string(above.path) + ".";
    for (const TableInfo& below : tables.all) {
      if (below.path.empty() || !below.path.starts_with(prefix)) continue;
      const std::string_view rest = below.path.substr(prefix.size());
      const std::string name(rest.substr(0, rest.find('.')));
      if (std::ranges::find(above.tables, name) == above.tables.end()) above.tables.push_back(name);
    }
  }
  return std::move(tables.all);
}

std::string TableInfo::heading() const {
  if (repeat == Repeat::array) return fmt::format("[[{}]]", path);
  return path.empty() ? "" : fmt::format("[{}]", path);
}

bool read_tables(const std::vector<TableInfo>& tables, const toml::table& root, Scene& scene, Reading& reading) {
  for (const TableInfo& info : tables) {
    if (info.read && info.is_in(scene.dim)) {
      info.read(info, root, scene, reading);
    } else if (info.read) {
      for (const FoundTable& found : find_tables(info, root, reading))
        reading.problem(location_of(found.table.source()), found.path,
                        fmt::format("there is none in a scene with dim = {}", scene.dim));
    }
    if (!info.path.empty()) continue;
    reading.dim = scene.dim;
    if (reading.wrong.contains("dim")) return false;
  }
  return true;
}

}  // namespace stillpoint
