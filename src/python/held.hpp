// Python objects that C++ keeps: they are released with the GIL held, whichever thread does it.
#pragma once

#include <memory>
#include <utility>

#include <pybind11/pybind11.h>

namespace stillpoint::python {

using Held = std::shared_ptr<const pybind11::object>;

inline Held hold(pybind11::object object) {
  return {new pybind11::object(std::move(object)), [](const pybind11::object* held) {
            const pybind11::gil_scoped_acquire gil;
            delete held;
          }};
}

/// Holds an object to the end of the process, when there may be no Python any more to release it.
inline Held hold_for_good(pybind11::object object) {
  return {new pybind11::object(std::move(object)), [](const pybind11::object*) {}};
}

}  // namespace stillpoint::python
