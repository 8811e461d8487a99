// Cost of a step in the plane, ns per material point, for each basis, law and number of threads; where the time goes;
// and how it grows with the number of points. The body is that of problems/slope.toml, four points in each cell.
#include <stillpoint/integrator.hpp>
#include <stillpoint/neo_hookean.hpp>
#include <stillpoint/own_law.hpp>
#include <stillpoint/relaxation_system.hpp>

#include <array>
#include <cmath>
#include <memory>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <omp.h>

#include "points_in_space.hpp"
#include "scenes.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/kernels/nodal_force.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/points/make_body.hpp"

namespace {

using namespace stillpoint;

const char* const bases[] = {"linear", "quadratic", "cubic"};
const char* const laws[] = {"linear-elastic", "neo-hookean", "hencky", "drucker-prager", "own-neo-hookean"};
constexpr int law_count = 5;

// The built-in law as one of a program's own: what the way round by own_law.hpp costs.
template <StressState S>
struct OwnNeoHookean : NeoHookean<S> {
  explicit OwnNeoHookean(const LawParameters& of) : NeoHookean<S>(LameParameters::from(of.at("E"), of.at("nu"))) {}
};
[[maybe_unused]] const bool added = [] {
  add_law<OwnNeoHookean, StressState::plane_strain>({.name = laws[4], .parameters = {{.name = "E"}, {.name = "nu"}}});
  return true;
}();

// cells along x; the body fills cells × cells/2 of them.
Scene block(int basis, int law, int cells) {
  const int rows = cells / 2;
  Scene scene = scenes::load(
      "slope", {std::string("grid.basis=") + bases[basis], "grid.max=[6.0, " + std::to_string(3.0 + 3.0 / rows) + "]",
                "grid.cells=[" + std::to_string(cells) + ", " + std::to_string(rows + 1) + "]", "output.stages=[]",
                "wall[1].motion=0"});
  scene.materials.at("soil").law = laws[law];
  const bool plastic = law == 3;
  if (!plastic) scene.geostatic.reset();
  if (law == 0) scene.phase.max_motion = PhaseSpec::never;
  return scene;
}

void count_points(benchmark::State& state, std::size_t points, const std::string& label) {
  state.SetLabel(label);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points));
  state.counters["ns/point"] = benchmark::Counter(
      static_cast<double>(points) * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// All of a step but the change of phases: forces, damping, contact, integrator, commit.
void step(benchmark::State& state, const Scene& scene, int threads, const std::string& label) {
  const auto phase = make_phase(scene);
  const auto damping = make_damping(scene.damping.strategy, 0, scene.damping.alpha);
  omp_set_num_threads(threads);
  RelaxationSystem system(*phase, *damping);
  Vector y = system.vectors().make(2 * system.size());
  IntegratorOptions options;
  options.max_step = 1e-6;  // stable for every size: the search for the critical one would take longer than the steps
  const auto integrator = make_integrator(options, system);
  integrator->start(0, y);
  for (auto _ : state) {
    const StepReport report = integrator->step(1e9);
    if (report.status != StepReport::Status::ok) state.SkipWithError("the step failed");
    integrator->accept(report.t);
  }
  count_points(state, phase->points(), label);
}

void plane_step(benchmark::State& state) {
  const int basis = static_cast<int>(state.range(0)), law = static_cast<int>(state.range(1));
  step(state, block(basis, law, 120), static_cast<int>(state.range(2)), std::string(bases[basis]) + ", " + laws[law]);
}
void every_case(benchmark::internal::Benchmark* benchmark) {
  for (int basis = 0; basis < 3; ++basis) {
    for (int law = 0; law < law_count; ++law) {
      for (const int threads : {1, 2}) benchmark->Args({basis, law, threads});
    }
  }
  benchmark->ArgNames({"basis", "law", "threads"})->UseRealTime()->Unit(benchmark::kMicrosecond);
}
BENCHMARK(plane_step)->Apply(every_case);

// What it costs that points share their change of volume, one thread.
void dilatation_step(benchmark::State& state) {
  const int basis = static_cast<int>(state.range(0)), law = static_cast<int>(state.range(1));
  Scene scene = block(basis, law, 120);
  const auto shared = static_cast<std::size_t>(state.range(2));
  scene.phase.dilatation = std::array{Dilatation::points, Dilatation::cells, Dilatation::splines}.at(shared);
  step(state, scene, 1,
       fmt::format("{}, {}, {}", bases[basis], laws[law], std::array{"points", "cells", "splines"}.at(shared)));
}
BENCHMARK(dilatation_step)
    ->ArgNames({"basis", "law", "shared"})
    ->ArgsProduct({{0, 1, 2}, {0, 1, 2, 3}, {0, 1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

// 10⁴ to 10⁷ points, linear basis, Drucker–Prager.
void size_step(benchmark::State& state) {
  step(state, block(0, 3, static_cast<int>(state.range(0))), static_cast<int>(state.range(1)),
       "linear, drucker-prager");
}
BENCHMARK(size_step)
    ->ArgNames({"cells", "threads"})
    ->ArgsProduct({{70, 224, 708, 2236}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

// --- where the time goes, one thread ---------------------------------------------------------------

constexpr Kinematics K = Kinematics::plane;

template <AxisBasis B>
struct Parts {
  explicit Parts(int basis, int law)
      : scene(block(basis, law, 120)), grid(grid_at<2>(scene, 0)), body(make_body<K>(scene, grid, true)) {
    omp_set_num_threads(1);
    weights.rebuild(grid, body.points);
    const auto functions = static_cast<std::size_t>(TensorBasis<B, 2>::count(grid));
    corner_sum = test::corners_of(body.points, weights, functions);
    force.rebuild(body.points, weights, corner_sum);
    dofs.emplace(std::vector<char>(functions, 1), 2, std::vector<int>{});
    u.resize(2 * functions);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = 1e-6 * std::sin(static_cast<double>(i));
    R.resize(dofs->size());
  }
  Scene scene;
  Grid<2> grid;
  Body<K> body;
  PointWeights<B, K> weights;
  CornerSum corner_sum;
  NodalForce<B, K> force;
  typename NodalForce<B, K>::Work work;
  std::optional<DegreesOfFreedom> dofs;
  std::vector<double> u, R;
};

// Gather and scatter around a law that only copies.
template <AxisBasis B>
void gather_and_scatter(benchmark::State& state, int basis) {
  Parts<B> parts(basis, 3);
  const std::vector<double> before(parts.u.size(), 0.0);
  const auto copy = [](std::size_t, PointBlock<K>& b) {
    for (int c = 0; c < 4; ++c) std::copy_n(b.H[c].begin(), b.count, b.VP[c].begin());
    return 0.0;
  };
  for (auto _ : state) {
    parts.force.template evaluate<true>(parts.u.data(), before.data(), copy, *parts.dofs, parts.R, {}, parts.work);
    benchmark::DoNotOptimize(parts.R.data());
  }
  count_points(state, parts.body.points.size(), bases[basis]);
}
void gather_and_scatter_linear(benchmark::State& state) { gather_and_scatter<BSpline<1>>(state, 0); }
BENCHMARK(gather_and_scatter_linear)->Unit(benchmark::kMicrosecond);
void gather_and_scatter_quadratic(benchmark::State& state) { gather_and_scatter<BSpline<2>>(state, 1); }
BENCHMARK(gather_and_scatter_quadratic)->Unit(benchmark::kMicrosecond);
void gather_and_scatter_cubic(benchmark::State& state) { gather_and_scatter<BSpline<3>>(state, 2); }
BENCHMARK(gather_and_scatter_cubic)->Unit(benchmark::kMicrosecond);

// The law alone, over the blocks of the whole body.
void law_alone(benchmark::State& state) {
  const int law = static_cast<int>(state.range(0));
  Parts<BSpline<1>> parts(0, law);
  PointBlock<K> b{};
  const std::size_t points = parts.body.points.size();
  std::vector<double> trial(parts.body.materials[0]->info().history_size);
  double bad = 0;
  for (auto _ : state) {
    for (b.first = 0; b.first < points; b.first += b.count) {
      b.count = std::min(PointBlock<K>::size, points - b.first);
      bad += parts.body.materials[0]->stress(b, parts.body.points.volume.data(), 1e-4, trial.data());
    }
    benchmark::DoNotOptimize(bad);
  }
  count_points(state, points, laws[law]);
}
BENCHMARK(law_alone)->ArgName("law")->DenseRange(0, law_count - 1)->Unit(benchmark::kMicrosecond);

// A change of phases: points move on, are sorted, and everything frozen is made anew.
void change_of_phase(benchmark::State& state) {
  const auto phase = make_phase(block(static_cast<int>(state.range(0)), 3, 120));
  omp_set_num_threads(static_cast<int>(state.range(1)));
  std::vector<double> v = phase->initial_velocity(0);
  double t = 0;
  for (auto _ : state) {
    const std::vector<double> rest(phase->size(), 0.0);
    v = phase->control().begin_next(t += 1e-9, rest, v);
  }
  count_points(state, phase->points(), bases[state.range(0)]);
}
BENCHMARK(change_of_phase)
    ->ArgNames({"basis", "threads"})
    ->ArgsProduct({{0, 1, 2}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

// Half a second of the slope, with phases and classically: ns per point and step of the whole run.
void whole_run(benchmark::State& state) {
  const std::string max_motion = state.range(0) == 0 ? "0" : "0.1";
  Scene scene = scenes::load("slope", {"phase.max_motion=" + max_motion, "stop.time=0.5", "output.stages=[]"});
  double ns = 0;
  for (auto _ : state) {
    const Summary summary = run(scene, {.threads = static_cast<int>(state.range(1))});
    ns = summary.ns_per_point_step;
  }
  state.SetLabel(state.range(0) == 0 ? "max_motion = 0" : "max_motion = 0.1");
  state.counters["ns/point/step"] = ns;
}
BENCHMARK(whole_run)
    ->ArgNames({"phases", "threads"})
    ->ArgsProduct({{0, 1}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
