// The rows of the table of keys. A row's default is that of the member of Scene, if none is told here.
#include <algorithm>
#include <cmath>

#include "scene/input/constants.hpp"
#include "scene/input/key_reader.hpp"

namespace stillpoint {
namespace {

constexpr Range kShare{0, 1, true, false};
const std::vector<Word> kFaces = {{"left"}, {"right"}, {"bottom", kPlane}, {"top", kPlane}};

std::vector<Word> states() {
  using enum StressState;
  return {{to_string(uniaxial_stress), kLine},
          {to_string(uniaxial_strain), kLine},
          {to_string(plane_strain), kPlane},
          {to_string(plane_stress), kPlane},
          {to_string(axisymmetric), kPlane}};
}

std::vector<Word> words_of(const auto& names) {
  std::vector<Word> words;
  for (const auto& name : names) words.push_back({name});
  return words;
}
std::vector<Word> names_of(const auto& rows) {
  std::vector<Word> words;
  for (const auto& row : rows) words.push_back({row.name});
  return words;
}

TableInfo constants() {
  TableInfo info{.path = "constants", .help = "numbers, or formulas of each other, for use in every formula"};
  info.keys = {{.fallback = "none", .name = "<name>", .help = "a constant", .kind = Kind::number}};
  info.read = [](const TableInfo& self, const toml::table& root, Scene& scene, Reading& reading) {
    for (const FoundTable& found : find_tables(self, root, reading)) resolve_constants(found.table, reading);
    scene.constants = reading.constants;
  };
  return info;
}

/// Points along each coordinate of a cell: an array, or a plain number, which in two dimensions counts the cell's
/// points.
void read_points_per_cell(BodySpec& body, const Value& value, const KeyInfo& key) {
  const int dim = value.reading.dim;
  KeyInfo along_axis = key;
  along_axis.range = from(1, dim == 1 ? 1000 : 100);
  if (dim == 1 || value.node.is_array()) {
    if (auto points = read_value<std::vector<int>>(value, along_axis)) body.points_per_cell = std::move(*points);
    return;
  }
  const auto count = read_whole(value, from(1, along_axis.range.upper * along_axis.range.upper));
  if (!count) return;
  const int along = static_cast<int>(std::lround(std::sqrt(static_cast<double>(*count))));
  if (std::int64_t{along} * along == *count) {
    body.points_per_cell.assign(static_cast<std::size_t>(dim), along);
  } else {
    value.problem(
        fmt::format("must be a square (4 is 2 × 2 points in a cell), or an array [along x, along y]; not {}", *count));
  }
}

TableInfo bodies() {
  auto points_per_cell = key("points_per_cell", &BodySpec::points_per_cell,
                             "material points along each coordinate of a cell; with dim = 2 a plain number counts the "
                             "points of a cell, a square",
                             {.range = from(1, 1000), .fallback = "2 along each coordinate"});
  points_per_cell.read = read_points_per_cell;
  return table<BodySpec>(
      {.path = "body",
       .help = "material points in a box, in a polygon or from a file; one [body] or several [[body]]",
       .repeat = Repeat::once_or_array,
       .needed_for = "a scene has a body with a material"},
      &Scene::bodies,
      {key("min", &BodySpec::min, "lower corner of a box", {.unit = "m", .fallback = "that of the grid"}),
       key("max", &BodySpec::max, "upper corner of a box", {.unit = "m", .fallback = "that of the grid"}),
       key("polygon", &BodySpec::polygon, "corners in order, in place of a box",
           {.unit = "m", .fallback = "the box", .list = true, .dims = kPlane}),
       key("file", &BodySpec::file, "CSV of points, in place of a box: columns x, y, volume",
           {.fallback = "the box is filled with points"}),
       key("material", &BodySpec::material, "the name of a [material.<name>]", {.required = true}),
       key("state", &BodySpec::state, "what happens across the coordinates that are computed; the same in all bodies",
           {.words = states(), .fallback = "uniaxial-stress, or plane-strain"}),
       key("area", &BodySpec::area, "cross-section", {.range = kPositive, .unit = "m2", .dims = kLine}),
       key("thickness", &BodySpec::area, "of the plane; an axisymmetric body has none",
           {.range = kPositive, .unit = "m", .dims = kPlane}),
       std::move(points_per_cell),
       key("placement", &BodySpec::placement, "of the points in a cell",
           {.words = words_of(std::array{"uniform", "gauss", "random"})}),
       key("jitter", &BodySpec::jitter, "each point is moved by up to this share of half its spacing",
           {.range = kShare}),
       key("volumes", &BodySpec::volumes, "equal, or fitted to the moments of each cell",
           {.words = words_of(std::array{"equal", "consistent"})}),
       key("seed", &BodySpec::seed, "of random points and of jitter", {.range = kNotNegative})});
}

/// The keys of a material: its law's.
std::vector<Key<MaterialSpec>> keys_of(const LawInfo& law, const Key<MaterialSpec>& law_key) {
  std::vector<Key<MaterialSpec>> keys = {law_key};
  for (const ParameterInfo& p : law.parameters) {
    const auto value = [name = std::string(p.name)](MaterialSpec& m) -> double& { return m.parameters[name]; };
    keys.push_back(key_of<MaterialSpec>(p.name, value, p.meaning,
                                        {.range = {p.lower, p.upper, p.lower_allowed, false},
                                         .unit = p.unit,
                                         .fallback = p.required          ? ""
                                                     : p.same_as.empty() ? fmt::format("{}", p.fallback)
                                                                         : std::string(p.same_as),
                                         .required = p.required}));
  }
  for (const ChoiceInfo& c : law.choices) {
    const auto value = [name = std::string(c.name)](MaterialSpec& m) -> std::string& { return m.choices[name]; };
    keys.push_back(key_of<MaterialSpec>(c.name, value, c.meaning,
                                        {.words = words_of(c.values), .fallback = std::string(c.fallback)}));
  }
  return keys;
}

/// Sets what a material does not say, unless what it says is wrong.
void set_defaults(MaterialSpec& material, const LawInfo& law, const FoundTable& found, const Reading& reading) {
  const auto missing = [&](const auto& values, std::string_view name) {
    return !values.contains(std::string(name)) && !reading.wrong.contains(fmt::format("{}.{}", found.path, name));
  };
  for (const ParameterInfo& p : law.parameters) {
    if (!missing(material.parameters, p.name)) continue;
    const auto same = material.parameters.find(std::string(p.same_as));
    material.parameters[std::string(p.name)] = same == material.parameters.end() ? p.fallback : same->second;
  }
  for (const ChoiceInfo& c : law.choices)
    if (missing(material.choices, c.name)) material.choices[std::string(c.name)] = c.fallback;
}

/// A table of all materials, which reads them, and one for each law, which tells its keys.
std::vector<TableInfo> materials(const Catalogue& catalogue) {
  const auto law_key = key("law", &MaterialSpec::law, "of the material: `stillpoint list materials`",
                           {.words = names_of(catalogue.laws), .required = true});
  std::vector<TableInfo> tables = {
      {.path = "material.<name>", .help = "what bodies are made of", .repeat = Repeat::named, .keys = {law_key.info}}};
  std::map<std::string, std::vector<Key<MaterialSpec>>> keys;
  for (const LawInfo& law : catalogue.laws) {
    const auto& of_law = keys[std::string(law.name)] = keys_of(law, law_key);
    tables.push_back({.path = "material.<name>",
                      .help = law.equation,
                      .repeat = Repeat::named,
                      .law = law.name,
                      .keys = infos_of(of_law)});
  }
  tables[0].read = [&catalogue, law_key, keys](const TableInfo& self, const toml::table& root, Scene& scene,
                                               Reading& reading) {
    for (const FoundTable& found : find_tables(self, root, reading)) {
      MaterialSpec& material = scene.materials[found.name];
      material.name = found.name;
      if (const toml::node* const law = found.table.get("law")) {
        law_key.read(material, {*law, found.path + ".law", reading}, law_key.info);
      } else {
        reading.problem(location_of(found.table.source()), found.path, "the key 'law' is missing");
      }
      if (material.law.empty()) continue;  // which other keys belong here is not known
      const auto& of_law = keys.at(material.law);
      TableInfo told = self;
      told.keys = infos_of(of_law);
      read_keys(found, told, of_law, material, reading);
      set_defaults(material, *catalogue.law(material.law), found, reading);
    }
  };
  return tables;
}

TableInfo damping(const Catalogue& catalogue) {
  const auto static_method = [&catalogue](const std::string& word) {
    return catalogue.static_method(word) ? fmt::format(
                                               "'{}' is a static solver, not a damping or a relaxation; write "
                                               "solve.method = \"{}\"",
                                               word, word)
                                         : "";
  };
  return table<DampingSpec>(
      {.path = "damping", .help = "the way to rest: a damping force, or a relaxation that takes the integrator's part"},
      &Scene::damping,
      {key("strategy", &DampingSpec::strategy, "`stillpoint list dampings` says what each does",
           {.words = names_of(catalogue.strategies), .hint = static_method}),
       key("c", &DampingSpec::c, "of a damping linear in v; \"critical\": 2 omega_1",
           {.range = kNotNegative, .unit = "1/s, or kg/s", .words = {{"critical"}}, .fallback = "critical"}),
       key("alpha", &DampingSpec::alpha, "share of the out-of-balance force, of a local damping", {.range = kShare}),
       key("peak", &DampingSpec::peak, "where kinetic damping takes the peak of the kinetic energy to lie",
           {.words = words_of(std::array{"half-step", "parabolic"})}),
       key("quotient", &DampingSpec::quotient, "the Rayleigh quotient that adaptive damping takes for omega_1^2",
           {.words = words_of(std::array{"diagonal", "global"})})});
}

TableInfo solve(const Catalogue& catalogue) {
  std::vector<Word> methods = names_of(catalogue.static_methods);
  methods.insert(methods.begin(), {SolveSpec().method});
  const auto strategy = [&catalogue](const std::string& word) {
    return catalogue.strategy(word)
               ? fmt::format("'{}' is a way to rest in time; write damping.strategy = \"{}\"", word, word)
               : "";
  };
  return table<SolveSpec>({.path = "solve", .help = "how equilibrium is found"}, &Scene::solve,
                          {key("method", &SolveSpec::method, "relaxation in time, or a static solver",
                               {.words = std::move(methods), .hint = strategy})});
}

TableInfo integrator(const Catalogue& catalogue) {
  return table<IntegratorSpec>(
      {.path = "integrator", .help = "the steps in time"}, &Scene::integrator,
      {key("method", &IntegratorSpec::method, "of time integration",
           {.words = names_of(catalogue.methods), .listed_by = "stillpoint list integrators"}),
       key("damping", &IntegratorSpec::treatment, "how C v is treated in a step", {.words = words_of(kTreatments)}),
       key("step", &IntegratorSpec::step, "a fixed step",
           {.range = kPositive, .unit = "s", .fallback = "by step_fraction"}),
       key("step_fraction", &IntegratorSpec::step_fraction,
           "of the critical step, in place of step; the cap of an adaptive step", {.range = kPositive}),
       key("rtol", &IntegratorSpec::rtol, "relative tolerance; makes the step adaptive",
           {.range = {0, 1}, .fallback = "a fixed step"}),
       key("atol_u", &IntegratorSpec::atol_u, "absolute tolerance of u",
           {.range = kPositive, .unit = "m", .fallback = "rtol of the scene's own scale"}),
       key("atol_v", &IntegratorSpec::atol_v, "absolute tolerance of v",
           {.range = kPositive, .unit = "m/s", .fallback = "rtol of the scene's own scale"}),
       key("unstable_reason", &IntegratorSpec::unstable_reason, "why a step past the critical one is wanted",
           {.may_be_empty = true})});
}

TableInfo stop() {
  return table<StopSpec>(
      {.path = "stop", .help = "when a run ends; a test set to 0 is off"}, &Scene::stop,
      {key("residual", &StopSpec::residual, "|F - R|/|F| of equilibrium", {.range = kNotNegative}),
       key("distance", &StopSpec::distance, "certified distance |u - u*|/|u| from equilibrium, in the M-norm",
           {.range = kNotNegative}),
       key("kinetic_energy", &StopSpec::kinetic_energy,
           "share of the largest kinetic energy so far, below which the body rests; goes with these two",
           {.range = kNotNegative}),
       key("hold", &StopSpec::dwell, "periods 2 pi/omega_1 for which both have to hold", {.range = kNotNegative}),
       key("time", &StopSpec::time, "end time", {.range = kNotNegative, .unit = "s"}),
       key("steps", &StopSpec::steps, "number of steps", {.range = kNotNegative}),
       key("wall_time", &StopSpec::wall_time, "time on the clock", {.range = kNotNegative, .unit = "s"})});
}

/// Supports, walls and loads.
std::vector<TableInfo> boundary() {
  return {
      table<SupportSpec>({.path = "support",
                          .help = "prescribed displacement at a position, or on a face of the grid",
                          .repeat = Repeat::array},
                         &Scene::supports,
                         {key("at", &SupportSpec::at, "position; or face", {.unit = "m"}),
                          key("face", &SupportSpec::face, "of the grid; or at", {.words = kFaces}),
                          key("component", &SupportSpec::component, "what is held at a position, by number or name",
                              {.words = {{"x"}, {"y", kPlane}}}),
                          key("kind", &SupportSpec::roller, "on a face: a roller holds the normal component only",
                              {.words = words_of(std::array{"fixed", "roller"})}),
                          key("u", &SupportSpec::motion, "displacement of the component, on a face of its normal one",
                              {.unit = "m", .variables = "t"})}),
      table<WallSpec>(
          {.path = "wall",
           .help = "a rigid wall on a face of the grid, which pushes and never holds back",
           .repeat = Repeat::array},
          &Scene::walls,
          {key("name", &WallSpec::name, "for grid.follow and history.csv", {.required = true}),
           key("face", &WallSpec::face, "of the grid", {.words = kFaces, .required = true}),
           key("motion", &WallSpec::motion, "displacement along the face's coordinate",
               {.unit = "m", .variables = "t"}),
           key("friction", &WallSpec::friction, "Coulomb's coefficient; \"rough\": no slip",
               {.range = kNotNegative, .words = {{"rough"}}}, [](WallSpec& wall) { wall.friction = kInfinity; })}),
      table<PointForceSpec>(
          {.path = "force", .help = "a force at a position", .repeat = Repeat::array}, &Scene::forces,
          {key("at", &PointForceSpec::at, "position", {.unit = "m", .required = true}),
           key("value", &PointForceSpec::value, "components", {.unit = "N", .variables = "t", .required = true})}),
      table<TractionSpec>(
          {.path = "traction", .help = "a load on a face of a body that is one box", .repeat = Repeat::array},
          &Scene::tractions,
          {key("face", &TractionSpec::face, "of the body's box", {.words = kFaces, .required = true}),
           key("value", &TractionSpec::value, "per undeformed area; keeps its direction",
               {.unit = "Pa", .variables = "t", .fallback = "or pressure"}),
           key("pressure", &TractionSpec::pressure, "per deformed area; follows the face's normal",
               {.unit = "Pa", .variables = "t", .fallback = "or value"})}),
      table<Scene>({.path = "body_force", .help = "a load on all bodies"}, std::identity(),
                   {key("value", &Scene::body_force, "components, per mass",
                        {.unit = "m/s2", .variables = "xt", .required = true})})};
}

/// Where a scene begins, and where it is known to end.
std::vector<TableInfo> states_of_scene() {
  return {
      table<Scene>({.path = "initial", .help = "the state at t = 0"}, std::identity(),
                   {key("u", &Scene::initial_u, "displacement", {.unit = "m", .variables = "x", .fallback = "0"}),
                    key("v", &Scene::initial_v, "velocity", {.unit = "m/s", .variables = "x", .fallback = "0"})}),
      table<GeostaticSpec>(
          {.path = "initial.geostatic",
           .help =
               "stress under a level surface: sigma_yy = -rho b_y (surface - y), sigma_xx = sigma_zz = K0 sigma_yy"},
          &Scene::geostatic,
          {key("K0", &GeostaticSpec::K0, "coefficient of earth pressure at rest",
               {.range = kPositive, .required = true}),
           key("surface", &GeostaticSpec::surface, "height of the surface", {.unit = "m", .required = true})}),
      table<Scene>(
          {.path = "exact", .help = "the exact solution, if it is known: the run reports its error"}, std::identity(),
          {key("u", &Scene::exact_u, "displacement", {.unit = "m", .variables = "xt", .fallback = "not known"}),
           key("stress", &Scene::exact_stress, "beside u",
               {.unit = "Pa", .variables = "xt", .fallback = "not known"})})};
}

/// What is written out, and variants.
std::vector<TableInfo> output() {
  return {
      table<OutputSpec>({.path = "output", .help = "what is written, and when"}, &Scene::output,
                        {key("every", &OutputSpec::every, "between rows of the history; 0: chosen",
                             {.range = kNotNegative, .unit = "s"}),
                         key("stages", &OutputSpec::snapshots, "times at which the fields of all points are written",
                             {.unit = "s", .fallback = "none", .list = true}),
                         key("fields_every", &OutputSpec::fields_every,
                             "or the time between them; 0: at the stages only", {.range = kNotNegative, .unit = "s"})}),
      table<ProbeSpec>(
          {.path = "probe", .help = "a row of figures in the history", .repeat = Repeat::array}, &Scene::probes,
          {key("name", &ProbeSpec::name, "of its columns in history.csv", {.required = true}),
           key("kind", &ProbeSpec::kind, "of a material point, or the slope of the free surface",
               {.words = words_of(std::array{"point", "slope_angle"})}),
           key("point", &ProbeSpec::point, "number of a material point, in order of position; or at",
               {.range = from(1, std::numeric_limits<int>::max())}),
           key("at", &ProbeSpec::at, "the material point nearest to this position; or point", {.unit = "m"}),
           key("fields", &ProbeSpec::fields,
               "of a point: u, v, strain, stress; with dim = 2 their components (u.x, stress.yy) and "
               "plastic_strain",
               {.list = true})}),
      table<VariantSpec>(
          {.path = "variant", .help = "the same scene with other values, drawn beside it", .repeat = Repeat::array},
          &Scene::variants,
          {key("name", &VariantSpec::name, "in the picture", {.required = true}),
           key("set", &VariantSpec::set, "\"key=value\" each, as for --set", {.required = true, .list = true})})};
}

}  // namespace

std::vector<TableInfo> scene_tables(const Catalogue& catalogue) {
  std::vector<TableInfo> tables = {
      table<Scene>({.path = "", .help = "at the top of the file"}, std::identity(),
                   {key("title", &Scene::title, "of the scene", {.may_be_empty = true}),
                    key("dim", &Scene::dim, "1 or 2 dimensions", {.range = from(1, 3)})}),
      constants(),
      table<GridSpec>(
          {.path = "grid",
           .help = "the background grid",
           .needed_for = "a scene has a background grid with min, max and cells"},
          &Scene::grid,
          {key("min", &GridSpec::min, "lower corner", {.unit = "m", .required = true}),
           key("max", &GridSpec::max, "upper corner", {.unit = "m", .required = true}),
           // A larger count is a slip, not a grid.
           key("cells", &GridSpec::cells, "along each coordinate", {.range = from(1, 10'000'000), .required = true}),
           key("basis", &GridSpec::basis, "`stillpoint list bases` says what each is",
               {.words = words_of(std::array{"linear", "quadratic", "cubic", "hermite"})}),
           key("follow", &GridSpec::follow, "the wall with which its face of the grid moves from phase to phase")}),
      bodies(),
  };
  const auto add = [&](std::vector<TableInfo> more) {
    for (TableInfo& info : more) tables.push_back(std::move(info));
  };
  add(materials(catalogue));
  add({table<MassSpec>(
           {.path = "mass", .help = "the mass matrix"}, &Scene::mass,
           {key("kind", &MassSpec::kind, "of the mass matrix",
                {.words = words_of(std::array{"consistent", "lumped"}),
                 .fallback = "consistent, or lumped if dim = 2"}),
            key("scaling", &MassSpec::factor,
                "factor of the inertia, not of the weight; \"gershgorin\": node by node to one critical step",
                {.range = kPositive, .words = {{"gershgorin"}}},
                [](MassSpec& mass) { mass.scaling = MassScaling::gershgorin; })}),
       table<PhaseSpec>(
           {.path = "phase", .help = "when a phase ends: the points move on and the grid starts again"}, &Scene::phase,
           {key("max_motion", &PhaseSpec::max_motion,
                "once a point has moved by this share of a cell; 0: after every step; \"none\": never",
                {.range = kShare, .words = {{"none"}}, .fallback = "0.1 if a law has a history, otherwise none"}),
            key("max_strain", &PhaseSpec::max_strain, "or once a displacement gradient exceeds this",
                {.range = kPositive, .fallback = "none"}),
            key("transfer", &PhaseSpec::transfer, "of velocities between points and grid",
                {.words = words_of(std::array{"flip", "pic", "apic", "xpic"})}),
            key("flip_share", &PhaseSpec::flip_share,
                "of flip: 1 takes increments of the nodal velocity, 0 the velocity itself", {.range = from(0, 1)}),
            key("xpic_order", &PhaseSpec::xpic_order, "of xpic", {.range = from(1, 20)})})});
  add(boundary());
  add(states_of_scene());
  add({solve(catalogue), damping(catalogue), integrator(catalogue), stop()});
  add(output());
  for (TableInfo& above : tables) {
    const std::string prefix = above.path.empty() ? "" : std::string(above.path) + ".";
    for (const TableInfo& below : tables) {
      if (below.path.empty() || !below.path.starts_with(prefix)) continue;
      const std::string_view rest = below.path.substr(prefix.size());
      const std::string name(rest.substr(0, rest.find('.')));
      if (std::ranges::find(above.tables, name) == above.tables.end()) above.tables.push_back(name);
    }
  }
  return tables;
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
    if (scene.dim == 3)
      Value{*root.get("dim"), "dim", reading}.problem("this version computes in 1 or 2 dimensions, not in 3");
    if (reading.wrong.contains("dim")) return false;
    if (scene.dim > 1) scene.mass.kind = MassKind::lumped;
  }
  return true;
}

}  // namespace stillpoint
