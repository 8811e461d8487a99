// The library's exceptions as Python's. Those without a counterpart in Python are classes of stillpoint/errors.py.
#include <stillpoint/scene_error.hpp>
#include <stillpoint/simulation.hpp>
#include <stillpoint/state_archive.hpp>

#include <exception>
#include <filesystem>

#include "python/bindings.hpp"

namespace stillpoint::python {
namespace {

namespace py = pybind11;

void raise(const py::object& error) { PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr()); }

py::object problems_of(const SceneError& error) {
  py::list problems;
  for (const Mistake& problem : error.problems()) {
    const Location& where = problem.where;
    problems.append(py::make_tuple(where.file, where.line, where.column, problem.message));
  }
  return problems;
}

// An attribute of stillpoint.errors, a module of this package that is imported by now.
py::object of_errors(const char* name) { return py::module_::import("stillpoint.errors").attr(name); }

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const SceneError& error) {
    raise(of_errors("SceneError").attr("_of")(problems_of(error)));
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
