// Internal forces in space: ns per point of gather, law and scatter in cells with eight points each.
#include <cmath>
#include <string>

#include <benchmark/benchmark.h>
#include <omp.h>

#include "points_in_space.hpp"
#include "space/materials/point_material.hpp"

namespace {

using namespace stillpoint;

const char* const laws[] = {"linear-elastic", "neo-hookean", "hencky", "drucker-prager"};

// range(0): law, range(1): cells along a side, range(2): threads.
template <AxisBasis B>
void force_in_space(benchmark::State& state) {
  test::CubeOfCells<B> cube(static_cast<int>(state.range(1)));
  const MaterialSpec spec{.name = "soil",
                          .law = laws[state.range(0)],
                          .parameters = {{"E", 1e7},
                                         {"nu", 0.3},
                                         {"rho", 1},
                                         {"phi", 30},
                                         {"psi", 0},
                                         {"c", 1e3},
                                         {"fluidity", 0},
                                         {"tension", 1e9},
                                         {"phi_residual", 30},
                                         {"c_residual", 1e3},
                                         {"softening_strain", 0}},
                          .choices = {{"cone", "mean"}}};
  const auto material = make_point_material<Kinematics::space>(spec, StressState::space, 0, cube.points.size(), false);
  omp_set_num_threads(static_cast<int>(state.range(2)));
  std::vector<double> u(cube.dofs.size()), before(u.size()), R(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = 1e-3 * std::sin(static_cast<double>(i)), before[i] = 0.9 * u[i];
  std::vector<double> history(material->info().history_size);
  const double* V = cube.points.volume.data();
  const auto answer = [&](std::size_t, PointBlock<Kinematics::space>& block) {
    return material->stress(block, V, 0, history.data());
  };
  bool good = true;
  for (auto _ : state) {
    if (material->info().history_dependent)
      good = cube.force.template evaluate<true>(u.data(), before.data(), answer, cube.dofs, R, {}, cube.work) && good;
    else
      good = cube.force.template evaluate<false>(u.data(), nullptr, answer, cube.dofs, R, {}, cube.work) && good;
  }
  if (!good) state.SkipWithError("a force is not finite");
  state.SetLabel(laws[state.range(0)]);
  state.counters["ns/point"] =
      benchmark::Counter(static_cast<double>(cube.points.size()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void settings(benchmark::internal::Benchmark* of) {
  of->ArgsProduct({{0, 1, 2, 3}, {12, 50}, {1, 2}})
      ->ArgNames({"law", "cells", "threads"})
      ->UseRealTime()
      ->Unit(benchmark::kMicrosecond);
}
BENCHMARK_TEMPLATE(force_in_space, BSpline<1>)->Apply(settings);
BENCHMARK_TEMPLATE(force_in_space, BSpline<2>)->Apply(settings);
BENCHMARK_TEMPLATE(force_in_space, BSpline<3>)->Apply(settings);

}  // namespace
