// The compiled half of the Python package stillpoint; the other half is in stillpoint/.
#include "python/bindings.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "What the package stillpoint is made of. Import that.";
  module.attr("__version__") = STILLPOINT_VERSION;
  stillpoint::python::bind_errors(module);
  stillpoint::python::bind_scene(module);
  stillpoint::python::bind_unknowns(module);
  stillpoint::python::bind_simulation(module);
  stillpoint::python::bind_strategies(module);
  stillpoint::python::bind_laws(module);
  stillpoint::python::bind_studies(module);
}
