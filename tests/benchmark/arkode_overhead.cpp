// What a step costs outside the right-hand side: time in the integrator per degree of freedom and right-hand side.
//
//   u_i'' = −u_i,  1e5 degrees of freedom (y of 2e5)
//
// for leapfrog, for ARKODE's ERKStep with our vector operations and with SUNDIALS' own serial ones, and for a
// hand-written RK4, on one thread. The time of the right-hand side by itself is subtracted. Target: under 4 ns.
#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>
#include <benchmark/benchmark.h>
#include <nvector/nvector_serial.h>
#include <omp.h>

namespace {

using namespace stillpoint;

constexpr std::size_t dofs = 100'000;
constexpr double h = 1e-3;

/// Processor time of this thread, so that a busy machine does not count [s].
double seconds_now() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// M = I, R = u.
class Oscillators : public SemiDiscrete, private Tangents {
 public:
  const Mass& mass() const override { return mass_; }
  void external_force(double, ConstVec, Vec F) const override { std::ranges::fill(F, 0.0); }
  bool internal_force(double, ConstVec u, Vec R, TrialState&) const override {
    return std::ranges::copy(u, R.begin()), true;
  }
  const Tangents& tangents() const override { return *this; }

 private:
  void apply(Tangent, double, ConstVec, ConstVec du, Vec dR) const override { std::ranges::copy(du, dR.begin()); }
  SparseMatrix matrix(Tangent, double, ConstVec) const override { throw std::logic_error("not used"); }

  Mass mass_ = Mass::lumped(std::vector<double>(dofs, 1.0));
};

struct Problem {
  Oscillators oscillators;
  std::unique_ptr<Damping> damping = make_damping("none", 0, 0);
  RelaxationSystem system{oscillators, *damping};
  std::vector<double> y = std::vector<double>(2 * dofs, 1.0);
};

/// Seconds of one right-hand side, the best of many, over arrays that come from the same levels of memory as in a step.
double seconds_of_right_hand_side() {
  static const double seconds = [] {
    Problem problem;
    std::vector<std::vector<double>> ydot(6, std::vector<double>(2 * dofs));
    double best = 1;
    for (std::size_t k = 0; k < 300; ++k) {
      const double begin = seconds_now();
      problem.system(0, problem.y, ydot[k % ydot.size()]);
      best = std::min(best, seconds_now() - begin);
    }
    return best;
  }();
  return seconds;
}

void report(benchmark::State& state, double seconds_outside, long evaluations) {
  const double per = 1e9 / (static_cast<double>(dofs) * static_cast<double>(evaluations));
  state.counters["ns_per_dof_and_rhs"] = seconds_outside * per;
  state.counters["rhs_ns_per_dof"] = seconds_of_right_hand_side() * 1e9 / static_cast<double>(dofs);
  state.SetItemsProcessed(evaluations);
}

void step_by(benchmark::State& state, const std::string& method, bool stock_operations) {
  Problem problem;
  IntegratorOptions options;
  options.method = method;
  options.max_step = h;
  const auto integrator = make_integrator(options, problem.system);
  const NVectorHandle stock = N_VMake_Serial(static_cast<sunindextype>(problem.y.size()), problem.y.data(),
                                             static_cast<SUNContext>(problem.system.vectors().sundials_context()));
  {
    Vector y = stock_operations ? problem.system.vectors().adopt(stock) : problem.system.vectors().view(problem.y);
    integrator->start(0, y);
    integrator->step(1e6);
    const long before = problem.system.evaluations();
    double seconds = 0;
    for (auto _ : state) {
      const double begin = seconds_now();
      benchmark::DoNotOptimize(integrator->step(1e6));
      seconds += seconds_now() - begin;
    }
    const long evaluations = problem.system.evaluations() - before;
    report(state, seconds - seconds_of_right_hand_side() * static_cast<double>(evaluations), evaluations);
  }
  N_VDestroy(stock);
}

// y⁺ = y + h/6 (k_1 + 2 k_2 + 2 k_3 + k_4), as one would write it by hand: a loop a stage.
void hand_written_rk4(benchmark::State& state) {
  Problem problem;
  const std::size_t n = problem.y.size();
  std::vector<double> k1(n), k2(n), k3(n), k4(n), stage(n);
  double* y = problem.y.data();
  double seconds = 0;
  for (auto _ : state) {
    const double begin = seconds_now();
    problem.system(0, problem.y, k1);
    for (std::size_t i = 0; i < n; ++i) stage[i] = y[i] + h / 2 * k1[i];
    problem.system(0, stage, k2);
    for (std::size_t i = 0; i < n; ++i) stage[i] = y[i] + h / 2 * k2[i];
    problem.system(0, stage, k3);
    for (std::size_t i = 0; i < n; ++i) stage[i] = y[i] + h * k3[i];
    problem.system(0, stage, k4);
    for (std::size_t i = 0; i < n; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    seconds += seconds_now() - begin;
  }
  const long evaluations = problem.system.evaluations();
  report(state, seconds - seconds_of_right_hand_side() * static_cast<double>(evaluations), evaluations);
}
BENCHMARK(hand_written_rk4);

const int registered = [] {
  omp_set_num_threads(1);
  for (const std::string method : {"leapfrog", "erk:rk4", "erk:sofroniou-spaletta-5-3-4", "erk:bogacki-shampine-4-2-3",
                                   "erk:zonneveld-5-3-4", "erk:dormand-prince-7-4-5", "erk:fehlberg-13-7-8"}) {
    for (const bool stock : {false, true}) {
      if (stock && method == "leapfrog") continue;
      benchmark::RegisterBenchmark((method + (stock ? ", SUNDIALS' vector operations" : "")).c_str(),
                                   [method, stock](benchmark::State& state) { step_by(state, method, stock); });
    }
  }
  return 0;
}();

}  // namespace
