// A simulation as a Python object: other threads cannot use it while one thread steps it, and calls from within a step
// that need it at rest throw.
#pragma once

#include <stillpoint/simulation.hpp>

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "python/held.hpp"
#include "python/interrupt.hpp"

namespace stillpoint::python {

class SimulationObject {
 public:
  /// The callables may be None.
  SimulationObject(const Scene& scene, SimulationOptions options, const pybind11::object& stop,
                   const pybind11::object& progress);
  SimulationObject(const SimulationObject&) = delete;
  SimulationObject& operator=(const SimulationObject&) = delete;

  /// Called with the GIL, which is released meanwhile. Throws the exceptions that callables or Ctrl-C have raised.
  bool step(double t_stop);
  void run(double until);

  /// The simulation at rest between two steps, or in its stopping test. Throws std::runtime_error if it is not at rest,
  /// or if another thread's test is running.
  Simulation& at_rest();
  /// Calls the function with the simulation at rest, without the GIL.
  template <class Function>
  auto without_gil(const Function& function) {
    Simulation& simulation = at_rest();
    const Work work(*this);
    const pybind11::gil_scoped_release released;
    return function(simulation);
  }

  const std::vector<std::string>& columns() const { return columns_; }
  const std::vector<double>& rows() const { return rows_; }  // (rows × columns)

 private:
  /// During its lifetime this thread alone works on the simulation.
  class Work {
   public:
    explicit Work(SimulationObject& object)
        : object_(object), worker_(object.worker_), in_stop_test_(object.in_stop_test_) {
      object.worker_ = std::this_thread::get_id();
      object.in_stop_test_ = false;
    }
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    ~Work() {
      object_.worker_ = worker_;
      object_.in_stop_test_ = in_stop_test_;
    }

   private:
    SimulationObject& object_;
    std::thread::id worker_;
    bool in_stop_test_;
  };

  Simulation& idle();
  std::string ask_stop_test();

  // Changed only with the GIL held:
  std::thread::id worker_{};   // the thread that works on it; none if it is at rest
  bool in_stop_test_ = false;  // of the working thread
  Interrupt interrupt_;
  Held stop_;
  std::vector<std::string> columns_;
  std::vector<double> rows_;
  std::unique_ptr<Simulation> simulation_;  // last, so that everything it calls outlives it
};

}  // namespace stillpoint::python
