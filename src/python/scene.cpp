// The Python interface of scenes: reading, checking, and attributes.
#include <stillpoint/scene.hpp>
#include <stillpoint/simulation.hpp>

#include <string>
#include <vector>

#include <pybind11/stl.h>

#include "plan/catalogue.hpp"
#include "python/bindings.hpp"
#include "scene/input/read_scene.hpp"

namespace stillpoint::python {

namespace py = pybind11;

void bind_scene(py::module_& module) {
  py::class_<Scene>(module, "Scene", "One problem as it was read, checked and completed; load() makes it.")
      .def_readonly("name", &Scene::name, "The file's stem.")
      .def_readonly("title", &Scene::title, "Of the scene; empty if it has none.")
      .def_readonly("dim", &Scene::dim, "1, 2 or 3.")
      .def_readonly("text", &Scene::text, "As TOML, without the overrides.")
      .def_readonly("overrides", &Scene::overrides, "What was laid over it, \"key=value\" each.")
      .def_property_readonly(
          "file", [](const Scene& scene) { return scene.file.string(); },
          "Where it was read from; of a dictionary, scene.toml in the folder where the files that it names are looked "
          "for.")
      .def("__repr__", [](const Scene& scene) { return "<stillpoint.Scene '" + scene.name + "'>"; })
      .def(py::pickle(
          [](const Scene& scene) { return py::make_tuple(scene.file.string(), scene.text, scene.overrides); },
          [](const py::tuple& kept) {
            return read_scene(kept[0].cast<std::string>(), kept[1].cast<std::string>(), "",
                              kept[2].cast<std::vector<std::string>>(), catalogue());
          }));

  using Overrides = std::vector<std::string>;
  const py::call_guard<py::gil_scoped_release> without_gil;
  module.def(
      "load_file", [](const std::string& file, const Overrides& overrides) { return load_scene(file, overrides); },
      without_gil);
  module.def(
      "load_text",
      [](const std::string& file, const std::string& text, const Overrides& overrides) {
        return read_scene(file, text, "", overrides, catalogue());
      },
      without_gil);
  module.def(
      "load_again",
      [](const Scene& scene, const Overrides& overrides) { return read_again(scene, overrides, catalogue()); },
      without_gil);
  module.def(
      "load_checkpoint", [](const std::string& checkpoint) { return load_scene_of(checkpoint); }, without_gil);
}

}  // namespace stillpoint::python
