// The Python interface of scenes: reading, checking, and attributes.
#include <stillpoint/scene.hpp>
#include <stillpoint/simulation.hpp>

#include <string>
#include <vector>

#include <pybind11/stl.h>

#include "python/bindings.hpp"

namespace stillpoint::python {

namespace py = pybind11;

void bind_scene(py::module_& module) {
  py::class_<Scene>(module, "Scene", "One problem as it was read, checked and completed; load() makes it.")
      .def_readonly("name", &Scene::name, "The file's stem.")
      .def_readonly("title", &Scene::title)
      .def_readonly("dim", &Scene::dim, "1, 2 or 3.")
      .def_readonly("text", &Scene::text, "As TOML, without the overrides.")
      .def_readonly("overrides", &Scene::overrides, "What was laid over it, \"key=value\" each.")
      .def_property_readonly("file", [](const Scene& scene) { return scene.file.string(); })
      .def("__repr__", [](const Scene& scene) { return "<stillpoint.Scene '" + scene.name + "'>"; });

  module.def(
      "load_file",
      [](const std::string& file, const std::vector<std::string>& overrides) { return load_scene(file, overrides); },
      py::call_guard<py::gil_scoped_release>());
  module.def(
      "load_text",
      [](const std::string& file, const std::string& text, const std::vector<std::string>& overrides) {
        return load_scene(file, text, overrides);
      },
      py::call_guard<py::gil_scoped_release>());
  module.def(
      "load_checkpoint", [](const std::string& checkpoint) { return load_scene_of(checkpoint); },
      py::call_guard<py::gil_scoped_release>());
}

}  // namespace stillpoint::python
