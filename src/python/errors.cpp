// The library's exceptions as Python's. Those without a counterpart in Python are classes of stillpoint/errors.py.
#include <stillpoint/scene_error.hpp>
#include <stillpoint/simulation.hpp>
#include <stillpoint/state_archive.hpp>

#include <exception>
#include <filesystem>
#include <string>

#include "python/bindings.hpp"

namespace stillpoint::python {
namespace {

namespace py = pybind11;

void raise(const py::object& error) { PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr()); }

// An attribute of stillpoint.errors, a module of this package that is imported by now.
py::object of_errors(const char* name) { return py::module_::import("stillpoint.errors").attr(name); }

// A problem of a dictionary stands at its key, with which its message may begin as well.
py::object problem_of(const Mistake& mistake) {
  const auto& [where, message, key] = mistake;
  const py::object problem = of_errors("Problem");
  if (!where.file.empty()) return problem(where.file, where.line, where.column, message);
  const std::string begin = key + ": ";
  return problem(key.empty() ? "the scene" : key, 0, 0,
                 message.starts_with(begin) ? message.substr(begin.size()) : message);
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const SceneError& error) {
    py::list problems;
    for (const Mistake& mistake : error.problems()) problems.append(problem_of(mistake));
    raise(of_errors("SceneError")(py::tuple(problems)));
  } catch (const StateError& error) {
    raise(of_errors("StateError")(error.what()));
  } catch (const SetUpStopped& error) {
    raise(py::reinterpret_borrow<py::object>(
        error.status() == RunStatus::interrupted ? PyExc_KeyboardInterrupt : PyExc_TimeoutError)(error.what()));
  } catch (const std::filesystem::filesystem_error& error) {
    raise(py::reinterpret_borrow<py::object>(PyExc_OSError)(error.code().value(), error.code().message(),
                                                            error.path1().string()));
  }
}

}  // namespace

void bind_errors(py::module_&) { py::register_exception_translator(translate); }

}  // namespace stillpoint::python
