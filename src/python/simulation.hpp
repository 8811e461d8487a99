// A simulation as Python has it: nobody touches it while another thread steps it, and what looks at it from within a
// step is told that it cannot.
#pragma once

#include <stillpoint/simulation.hpp>

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "python/held.hpp"
#include "python/interrupt.hpp"

namespace stillpoint::python {

/// What a constructor takes; callables may be None.
struct SimulationArguments {
  std::string out, resume;
  int threads = 0;
  pybind11::object stop, progress;
};

class SimulationObject {
 public:
  SimulationObject(const Scene& scene, const SimulationArguments& arguments);
  SimulationObject(const SimulationObject&) = delete;
  SimulationObject& operator=(const SimulationObject&) = delete;

  /// With the GIL, which is let go of. Throws what callables or Ctrl-C have raised.
  bool step(double t_stop);
  void run(double until);

  /// The simulation at rest between two steps, or in its stopping test. Throws std::runtime_error if it is not, or if
  /// that is another thread's.
  Simulation& at_rest();
  /// The same, done without the GIL.
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
  /// This thread is at work on it, and nobody else, while it lives.
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

  // Changed with the GIL alone:
  std::thread::id worker_{};   // the thread that is at work on it; none: it is at rest
  bool in_stop_test_ = false;  // of that thread
  Interrupt interrupt_;
  Held stop_, progress_;
  std::vector<std::string> columns_;
  std::vector<double> rows_;
  std::unique_ptr<Simulation> simulation_;  // last: what it calls is there until it is gone
};

}  // namespace stillpoint::python
