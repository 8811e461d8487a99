// Progress reports to a Python callable while C++ works.
#pragma once

#include <stillpoint/simulation.hpp>
#include <stillpoint/study_progress.hpp>

#include <functional>

#include "python/held.hpp"

namespace stillpoint::python {

/// The reporting function; empty if the callable is None.
inline std::function<void(const Progress&)> progress_to(const pybind11::object& callable) {
  if (callable.is_none()) return {};
  return [held = hold(callable)](const Progress& p) {
    using namespace pybind11::literals;
    const pybind11::gil_scoped_acquire gil;
    (*held)(pybind11::dict("t"_a = p.t, "end_time"_a = p.end_time, "steps"_a = p.steps, "residual"_a = p.residual,
                           "residual_goal"_a = p.residual_goal, "wall_s"_a = p.wall_s));
  };
}

inline std::function<void(const StudyProgress&)> study_progress_to(const pybind11::object& callable) {
  if (callable.is_none()) return {};
  return [held = hold(callable)](const StudyProgress& p) {
    using namespace pybind11::literals;
    const pybind11::gil_scoped_acquire gil;
    (*held)(pybind11::dict("done"_a = p.done, "total"_a = p.total, "doing"_a = p.doing, "wall_s"_a = p.wall_s));
  };
}

}  // namespace stillpoint::python
