// Cost of a UMAT, ns per material point: the call alone, always for the same point, and the law around it, with all
// that the call is given and leaves. The routine is tests/umats/von_mises.c, compiled by gcc -O2.
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "compiled_umat.hpp"
#include "space/materials/umat.hpp"
#include "space/materials/umat_library.hpp"

namespace {

using namespace stillpoint;

MaterialSpec material() {
  static const test::TemporaryFolder folder;
  static const auto library = test::compiled_umat(folder, "von_mises.c", "von_mises");
  MaterialSpec spec;
  spec.name = "clay";
  spec.library = library;
  spec.props = {1e4, 0.3, 20};
  spec.statev = {"plastic_strain"};
  return spec;
}

void count_points(benchmark::State& state, std::size_t points) {
  state.counters["ns/point"] = benchmark::Counter(
      static_cast<double>(points) * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <StressState S>
void call_alone(benchmark::State& state) {
  const MaterialSpec spec = material();
  const auto library = UmatLibrary::open(spec.library);
  UmatArguments call{};
  call.statev.resize(1);
  call.props = spec.props;
  call.ndi = 3;
  call.ntens = stress_components(S);
  call.nshr = call.ntens - 3;
  call.nstatv = 1;
  call.nprops = 3;
  for (auto _ : state) {
    call.stress.fill(0);
    call.dstran.fill(1e-5);
    library->call(call);
    benchmark::DoNotOptimize(call.stress);
  }
  count_points(state, 1);
}

template <StressState S>
void law(benchmark::State& state) {
  constexpr std::size_t points = 64, stride = points + 8, of_all = 4109, n = gradient_components(S);
  const auto answers = make_umat<S>(material());
  std::vector<double> H(n * stride), dH(n * stride), P(n * stride), committed(answers->history() * of_all),
      next(answers->history() * of_all);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1e-4, 1e-4);
  for (auto* const gradient : {&H, &dH})
    for (double& component : *gradient) component = any(random);
  for (auto _ : state) {
    answers->first_piola({points, stride, H.data(), dH.data(), P.data(), 0.1, of_all, committed.data(), next.data()});
    benchmark::DoNotOptimize(P.data());
  }
  count_points(state, points);
}

BENCHMARK(call_alone<StressState::plane_strain>)->Name("umat_call/alone/plane");
BENCHMARK(call_alone<StressState::space>)->Name("umat_call/alone/space");
BENCHMARK(law<StressState::plane_strain>)->Name("umat_call/law/plane");
BENCHMARK(law<StressState::space>)->Name("umat_call/law/space");

}  // namespace
