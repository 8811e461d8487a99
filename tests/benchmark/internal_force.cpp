// Cost of the loops over material points: ns per point of R(u), and of a whole leapfrog step, for each basis, law and
// number of threads. Items are material points.
#include <stillpoint/relaxation_system.hpp>

#include <benchmark/benchmark.h>
#include <omp.h>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace {

using namespace stillpoint;

const char* const bases[] = {"linear", "quadratic", "cubic", "hermite"};
const char* const laws[] = {"linear-elastic", "neo-hookean"};

// range(0): basis, range(1): law, range(2): cells, four points in each.
Scene scene_of(const benchmark::State& state) {
  return scenes::bar({std::string("grid.basis=") + bases[state.range(0)],
                      std::string("material.bar.law=") + laws[state.range(1)], "body.state=uniaxial-strain",
                      "material.bar.nu=0.3", "body.points_per_cell=4", "mass.kind=lumped", "damping.strategy=viscous",
                      "damping.c=0.3", "stop.residual=0", "stop.time=1",
                      "grid.cells=" + std::to_string(state.range(2))});
}

void label(benchmark::State& state, const LagrangianPhase& phase) {
  state.SetLabel(std::string(bases[state.range(0)]) + ", " + laws[state.range(1)]);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(phase.points()));
  state.counters["ns/point"] =
      benchmark::Counter(static_cast<double>(phase.points()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void internal_force(benchmark::State& state) {
  const auto phase = make_phase(scene_of(state));
  omp_set_num_threads(static_cast<int>(state.range(3)));
  const std::vector<double> u(phase->size(), 1e-6);
  std::vector<double> R(phase->size());
  const auto trial = phase->make_trial();
  for (auto _ : state) benchmark::DoNotOptimize(phase->internal_force(0, u, R, *trial));
  label(state, *phase);
}

void leapfrog_step(benchmark::State& state) {
  Model model = make_model(scene_of(state));
  omp_set_num_threads(static_cast<int>(state.range(3)));
  RelaxationSystem system(*model.phase, *model.damping);
  Vector y = system.vectors().make(2 * system.size());
  const auto integrator = make_integrator(model.integrator, system);
  integrator->start(0, y);
  for (auto _ : state) {
    if (integrator->step(1e9).status != StepReport::Status::ok) state.SkipWithError("the step failed");
  }
  label(state, *model.phase);
}

void every_case(benchmark::internal::Benchmark* benchmark) {
  for (int law = 0; law < 2; ++law) {
    for (int basis = 0; basis < 4; ++basis) {
      for (const int threads : {1, 2}) benchmark->Args({basis, law, 25'000, threads});
    }
  }
  benchmark->ArgNames({"basis", "law", "cells", "threads"})->UseRealTime()->Unit(benchmark::kMicrosecond);
}

BENCHMARK(internal_force)->Apply(every_case);
BENCHMARK(leapfrog_step)->Apply(every_case);

}  // namespace
