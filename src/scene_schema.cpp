#include "scene_schema.hpp"

#include <stillpoint/damping.hpp>
#include <stillpoint/integrator.hpp>
#include <stillpoint/material_laws.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace stillpoint {
namespace {

template <class T>
using Words = std::vector<std::pair<std::string, T>>;

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();
constexpr int kMostCells = 10'000'000;  // along an axis; a larger count is a slip, not a grid
constexpr int kMostPointsPerCell = 1000;

template <class Infos>
std::vector<std::string> names_of(const Infos& infos) {
  std::vector<std::string> names;
  for (const auto& info : infos) names.emplace_back(info.name);
  return names;
}

std::size_t count_of_axes(const Scene& scene) { return static_cast<std::size_t>(scene.dim); }

/// The coordinates that formulas of this scene may use: "x", "xy" or "xyz".
std::string coordinates(const Scene& scene) { return std::string("xyz").substr(0, count_of_axes(scene)); }

void read_grid(TableReader grid, Scene& scene) {
  const std::size_t axes = count_of_axes(scene);
  grid.require({"min", "max", "cells"});
  assign(scene.grid.min, grid.numbers("min", axes));
  assign(scene.grid.max, grid.numbers("max", axes));
  assign(scene.grid.cells, grid.integers("cells", axes, 1, kMostCells));
  assign(scene.grid.basis, grid.choice("basis", Words<BasisKind>{{"linear", BasisKind::linear},
                                                                 {"quadratic", BasisKind::quadratic},
                                                                 {"cubic", BasisKind::cubic},
                                                                 {"hermite", BasisKind::hermite}}));
  grid.report_unknown_keys();
}

void read_body(TableReader body, Scene& scene) {
  const std::size_t axes = count_of_axes(scene);
  BodySpec& spec = scene.bodies.emplace_back();
  body.require({"material"});
  if (!body.has("min")) spec.min = scene.grid.min;
  if (!body.has("max")) spec.max = scene.grid.max;
  assign(spec.min, body.numbers("min", axes));
  assign(spec.max, body.numbers("max", axes));
  assign(spec.material, body.name("material"));
  assign(scene.state, body.choice("state", Words<StressState>{{"uniaxial-stress", StressState::uniaxial_stress},
                                                              {"uniaxial-strain", StressState::uniaxial_strain}}));
  assign(spec.area, body.number("area", kPositive));
  assign(spec.placement, body.choice("placement", Words<Placement>{{"uniform", Placement::uniform},
                                                                   {"gauss", Placement::gauss},
                                                                   {"random", Placement::random}}));
  assign(spec.points_per_cell, body.integers("points_per_cell", axes, 1, kMostPointsPerCell));
  assign(spec.volumes, body.choice("volumes", Words<VolumeRule>{{"equal", VolumeRule::equal},
                                                                {"consistent", VolumeRule::consistent}}));
  assign(spec.seed, body.integer("seed", 0, kNoLimit));
  body.report_unknown_keys();
}

void read_material(const std::string& name, TableReader material, Scene& scene) {
  MaterialSpec& spec = scene.materials[name];
  spec.name = name;
  material.require({"law"});
  const auto law = material.choice("law", names_of(material_laws()));
  if (!law) return;  // which other keys belong here is not known
  spec.law = *law;
  const auto info = std::find_if(material_laws().begin(), material_laws().end(),
                                 [&](const LawInfo& one) { return one.name == *law; });
  for (const ParameterInfo& parameter : info->parameters) {
    const std::string key(parameter.name);
    if (parameter.required) material.require({key.c_str()});
    const auto value = material.number(key, {parameter.lower, parameter.upper, false, false});
    spec.parameters[key] = value.value_or(parameter.fallback);
  }
  material.report_unknown_keys();
}

void read_loads(TableReader& root, Scene& scene) {
  const std::size_t axes = count_of_axes(scene);
  for (TableReader& support : root.tables("support")) {
    SupportSpec& spec = scene.supports.emplace_back();
    support.require({"at"});
    assign(spec.at, support.numbers("at", axes));
    assign(spec.component, support.integer("component", 0, scene.dim - 1));
    assign(spec.motion, support.formula("u", "t"));
    support.report_unknown_keys();
  }
  for (TableReader& force : root.tables("force")) {
    PointForceSpec& spec = scene.forces.emplace_back();
    force.require({"at", "value"});
    assign(spec.at, force.numbers("at", axes));
    assign(spec.value, force.formulas("value", axes, "t"));
    force.report_unknown_keys();
  }
  for (TableReader& traction : root.tables("traction")) {
    TractionSpec& spec = scene.tractions.emplace_back();
    traction.require({"face", "value"});
    assign(spec.face, traction.choice("face", Words<Face>{{"left", Face::left}, {"right", Face::right}}));
    assign(spec.value, traction.formulas("value", axes, "t"));
    traction.report_unknown_keys();
  }
  TableReader body_force = root.table("body_force");
  body_force.require({"value"});
  assign(scene.body_force, body_force.formulas("value", axes, coordinates(scene) + "t"));
  body_force.report_unknown_keys();
}

void read_fields(TableReader& root, Scene& scene) {
  const std::size_t axes = count_of_axes(scene);
  TableReader initial = root.table("initial");
  assign(scene.initial_u, initial.formulas("u", axes, coordinates(scene)));
  assign(scene.initial_v, initial.formulas("v", axes, coordinates(scene)));
  initial.report_unknown_keys();
  TableReader exact = root.table("exact");
  assign(scene.exact_u, exact.formulas("u", axes, coordinates(scene) + "t"));
  assign(scene.exact_stress, exact.formula("stress", coordinates(scene) + "t"));
  if (exact.has("stress") && !exact.has("u")) exact.problem("stress", "needs exact.u beside it");
  exact.report_unknown_keys();
}

void read_damping(TableReader damping, Scene& scene) {
  assign(scene.damping.strategy, damping.choice("strategy", names_of(damping_strategies())));
  if (!damping.is_word("c", "critical")) assign(scene.damping.c, damping.number("c", kNotNegative));
  assign(scene.damping.alpha, damping.number("alpha", {0, 1, true, false}));
  damping.report_unknown_keys();
}

void read_integrator(TableReader integrator, Scene& scene) {
  IntegratorSpec& spec = scene.integrator;
  if (const auto method = integrator.choice("method", names_of(methods()))) {
    spec.method = *method;
  } else if (integrator.has("method")) {
    spec.method.clear();  // what the other keys have to fit is not known
  }
  assign(spec.treatment,
         integrator.choice("damping", Words<DampingTreatment>{{"automatic", DampingTreatment::automatic},
                                                              {"averaged", DampingTreatment::averaged},
                                                              {"lagged", DampingTreatment::lagged},
                                                              {"implicit", DampingTreatment::implicit},
                                                              {"exact", DampingTreatment::exact}}));
  assign(spec.unstable_reason, integrator.text("unstable_reason"));
  assign(spec.step, integrator.number("step", kPositive));
  if (const auto fraction = integrator.number("step_fraction", kPositive)) {
    spec.step_fraction = *fraction;
    if (*fraction > 1 && spec.unstable_reason.empty())
      integrator.problem("step_fraction",
                         fmt::format("{} of the critical step is unstable; say in unstable_reason why you want it, or "
                                     "stay at or below 1",
                                     *fraction));
  }
  if (integrator.has("step") && integrator.has("step_fraction"))
    integrator.problem("step_fraction", "give either step or step_fraction, not both");
  assign(spec.rtol, integrator.number("rtol", {0, 1, false, false}));
  assign(spec.atol_u, integrator.number("atol_u", kPositive));
  assign(spec.atol_v, integrator.number("atol_v", kPositive));
  integrator.report_unknown_keys();
}

void read_stop(TableReader stop, Scene& scene) {
  StopSpec& spec = scene.stop;
  assign(spec.residual, stop.number("residual", kNotNegative));
  assign(spec.kinetic_energy, stop.number("kinetic_energy", kNotNegative));
  assign(spec.hold, stop.number("hold", kNotNegative));
  assign(spec.time, stop.number("time", kNotNegative));
  assign(spec.steps, stop.integer("steps", 0, kNoLimit));
  assign(spec.wall_time, stop.number("wall_time", kNotNegative));
  // The default number of steps guards against endless runs; it is no aim that a scene may rely on.
  const bool limited = (stop.has("steps") && spec.steps > 0) || spec.wall_time > 0;
  if (spec.residual == 0 && spec.time == 0 && !limited)
    stop.problem("residual", "nothing would ever stop this run: set residual, time, steps or wall_time");
  stop.report_unknown_keys();
}

void read_probes(TableReader& root, Scene& scene) {
  for (TableReader& probe : root.tables("probe")) {
    ProbeSpec& spec = scene.probes.emplace_back();
    probe.require({"name", "fields"});
    assign(spec.name, probe.name("name"));
    assign(spec.point, probe.integer("point", 1, std::numeric_limits<int>::max()));
    assign(spec.at, probe.numbers("at", count_of_axes(scene)));
    assign(spec.fields, probe.texts("fields"));
    if (probe.has("fields") && spec.fields.empty())
      probe.problem("fields", "name at least one of u, v, strain, stress");
    if (probe.has("point") && probe.has("at")) probe.problem("at", "give either point or at, not both");
    if (!probe.has("point") && !probe.has("at"))
      probe.problem("", "give point, the number of a material point, or at, a place");
    probe.report_unknown_keys();
  }
}

void read_variants(TableReader& root, Scene& scene) {
  for (TableReader& variant : root.tables("variant")) {
    VariantSpec& spec = scene.variants.emplace_back();
    variant.require({"name", "set"});
    assign(spec.name, variant.name("name"));
    assign(spec.set, variant.texts("set"));
    variant.report_unknown_keys();
  }
}

}  // namespace

bool read_schema(TableReader& root, Scene& scene) {
  if (const auto dim = root.integer("dim", 1, 3); (dim && *dim != 1) || (root.has("dim") && !dim)) {
    if (dim) root.problem("dim", fmt::format("this version computes in 1 dimension only, not in {}", *dim));
    return false;
  }
  assign(scene.title, root.text("title"));
  root.table("constants");  // resolved already
  read_grid(root.required_table("grid", "a scene has a background grid with min, max and cells"), scene);
  read_body(root.required_table("body", "a scene has a body with a material"), scene);
  for (auto& [name, material] : root.named_tables("material")) read_material(name, std::move(material), scene);
  TableReader mass = root.table("mass");
  assign(scene.mass.kind,
         mass.choice("kind", Words<MassKind>{{"consistent", MassKind::consistent}, {"lumped", MassKind::lumped}}));
  mass.report_unknown_keys();
  read_loads(root, scene);
  read_fields(root, scene);
  read_damping(root.table("damping"), scene);
  read_integrator(root.table("integrator"), scene);
  read_stop(root.table("stop"), scene);
  TableReader output = root.table("output");
  assign(scene.output.every, output.number("every", kNotNegative));
  output.report_unknown_keys();
  read_probes(root, scene);
  read_variants(root, scene);
  root.report_unknown_keys();
  return true;
}

}  // namespace stillpoint
