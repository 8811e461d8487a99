#include "scene/input/schema.hpp"

#include <stillpoint/damping.hpp>
#include <stillpoint/integrator.hpp>

#include <fmt/format.h>

#include "scene/input/schema_parts.hpp"

namespace stillpoint {
namespace {

constexpr int kMostCells = 10'000'000;  // along an axis; a larger count is a slip, not a grid
constexpr int kMostXpicOrder = 20;

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
  assign(scene.grid.follow, grid.name("follow"));
  grid.report_unknown_keys();
}

void read_mass(TableReader mass, Scene& scene) {
  MassSpec& spec = scene.mass;
  if (scene.dim > 1) spec.kind = MassKind::lumped;
  const auto kind =
      mass.choice("kind", Words<MassKind>{{"consistent", MassKind::consistent}, {"lumped", MassKind::lumped}});
  if (kind) spec.kind = *kind;
  if (mass.is_word("scaling", "gershgorin")) {
    spec.scaling = MassScaling::gershgorin;
  } else {
    assign(spec.factor, mass.number("scaling", kPositive));
  }
  const bool scaled = spec.scaling == MassScaling::gershgorin || spec.factor != 1;
  if (scaled && spec.kind != MassKind::lumped && (kind || !mass.has("kind")))
    mass.problem("scaling", "needs mass.kind = \"lumped\"");
  mass.report_unknown_keys();
}

void read_phase(TableReader phase, Scene& scene) {
  PhaseSpec& spec = scene.phase;
  if (!phase.is_word("max_motion", "none")) assign(spec.max_motion, phase.number("max_motion", {0, 1, true, false}));
  assign(spec.max_strain, phase.number("max_strain", kPositive));
  const auto transfer = phase.choice(
      "transfer",
      Words<Transfer>{
          {"flip", Transfer::flip}, {"pic", Transfer::pic}, {"apic", Transfer::apic}, {"xpic", Transfer::xpic}});
  const bool known = transfer || !phase.has("transfer");
  if (transfer) spec.transfer = *transfer;
  assign(spec.flip_share, phase.number("flip_share", {0, 1, true, true}));
  assign(spec.xpic_order, phase.integer("xpic_order", 1, kMostXpicOrder));
  if (known && phase.has("flip_share") && spec.transfer != Transfer::flip)
    phase.problem("flip_share", "goes with transfer = \"flip\" only");
  if (known && phase.has("xpic_order") && spec.transfer != Transfer::xpic)
    phase.problem("xpic_order", "goes with transfer = \"xpic\" only");
  phase.report_unknown_keys();
}

void read_damping(TableReader damping, Scene& scene) {
  const auto strategy = damping.choice("strategy", names_of(damping_strategies()));
  const bool known = strategy || !damping.has("strategy");
  assign(scene.damping.strategy, std::optional(strategy));
  if (!damping.is_word("c", "critical")) assign(scene.damping.c, damping.number("c", kNotNegative));
  assign(scene.damping.alpha, damping.number("alpha", {0, 1, true, false}));
  assign(scene.damping.peak,
         damping.choice("peak", Words<Peak>{{"half-step", Peak::half_step}, {"parabolic", Peak::parabolic}}));
  assign(scene.damping.quotient,
         damping.choice("quotient", Words<Quotient>{{"diagonal", Quotient::diagonal}, {"global", Quotient::global}}));
  if (known) {
    const DampingInfo& info = find_damping(scene.damping.strategy);
    const auto refuse = [&](const char* key, const char* owners) {
      if (damping.has(key) && !info.takes(key))
        damping.problem(key, fmt::format("goes with strategy = {}, not with '{}'", owners, info.name));
    };
    refuse("peak", "\"kinetic\"");
    refuse("quotient", "\"adaptive\"");
    refuse("c", "\"viscous\" or \"identity\"");
    refuse("alpha", "\"one-sided\", \"cundall\" or \"combined\"");
  }
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
  assign(spec.distance, stop.number("distance", kNotNegative));
  assign(spec.kinetic_energy, stop.number("kinetic_energy", kNotNegative));
  assign(spec.dwell, stop.number("hold", kNotNegative));
  assign(spec.time, stop.number("time", kNotNegative));
  assign(spec.steps, stop.integer("steps", 0, kNoLimit));
  assign(spec.wall_time, stop.number("wall_time", kNotNegative));
  // The default number of steps guards against endless runs; it is no aim that a scene may rely on.
  const bool limited = (stop.has("steps") && spec.steps > 0) || spec.wall_time > 0;
  if (!spec.wants_equilibrium() && spec.time == 0 && !limited)
    stop.problem("residual", "nothing would ever stop this run: set residual, distance, time, steps or wall_time");
  stop.report_unknown_keys();
}

void read_output(TableReader output, Scene& scene) {
  OutputSpec& spec = scene.output;
  assign(spec.every, output.number("every", kNotNegative));
  assign(spec.snapshots, output.numbers("stages"));
  assign(spec.fields_every, output.number("fields_every", kNotNegative));
  output.report_unknown_keys();
}

void read_probes(TableReader& root, Scene& scene) {
  for (TableReader& probe : root.tables("probe")) {
    ProbeSpec& spec = scene.probes.emplace_back();
    probe.require({"name"});
    assign(spec.name, probe.name("name"));
    const auto kind =
        probe.choice("kind", Words<ProbeKind>{{"point", ProbeKind::point}, {"slope_angle", ProbeKind::slope_angle}});
    if (kind) spec.kind = *kind;
    assign(spec.point, probe.integer("point", 1, std::numeric_limits<int>::max()));
    assign(spec.at, probe.numbers("at", count_of_axes(scene)));
    assign(spec.fields, probe.texts("fields"));
    if (spec.kind == ProbeKind::slope_angle) {
      if (scene.dim == 1) probe.problem("kind", "a slope has an angle in two dimensions only");
      for (const char* key : {"point", "at", "fields"})
        if (probe.has(key)) probe.problem(key, "goes with a point only; the angle of a slope has nothing but a name");
    } else if (kind || !probe.has("kind")) {
      probe.require({"fields"});
      if (probe.has("fields") && spec.fields.empty())
        probe.problem("fields", fmt::format("name at least one of {}", fmt::join(probe_fields(scene.dim), ", ")));
      if (probe.has("point") && probe.has("at")) probe.problem("at", "give either point or at, not both");
      if (!probe.has("point") && !probe.has("at"))
        probe.problem("", "give point, the number of a material point, or at, a place");
    }
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
  if (root.has("dim")) {
    const auto dim = root.integer("dim", 1, 3);
    if (dim == 3) root.problem("dim", "this version computes in 1 or 2 dimensions, not in 3");
    if (!dim || dim == 3) return false;
    scene.dim = static_cast<int>(*dim);
  }
  assign(scene.title, root.text("title"));
  root.table("constants");  // resolved already
  read_grid(root.required_table("grid", "a scene has a background grid with min, max and cells"), scene);
  read_bodies(root, scene);
  read_materials(root, scene);
  read_mass(root.table("mass"), scene);
  read_phase(root.table("phase"), scene);
  read_loads(root, scene);
  read_fields(root, scene);
  read_damping(root.table("damping"), scene);
  read_integrator(root.table("integrator"), scene);
  read_stop(root.table("stop"), scene);
  read_output(root.table("output"), scene);
  read_probes(root, scene);
  read_variants(root, scene);
  root.report_unknown_keys();
  return true;
}

}  // namespace stillpoint
