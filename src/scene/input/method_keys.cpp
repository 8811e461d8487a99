// The tables of how a scene is brought to rest, and of what is written.
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/gpl.hpp"
#include "scene/input/scene_keys.hpp"

namespace stillpoint {
namespace {

/// The hint about a word that stands in the wrong table.
std::string hint(const auto* row, const char* is, const char* key) {
  return row ? fmt::format("'{}' is {}; write {} = \"{}\"", row->name, is, key, row->name) : "";
}

}  // namespace

[[gnu::no_sanitize_address]] void add_method(Tables& tables, const Catalogue& catalogue) {
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
      .key("alpha", &DampingSpec::alpha, "of a local damping: share of the out-of-balance force",
           {.range = kShare,
            .fallback =
                "0.7; 0.05 if supports, walls, rigid bodies or [load] move up to the end, over many phases and with no "
                "equilibrium asked for"})
      .key("peak", &DampingSpec::peak, "of the kinetic energy, in kinetic damping",
           {.words = {"half-step", "parabolic"}})
      .key("quotient", &DampingSpec::quotient, "Rayleigh's, for omega_1^2 of adaptive damping",
           {.words = {"diagonal", "global"}});

  const std::string own_scale = "rtol times the scene's own scale";

  tables.add({"integrator", "the steps in time"}, &Scene::integrator)
      .key(
          "method", &IntegratorSpec::method, "of time integration",
          {.words = names_of(catalogue.methods), .listed_by = "stillpoint list integrators", .hint = why_no_integrator})
      .key("damping", &IntegratorSpec::treatment, "how C v is treated in a step",
           {.words = {kTreatments.begin(), kTreatments.end()}})
      .key("step", &IntegratorSpec::step, "fixed; or step_fraction", {.range = kPositive, .unit = "s"})
      .key("step_fraction", &IntegratorSpec::step_fraction, "of the critical step; caps an adaptive one",
           {.range = kPositive, .fallback = "0.9; 0.8 with rigid bodies"})
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

[[gnu::no_sanitize_address]] void add_output(Tables& tables) {
  tables.add({"output", "what is written, and when"}, &Scene::output)
      .key("every", &OutputSpec::every, "time between rows of the history; 0: chosen",
           {.range = kNotNegative, .unit = "s"})
      .key("stages", &OutputSpec::snapshots, "times of the fields of all points", {.unit = "s", .list = true})
      .key("fields_every", &OutputSpec::fields_every, "or the time between them", {.range = kNotNegative, .unit = "s"})
      .key("format", &OutputSpec::format,
           "of these fields: fields.h5 with fields.xdmf, or fields.pvd and grid.pvd with files of VTK's",
           {.words = {"xdmf", "vtu"}, .fallback = "[\"xdmf\"]", .list = true});

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
           "u, v, strain, stress; with dim > 1 their components, as u.x and stress.yy, plastic_strain, and of "
           "undrained ground pore_pressure and effective_stress, of Cam clay pc and void_ratio; the names of statev; "
           "of the "
           "body "
           "volume, momentum, with dim = 2 momentum.x, momentum.y and angular_momentum about the origin, with dim = 3 "
           "momentum.x and angular_momentum.x to z",
           {.list = true});

  tables.add({"variant", "the same scene with other values, drawn beside it", Repeat::array}, &Scene::variants)
      .key("name", &VariantSpec::name, "in the picture", {.required = true})
      .key("set", &VariantSpec::set, "\"key=value\" each, as for --set", {.required = true, .list = true});
}

}  // namespace stillpoint
