// The rows of the table of keys. A row's default is that of the member of Scene, if none is told here.
#include <algorithm>
#include <cmath>

#include "scene/input/boundary_keys.hpp"
#include "scene/input/constants.hpp"
#include "scene/input/exact_keys.hpp"
#include "scene/input/key_reader.hpp"
#include "scene/input/material_keys.hpp"

namespace stillpoint {
namespace {

constexpr Range kShare{0, 1, true, false};

std::vector<Word> states() {
  std::vector<Word> words;
  for (int k = 0; k <= static_cast<int>(StressState::space); ++k) {
    const auto state = static_cast<StressState>(k);
    const Dims dims = state == StressState::space ? kSpace : state >= StressState::plane_strain ? kPlane : kLine;
    words.emplace_back(to_string(state), dims);
  }
  return words;
}

TableInfo constants() {
  TableInfo info{"constants", "numbers, or formulas of each other, for use in every formula"};
  info.keys = {{.name = "<name>", .help = "a constant", .kind = Kind::number}};
  info.read = [](const TableInfo& self, const toml::table& root, Scene& scene, Reading& reading) {
    for (const FoundTable& found : find_tables(self, root, reading)) resolve_constants(found.table, reading);
    scene.constants = reading.constants;
  };
  return info;
}

/// Points along each coordinate of a cell: an array, or a plain number, which in two and three dimensions counts the
/// cell's points.
void read_points_per_cell(BodySpec& body, const Value& value, const KeyInfo& key) {
  const int dim = value.reading.dim;
  KeyInfo along_axis = key;
  along_axis.range = from(1, dim == 1 ? 1000 : 100);
  if (dim == 1 || value.node.is_array()) {
    if (auto points = read_value<std::vector<int>>(value, along_axis)) body.points_per_cell = std::move(*points);
    return;
  }
  const auto count = read_whole(value, from(1, std::pow(along_axis.range.upper, dim)));
  if (!count) return;
  const double along = std::round(std::pow(static_cast<double>(*count), 1.0 / dim));
  if (std::pow(along, dim) == static_cast<double>(*count)) {
    body.points_per_cell.assign(static_cast<std::size_t>(dim), static_cast<int>(along));
  } else {
    value.problem(
        fmt::format("must be a {}, or an array {}; not {}",
                    dim == 2 ? "square (4 is 2 × 2 points in a cell)" : "cube (8 is 2 × 2 × 2 points in a cell)",
                    dim == 2 ? "[along x, along y]" : "[along x, along y, along z]", *count));
  }
}

/// What else is to be said of a word that stands in the wrong table.
std::string hint(const auto* row, const char* is, const char* key) {
  return row ? fmt::format("'{}' is {}; write {} = \"{}\"", row->name, is, key, row->name) : "";
}

/// The state at the beginning.
void add_initial(Tables& tables) {
  tables.add({"initial", "the state at t = 0"}, std::identity())
      .key("u", &Scene::initial_u, "displacement", {.unit = "m", .variables = "x", .fallback = "0"})
      .key("v", &Scene::initial_v, "velocity", {.unit = "m/s", .variables = "x", .fallback = "0"});

  tables
      .add({"initial.geostatic", "level ground: sigma_yy = -rho b_y (surface - y), sigma_xx = sigma_zz = K0 sigma_yy"},
           &Scene::geostatic)
      .key("K0", &GeostaticSpec::K0, "coefficient of earth pressure at rest", {.range = kPositive, .required = true})
      .key("surface", &GeostaticSpec::surface, "height of the surface", {.unit = "m", .required = true});
}

void add_method(Tables& tables, const Catalogue& catalogue) {
  std::vector<Word> methods = names_of(catalogue.static_methods);
  methods.insert(methods.begin(), std::string_view("relaxation"));
  const auto strategy = [&catalogue](const std::string& word) {
    return hint(catalogue.strategy(word), "a way to rest in time, not a static solver", "damping.strategy");
  };

  tables.add({"solve", "how equilibrium is found"}, &Scene::solve)
      .key("method", &SolveSpec::method, "relaxation in time, or a static solver", {.words = methods, .hint = strategy})
      .key("load_steps", &SolveSpec::load_steps,
           "of a static solver: shares of the load, each committed to what points remember; one that fails is halved, "
           "by cg and "
           "lbfgs only where points remember",
           {.range = from(1, 100000)});

  const auto solver = [&catalogue](const std::string& word) {
    return hint(catalogue.static_method(word), "a static solver, not a damping or a relaxation", "solve.method");
  };

  tables.add({"damping", "the way to rest: a damping force, or a relaxation"}, &Scene::damping)
      .key("strategy", &DampingSpec::strategy, "`stillpoint list dampings` has their equations",
           {.words = names_of(catalogue.strategies), .hint = solver})
      .key("c", &DampingSpec::c, "of a damping linear in v; critical: 2 omega_1",
           {.range = kNotNegative, .unit = "1/s or kg/s", .words = {"critical"}, .fallback = "critical"})
      .key("alpha", &DampingSpec::alpha, "of a local damping: share of the out-of-balance force", {.range = kShare})
      .key("peak", &DampingSpec::peak, "of the kinetic energy, in kinetic damping",
           {.words = {"half-step", "parabolic"}})
      .key("quotient", &DampingSpec::quotient, "Rayleigh's, for omega_1^2 of adaptive damping",
           {.words = {"diagonal", "global"}});

  const std::string own_scale = "rtol times the scene's own scale";

  tables.add({"integrator", "the steps in time"}, &Scene::integrator)
      .key("method", &IntegratorSpec::method, "of time integration",
           {.words = names_of(catalogue.methods), .listed_by = "stillpoint list integrators"})
      .key("damping", &IntegratorSpec::treatment, "how C v is treated in a step",
           {.words = {kTreatments.begin(), kTreatments.end()}})
      .key("step", &IntegratorSpec::step, "fixed; or step_fraction", {.range = kPositive, .unit = "s"})
      .key("step_fraction", &IntegratorSpec::step_fraction, "of the critical step; caps an adaptive one",
           {.range = kPositive})
      .key("rtol", &IntegratorSpec::rtol, "relative tolerance of an adaptive step; not given: a fixed one",
           {.range = {0, 1}})
      .key("atol_u", &IntegratorSpec::atol_u, "absolute tolerance",
           {.range = kPositive, .unit = "m", .fallback = own_scale})
      .key("atol_v", &IntegratorSpec::atol_v, "absolute tolerance",
           {.range = kPositive, .unit = "m/s", .fallback = own_scale})
      .key("unstable_reason", &IntegratorSpec::unstable_reason, "for a step past the critical one",
           {.may_be_empty = true});

  tables.add({"stop", "when a run ends; a test set to 0 is off"}, &Scene::stop)
      .key("residual", &StopSpec::residual, "|F - R|/|F| of equilibrium", {.range = kNotNegative})
      .key("distance", &StopSpec::distance,
           "the certified |u - u*|/|u| over the volume; beside residual 1e-3 where omega_1 is known, unless given",
           {.range = kNotNegative})
      .key("kinetic_energy", &StopSpec::kinetic_energy, "besides: its share of the largest so far",
           {.range = kNotNegative})
      .key("hold", &StopSpec::dwell, "periods 2 pi/omega_1 for which both have to hold", {.range = kNotNegative})
      .key("load_growth", &StopSpec::load_growth,
           "d(factor)/d(displacement) of [load] over the last fifth of its way, as a share of the mean from the start, "
           "at the limit load",
           {.range = kNotNegative})
      .key("time", &StopSpec::time, "end time", {.range = kNotNegative, .unit = "s"})
      .key("steps", &StopSpec::steps, "number of steps", {.range = kNotNegative})
      .key("wall_time", &StopSpec::wall_time, "time on the clock", {.range = kNotNegative, .unit = "s"});
}

void add_output(Tables& tables) {
  tables.add({"output", "what is written, and when"}, &Scene::output)
      .key("every", &OutputSpec::every, "time between rows of the history; 0: chosen",
           {.range = kNotNegative, .unit = "s"})
      .key("stages", &OutputSpec::snapshots, "times of the fields of all points", {.unit = "s", .list = true})
      .key("fields_every", &OutputSpec::fields_every, "or the time between them", {.range = kNotNegative, .unit = "s"});

  tables.add({"checkpoint", "saves the state, for run --resume"}, &Scene::checkpoint)
      .key("every", &CheckpointSpec::every, "time on the clock between them; 0: not by the clock",
           {.range = kNotNegative, .unit = "s"})
      .key("every_steps", &CheckpointSpec::every_steps, "steps between them; 0: not by steps", {.range = kNotNegative});

  tables.add({"probe", "figures in each row of the history", Repeat::array}, &Scene::probes)
      .key("name", &ProbeSpec::name, "of its columns in history.csv", {.required = true})
      .key("kind", &ProbeSpec::kind,
           "a point, the angle of the free surface, the mean over a box of material points, or sums over the body",
           {.words = {"point", "slope_angle", "mean", "body"}})
      .key("point", &ProbeSpec::point, "number of a material point, in order of position",
           {.range = from(1, std::numeric_limits<int>::max())})
      .key("at", &ProbeSpec::at,
           "or a place: u, v and strain are those of the grid's functions there, stress and plastic_strain are fitted "
           "to the material points around it",
           {.unit = "m"})
      .key("frame", &ProbeSpec::frame,
           "of the place: it moves with the material, or stays where it is in space and reads what passes there",
           {.words = {"material", "space"}})
      .key("min", &ProbeSpec::min,
           "lower corner of a box: of a mean, where its points are at the start; in space of a slope, where they are "
           "now",
           {.unit = "m"})
      .key("max", &ProbeSpec::max, "upper corner", {.unit = "m"})
      .key("fields", &ProbeSpec::fields,
           "u, v, strain, stress; with dim > 1 their components, as u.x and stress.yy, and plastic_strain; of the body "
           "volume, momentum, with dim = 2 momentum.x, momentum.y and angular_momentum about the origin, with dim = 3 "
           "momentum.x and angular_momentum.x to z",
           {.list = true});

  tables.add({"variant", "the same scene with other values, drawn beside it", Repeat::array}, &Scene::variants)
      .key("name", &VariantSpec::name, "in the picture", {.required = true})
      .key("set", &VariantSpec::set, "\"key=value\" each, as for --set", {.required = true, .list = true});
}

}  // namespace

std::vector<TableInfo> scene_tables(const Catalogue& catalogue) {
  Tables tables;
  tables.add({"", "at the top of the file"}, std::identity())
      .key("title", &Scene::title, "of the scene", {.may_be_empty = true})
      .key("dim", &Scene::dim, "1, 2 or 3 dimensions", {.range = from(1, 3)});
  tables.all.push_back(constants());
  constexpr double most = 1e7;  // a larger count is a slip, not a grid

  tables
      .add({"grid", "the background grid", Repeat::once, "a scene has a background grid with min, max and cells"},
           &Scene::grid)
      .key("min", &GridSpec::min, "lower corner", {.unit = "m", .required = true})
      .key("max", &GridSpec::max, "upper corner", {.unit = "m", .required = true})
      .key("cells", &GridSpec::cells, "along each coordinate", {.range = from(1, most), .required = true})
      .key("basis", &GridSpec::basis, "of the nodes", {.words = {"linear", "quadratic", "cubic", "hermite"}})
      .key("follow", &GridSpec::follow, "the wall with which its face of the grid moves from phase to phase");

  tables
      .add({"body", "material points in a box, in another shape or from a file; [body], or several [[body]]",
            Repeat::once_or_array, "a scene has a body with a material"},
           &Scene::bodies)
      .key("min", &BodySpec::min, "lower corner of a box, or in space of that in which another shape is cut off",
           {.unit = "m", .fallback = "that of the grid"})
      .key("max", &BodySpec::max, "upper corner, likewise", {.unit = "m", .fallback = "that of the grid"})
      .key("polygon", &BodySpec::polygon,
           "corners in order, not a box; in space [x, y] each, or what axis leaves, drawn out from min to max",
           {.unit = "m", .list = true, .in_plane = true, .dims = kNotLine})
      .key("axis", &BodySpec::axis, "along which a polygon is drawn out",
           {.words = {"x", "y", "z"}, .fallback = "z", .dims = kSpace})
      .key("sphere", &BodySpec::sphere, "the centre of a sphere, not a box", {.unit = "m", .dims = kSpace})
      .key("cylinder", &BodySpec::cylinder, "[from, to], the centres of a cylinder's ends, not a box",
           {.unit = "m", .list = true, .dims = kSpace})
      .key("radius", &BodySpec::radius, "of a sphere or a cylinder",
           {.range = kPositive, .unit = "m", .fallback = "needed by both", .dims = kSpace})
      .key("inner_radius", &BodySpec::inner_radius, "of a hollow one",
           {.range = kPositive, .unit = "m", .fallback = "none: it is solid", .dims = kSpace})
      .key("stl", &BodySpec::stl, "STL file of a closed surface of triangles, in metres, not a box", {.dims = kSpace})
      .key("file", &BodySpec::file, "CSV of points, not a box: columns x, y, z as there are, volume")
      .key("material", &BodySpec::material, "the name of a [material.<name>]", {.required = true})
      .key("state", &BodySpec::state, "of stress and strain, the same in all bodies",
           {.words = states(), .fallback = "uniaxial-stress, plane-strain or space, by dim"})
      .key("area", &BodySpec::area, "cross-section", {.range = kPositive, .unit = "m2", .dims = kLine})
      .key("thickness", &BodySpec::area, "not of axisymmetric bodies",
           {.range = kPositive, .unit = "m", .dims = kPlane})
      .key("points_per_cell", &BodySpec::points_per_cell, "along each coordinate; a plain number counts all in a cell",
           {.range = from(1, 10'000), .fallback = "2"})
      .read_by(read_points_per_cell)
      .key(
          "placement", &BodySpec::placement,
          "of the points in a cell; gauss: of one that the border of another shape than a box cuts, in the part inside",
          {.words = {"uniform", "gauss", "random"}})
      .key("jitter", &BodySpec::jitter, "each point is moved by up to this share of half its spacing",
           {.range = kShare})
      .key("volumes", &BodySpec::volumes,
           "equal, or fitted to the moments of each cell or of its part inside the shape",
           {.words = {"equal", "consistent"}})
      .key("seed", &BodySpec::seed, "of random points and of jitter", {.range = kNotNegative});
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
           {.range = kShare, .words = {"none"}, .fallback = "0.1 if a law has a history, otherwise none"})
      .key("max_strain", &PhaseSpec::max_strain, "or a displacement gradient since the phase began",
           {.range = kPositive})
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
            .fallback =
                "domains for elastic boxes of uniform points on a line or in a plane, if damped; otherwise points"})
      .key("dilatation", &PhaseSpec::dilatation,
           "the change of volume that a law answers to: that of each point, or so that nearly incompressible material "
           "does not lock (F-bar, B-bar) the mean of a cell's points, or a mean over splines of one degree less than "
           "the basis, which keeps the order of cubic ones",
           {.words = {"points", "cells", "splines"}, .dims = kNotLine});
  add_boundary(tables);
  add_initial(tables);
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
    if (info.read) info.read(info, root, scene, reading);
    if (!info.path.empty()) continue;
    reading.dim = scene.dim;
    if (reading.wrong.contains("dim")) return false;
    if (scene.dim > 1) scene.mass.kind = MassKind::lumped;
  }
  return true;
}

}  // namespace stillpoint
