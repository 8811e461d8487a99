// The Python interface of whole runs, and of studies of many runs.
#include <stillpoint/compare.hpp>
#include <stillpoint/converge.hpp>
#include <stillpoint/run.hpp>

#include <atomic>
#include <chrono>
#include <future>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "python/bindings.hpp"
#include "python/progress.hpp"
#include "scene/throw_scene_error.hpp"
#include "study/spectrum_study.hpp"

namespace stillpoint::python {
namespace {

namespace py = pybind11;

// Runs function(asked) in a thread of its own, without the GIL, while this thread checks for signals, which only
// Python's first thread can do. asked(): whether Ctrl-C was pressed; the function then ends in good order and the
// exception is raised.
template <class Function>
auto interruptible(const Function& function) {
  std::atomic<bool> asked = false;
  std::unique_ptr<py::error_already_set> raised;
  auto work = std::async(std::launch::async, [&] { return function([&asked] { return asked.load(); }); });
  {
    const py::gil_scoped_release released;
    while (work.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
      const py::gil_scoped_acquire gil;
      if (raised || PyErr_CheckSignals() == 0) continue;
      raised = std::make_unique<py::error_already_set>();
      asked = true;
    }
  }
  if (raised) throw py::error_already_set(*raised);
  return work.get();
}

std::string run_with_files(const Scene& scene, const std::string& out, const std::string& resume, int threads,
                           const py::object& progress) {
  SimulationOptions options{.out = out, .resume = resume, .threads = threads};
  options.progress = progress_to(progress);
  return interruptible([&](const auto& asked) {
    options.interrupted = asked;
    return to_json(run(scene, options));
  });
}

// Writes compare.json and compare.csv into a folder.
void compare_into(const std::string& folder, const std::string& scene, const std::vector<std::string>& overrides,
                  CompareOptions options, const py::object& progress) {
  options.progress = study_progress_to(progress);
  interruptible([&](const auto& asked) {
    options.interrupted = asked;
    write_comparison(compare(scene, overrides, options), folder);
    return true;
  });
}

// Writes converge.json and converge.csv into a folder.
void converge_into(const std::string& folder, const std::string& scene, const std::vector<std::string>& overrides,
                   const std::vector<std::string>& refine, const std::vector<std::string>& vary,
                   ConvergeOptions options, const py::object& progress) {
  options.refine.clear();
  for (const std::string& name : refine) {
    const auto refinement = refinement_of(name);
    if (!refinement) throw std::invalid_argument(fmt::format("there is no refinement '{}'", name));
    options.refine.push_back(*refinement);
  }
  options.progress = study_progress_to(progress);
  interruptible([&](const auto& asked) {
    options.interrupted = asked;
    std::vector<Variation> varied;
    for (const std::string& text : vary) varied.push_back(variation_of(text));
    write_studies(converge_varied(scene, overrides, varied, options), folder);
    return true;
  });
}

py::dict spectrum_as_dict(const Scene& scene) {
  using namespace py::literals;
  const SpectrumStudy study =
      interruptible([&](const auto&) { return located(scene, [&] { return spectrum_of(scene); }); });
  py::list estimates, steps;
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [what, how, found] : study.estimates)
    estimates.append(py::make_tuple(what, how, found.converged ? found.omega : none, found.iterations, found.wall_s));
  for (const MethodStep& step : study.steps)
    steps.append(py::make_tuple(step.method, step.critical_step, step.evaluations));
  const bool is_held = study.omega_1.converged;
  return py::dict("omega_1"_a = is_held ? study.omega_1.omega : none, "omega_max"_a = study.omega_max.omega,
                  "kappa"_a = is_held ? study.kappa() : none,
                  "critical_damping"_a = is_held ? study.critical_damping() : none, "estimates"_a = estimates,
                  "critical_steps"_a = steps);
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("run_with_files", run_with_files);
  module.def("compare_into", [](const std::string& folder, const std::string& scene,
                                const std::vector<std::string>& overrides, const std::vector<std::string>& integrators,
                                const std::vector<std::string>& strategies, const std::vector<double>& step_fractions,
                                const std::vector<double>& tolerances, double goal, double limit, double seconds,
                                int repeats, unsigned seed, bool overshoot, int threads, const py::object& progress) {
    compare_into(folder, scene, overrides,
                 {.integrators = integrators,
                  .strategies = strategies,
                  .step_fractions = step_fractions,
                  .tolerances = tolerances,
                  .goal = goal,
                  .limit = limit,
                  .seconds = seconds,
                  .repeats = repeats,
                  .seed = seed,
                  .overshoot = overshoot,
                  .threads = threads},
                 progress);
  });
  module.def("converge_into", [](const std::string& folder, const std::string& scene,
                                 const std::vector<std::string>& overrides, const std::vector<std::string>& refine,
                                 const std::vector<std::string>& vary, int levels, double ratio, bool finds_dominant,
                                 int threads, const py::object& progress) {
    converge_into(folder, scene, overrides, refine, vary,
                  {.levels = levels, .ratio = ratio, .finds_dominant = finds_dominant, .threads = threads}, progress);
  });
  module.def("spectrum_of", spectrum_as_dict);
}

}  // namespace stillpoint::python
