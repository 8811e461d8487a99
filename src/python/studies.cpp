// The Python interface of whole runs, and of studies of many runs.
#include <stillpoint/compare.hpp>
#include <stillpoint/converge.hpp>
#include <stillpoint/run.hpp>
#include <stillpoint/safety.hpp>

#include <atomic>
#include <chrono>
#include <future>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

// Takes the option of this name from what a study was given.
template <class T>
void take(const py::kwargs& given, const char* name, T& option) {
  const py::object value = given[name];
  try {
    option = value.cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error(fmt::format("{}: expected {}, found {}", name, py::detail::make_caster<T>::name.text,
                                     py::repr(value).cast<std::string>()));
  }
}

CompareOptions compare_options(const py::kwargs& given) {
  CompareOptions options;
  take(given, "integrators", options.integrators);
  take(given, "strategies", options.strategies);
  take(given, "step_fractions", options.step_fractions);
  take(given, "tolerances", options.tolerances);
  take(given, "goal", options.goal);
  take(given, "limit", options.limit);
  take(given, "seconds", options.seconds);
  take(given, "repeats", options.repeats);
  take(given, "seed", options.seed);
  take(given, "overshoot", options.overshoot);
  take(given, "threads", options.threads);
  return options;
}

ConvergeOptions converge_options(const py::kwargs& given) {
  ConvergeOptions options{.refine = {}};
  std::vector<std::string> names;
  take(given, "refine", names);
  for (const std::string& name : names) {
    const auto refinement = refinement_of(name);
    if (!refinement) throw std::invalid_argument(fmt::format("there is no refinement '{}'", name));
    options.refine.push_back(*refinement);
  }
  take(given, "levels", options.levels);
  take(given, "ratio", options.ratio);
  take(given, "dominant", options.finds_dominant);
  take(given, "threads", options.threads);
  return options;
}

std::string run_to_json(const Scene& scene, const std::string& out, int threads, const py::object& progress) {
  SimulationOptions options{.out = out, .threads = threads};
  options.progress = progress_to(progress);
  return interruptible([&](const auto& asked) {
    options.interrupted = asked;
    return to_json(run(scene, options));
  });
}

// Writes files only if there is a folder for them.
std::string compare_to_json(const Scene& scene, const std::string& out, const py::object& progress,
                            const py::kwargs& given) {
  CompareOptions options = compare_options(given);
  options.progress = study_progress_to(progress);
  return interruptible([&](const auto& asked) {
    options.interrupted = asked;
    const Comparison comparison = compare(scene, options);
    if (!out.empty()) write_comparison(comparison, out);
    return to_json(comparison);
  });
}

// Likewise. varied: the settings of each scene.
std::string converge_to_json(const std::vector<Scene>& scenes, const std::vector<std::vector<std::string>>& varied,
                             const std::string& out, const py::object& progress, const py::kwargs& given) {
  ConvergeOptions options = converge_options(given);
  options.progress = study_progress_to(progress);
  std::vector<VariedScene> series;
  for (std::size_t k = 0; k < scenes.size(); ++k) series.push_back({scenes[k], varied[k]});
  return interruptible([&](const auto& asked) {
    options.interrupted = asked;
    const std::vector<ConvergenceStudy> studies = converge_varied(series, options);
    if (!out.empty()) write_studies(studies, out);
    return to_json(studies);
  });
}

std::string safety_to_json(const Scene& scene, const std::string& out, const py::object& progress,
                           const py::kwargs& given) {
  SafetyOptions options;
  take(given, "first", options.from);
  take(given, "last", options.to);
  take(given, "width", options.width);
  take(given, "threads", options.threads);
  options.progress = study_progress_to(progress);
  return interruptible([&](const auto& asked) {
    options.interrupted = asked;
    const SafetyStudy study = safety(scene, options);
    if (!out.empty()) write_safety(study, out);
    return to_json(study);
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
  const py::kw_only by_name;
  const py::arg scene("scene"), out("out"), progress("progress");
  module.def("run", run_to_json, scene, by_name, out, py::arg("threads"), progress);
  module.def("compare", compare_to_json, scene, by_name, out, progress);
  module.def("converge", converge_to_json, py::arg("scenes"), by_name, py::arg("varied"), out, progress);
  module.def("safety", safety_to_json, scene, by_name, out, progress);
  module.def("settings_of_series", settings_of_series, py::arg("vary"));
  module.def("spectrum", spectrum_as_dict);
}

}  // namespace stillpoint::python
