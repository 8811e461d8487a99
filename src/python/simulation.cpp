// The Python interface of simulations, step by step.
#include "python/simulation.hpp"

#include <limits>
#include <stdexcept>
#include <utility>

#include <pybind11/stl.h>

#include "python/bindings.hpp"
#include "python/progress.hpp"
#include "python/unknowns.hpp"

namespace stillpoint::python {
namespace {

namespace py = pybind11;

constexpr double open_end = std::numeric_limits<double>::infinity();

}  // namespace

SimulationObject::SimulationObject(const Scene& scene, SimulationOptions options, const py::object& stop,
                                   const py::object& progress)
    : stop_(stop.is_none() ? nullptr : hold(stop)) {
  options.interrupted = [this] { return simulation_ ? interrupt_.asked_of_what_takes_long() : interrupt_.asked(); };
  options.at_row = [this](const std::vector<std::string>& columns, const std::vector<double>& row) {
    if (columns_.empty()) columns_ = columns;
    rows_.insert(rows_.end(), row.begin(), row.end());
  };
  if (stop_) options.stop_test = [this] { return ask_stop_test(); };
  options.progress = progress_to(progress);
  try {
    const py::gil_scoped_release released;
    simulation_ = std::make_unique<Simulation>(scene, std::move(options));
  } catch (const SetUpStopped&) {
    interrupt_.throw_what_was_raised();
    throw;
  }
}

Simulation& SimulationObject::at_rest() {
  if (worker_ == std::thread::id() || (in_stop_test_ && worker_ == std::this_thread::get_id())) return *simulation_;
  if (worker_ == std::this_thread::get_id())
    throw std::runtime_error("the simulation is within a step: what it calls there has to do with what it is given");
  throw std::runtime_error("another thread is at work on the simulation");
}

Simulation& SimulationObject::idle() {
  Simulation& simulation = at_rest();
  if (in_stop_test_) throw std::runtime_error("a stopping test cannot take steps");
  return simulation;
}

bool SimulationObject::step(double t_stop) {
  Simulation& simulation = idle();
  {
    const Work work(*this);
    const py::gil_scoped_release released;
    interrupt_.begin();
    simulation.step(t_stop);
  }
  interrupt_.throw_what_was_raised();
  return !simulation.done();
}

void SimulationObject::run(double until) {
  Simulation& simulation = idle();
  {
    const Work work(*this);
    const py::gil_scoped_release released;
    while (!simulation.done() && simulation.t() < until) {
      interrupt_.begin();
      simulation.step(until);
      if (interrupt_.asked()) break;
    }
  }
  interrupt_.throw_what_was_raised();
}

// Asks the program's stopping test: a true answer ends the simulation, and a string gives the reason.
std::string SimulationObject::ask_stop_test() {
  const py::gil_scoped_acquire gil;
  in_stop_test_ = true;
  struct Leave {
    bool& in_stop_test;
    ~Leave() { in_stop_test = false; }
  } leave{in_stop_test_};
  const py::object answer = (*stop_)(py::cast(this));
  if (py::isinstance<py::str>(answer)) return answer.cast<std::string>();
  return py::bool_(answer) ? "by the program's own stopping test" : "";
}

void bind_simulation(py::module_& module) {
  py::class_<SimulationObject>(module, "Simulation", "What stillpoint.Simulation is made of.")
      .def(py::init([](const Scene& scene, const std::string& out, const std::string& resume, int threads,
                       const py::object& stop, const py::object& progress) {
             return std::make_unique<SimulationObject>(
                 scene, SimulationOptions{.out = out, .resume = resume, .threads = threads}, stop, progress);
           }),
           py::arg("scene"), py::kw_only(), py::arg("out") = "", py::arg("resume") = "", py::arg("threads") = 0,
           py::arg("stop") = py::none(), py::arg("progress") = py::none())
      .def("step", &SimulationObject::step, py::arg("until") = open_end,
           "One accepted step, not past time until [s], with the change of phase that it calls for; nothing once done. "
           "Returns whether the simulation goes on.")
      .def("run", &SimulationObject::run, py::arg("until") = open_end,
           "Steps until time until [s], or until it is done.")
      .def(
          "save",
          [](SimulationObject& self, const std::string& checkpoint) {
            self.without_gil([&](Simulation& simulation) { simulation.save(checkpoint); });
          },
          "Saves the state between two steps, to go on from with resume(). OSError if the file cannot be written.")
      .def(
          "summary_json",
          [](SimulationObject& self) {
            return self.without_gil([](Simulation& simulation) { return to_json(simulation.summary()); });
          },
          "The text of summary.json, as of now.")
      .def(
          "history_rows",
          [](SimulationObject& self) {
            self.at_rest();
            const auto columns = static_cast<py::ssize_t>(self.columns().size());
            const py::ssize_t rows = columns > 0 ? static_cast<py::ssize_t>(self.rows().size()) / columns : 0;
            return py::make_tuple(self.columns(), copy_of(self.rows(), {rows, columns}));
          },
          "The names of the columns of the history, and its rows so far, (rows × columns).")
      .def_property_readonly(
          "done", [](SimulationObject& self) { return self.at_rest().done(); },
          "Whether it has ended: at rest, at a limit, or as something went wrong.")
      .def_property_readonly(
          "status", [](SimulationObject& self) { return to_string(self.at_rest().status()); },
          "\"running\", \"equilibrium\", \"stop-test\", \"end-time\", …, as in summary.json.")
      .def_property_readonly(
          "reason", [](SimulationObject& self) { return self.at_rest().reason(); },
          "The inequality that ended it, or what went wrong.")
      .def_property_readonly(
          "t", [](SimulationObject& self) { return self.at_rest().t(); }, "The time reached [s].")
      .def_property_readonly(
          "steps", [](SimulationObject& self) { return self.at_rest().steps(); }, "Accepted steps so far.")
      .def_property_readonly(
          "evaluations", [](SimulationObject& self) { return self.at_rest().evaluations(); },
          "Evaluations of the internal force so far.")
      .def_property_readonly(
          "phases", [](SimulationObject& self) { return self.at_rest().phases(); }, "Phases that have begun.")
      .def_property_readonly(
          "residual",
          [](SimulationObject& self) {
            return self.without_gil([](Simulation& simulation) { return simulation.residual(); });
          },
          "The norm of F - R over that of F, at present.")
      .def_property_readonly(
          "distance",
          [](SimulationObject& self) {
            return self.without_gil([](Simulation& simulation) {
              simulation.residual();
              return simulation.distance();
            });
          },
          "The bound of the distance from equilibrium, relative; None if there is none.")
      .def_property_readonly(
          "points", [](const py::object& self) { return Points(self); }, "The material points.")
      .def_property_readonly(
          "unknowns", [](const py::object& self) { return Unknowns(self); },
          "The free degrees of freedom of the present phase.");
}

}  // namespace stillpoint::python
