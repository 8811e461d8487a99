// The parts of the module stillpoint._core, each in a file of its own.
#pragma once

#include <pybind11/pybind11.h>

namespace stillpoint::python {

void bind_errors(pybind11::module_& module);      // errors.cpp
void bind_scene(pybind11::module_& module);       // scene.cpp
void bind_simulation(pybind11::module_& module);  // simulation.cpp
void bind_unknowns(pybind11::module_& module);    // unknowns.cpp
void bind_strategies(pybind11::module_& module);  // strategies.cpp
void bind_laws(pybind11::module_& module);        // laws.cpp
void bind_studies(pybind11::module_& module);     // studies.cpp

}  // namespace stillpoint::python
