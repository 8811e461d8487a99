// Dampings, loads and relaxations written in Python.
#include <stillpoint/own_damping.hpp>
#include <stillpoint/own_load.hpp>
#include <stillpoint/own_relaxation.hpp>

#include <array>
#include <optional>
#include <utility>

#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/held.hpp"

namespace stillpoint::python {
namespace {

namespace py = pybind11;

// An array that C++ fills repeatedly, and that Python only reads.
class Shown {
 public:
  const Array& array() const { return array_; }
  void fill(ConstVec values) {
    const auto n = static_cast<py::ssize_t>(values.size());
    if (array_.size() != n) {
      array_ = Array(n);
      make_read_only(array_);
    }
    std::ranges::copy(values, const_cast<double*>(array_.data()));  // the memory belongs to C++
  }

 private:
  Array array_;
};

}  // namespace

/// MotionNow as Python sees it: copies that are made on access, so that references kept by the program do not dangle.
class MotionObject {
 public:
  /// The motion that is shown during a call.
  class Showing {
   public:
    Showing(MotionObject& object, const MotionNow& now) : object_(object) {
      object.now_ = &now;
      object.is_filled_ = {};
    }
    Showing(const Showing&) = delete;
    Showing& operator=(const Showing&) = delete;
    ~Showing() { object_.now_ = nullptr; }

   private:
    MotionObject& object_;
  };

  const MotionNow& now() const {
    if (!now_) throw std::runtime_error("a motion shows its state during the call that it is given to");
    return *now_;
  }
  template <int which>
  Array array(ConstVec MotionNow::*values) {
    const ConstVec shown = now().*values;
    if (!std::exchange(is_filled_[which], true)) shown_[which].fill(shown);
    return shown_[which].array();
  }

 private:
  const MotionNow* now_ = nullptr;
  std::array<Shown, 4> shown_;
  std::array<bool, 4> is_filled_{};
};

namespace {

// The method of this name, or None.
py::object method_of(const py::object& object, const char* name) { return py::getattr(object, name, py::none()); }

class PythonRelaxation final : public OwnRelaxation {
 public:
  explicit PythonRelaxation(const py::object& own)
      : own_(hold(own)), restart_(hold(method_of(own, "restart"))), moved_(hold(method_of(own, "moved"))) {
    const py::object propose = method_of(own, "propose");
    propose_ = hold(propose.is_none() && PyCallable_Check(own.ptr()) ? own : propose);
    if (propose_->is_none()) throw py::type_error("a relaxation needs a method propose(h, motion, u_new, v_new)");
    motion_ = hold(py::cast(MotionObject()));
  }

  PythonRelaxation(const PythonRelaxation&) = delete;
  PythonRelaxation& operator=(const PythonRelaxation&) = delete;
  ~PythonRelaxation() override {
    const py::gil_scoped_acquire gil;
    trial_.reset();
  }

  void restart(const MotionNow& now) override {
    const py::gil_scoped_acquire gil;
    if (restart_->is_none()) return;
    const MotionObject::Showing showing(motion(), now);
    (*restart_)(*motion_);
  }

  void propose(double h, const MotionNow& now, Vec u_new, Vec v_new) override {
    const py::gil_scoped_acquire gil;
    const auto n = static_cast<py::ssize_t>(u_new.size());
    if (!trial_ || trial_->first.size() != n) trial_.emplace(Array(n), Array(n));
    const MotionObject::Showing showing(motion(), now);
    const py::object returned = (*propose_)(h, *motion_, trial_->first, trial_->second);
    if (!returned.is_none()) {
      const auto [u, v] = returned.cast<std::pair<Array, Array>>();
      std::ranges::copy(vector_of(u, u_new.size(), "u_new"), u_new.begin());
      std::ranges::copy(vector_of(v, v_new.size(), "v_new"), v_new.begin());
      return;
    }
    std::copy_n(trial_->first.data(), u_new.size(), u_new.begin());
    std::copy_n(trial_->second.data(), v_new.size(), v_new.begin());
  }

  void moved(double h, const MotionNow& now) override {
    if (!has_moved_) return;
    const py::gil_scoped_acquire gil;
    const MotionObject::Showing showing(motion(), now);
    (*moved_)(h, *motion_);
  }

  void archive(const StateArchive& state) override {
    const py::gil_scoped_acquire gil;
    const py::module_ memory = py::module_::import("stillpoint.memory");
    std::string text = state.restores() ? "" : memory.attr("to_text")(*own_).cast<std::string>();
    state("memory", text);
    if (state.restores()) memory.attr("from_text")(*own_, text);
  }

 private:
  MotionObject& motion() { return motion_->cast<MotionObject&>(); }

  Held own_, restart_, moved_, propose_, motion_;
  bool has_moved_ = !moved_->is_none();
  std::optional<std::pair<Array, Array>> trial_;
};

}  // namespace

void bind_strategies(py::module_& module) {
  py::class_<MotionObject>(module, "Motion",
                           "The state that a relaxation steps from, during the call that it is given to. The arrays "
                           "are read-only copies that the next call fills again: copy what is to be kept.")
      .def_property_readonly(
          "t", [](const MotionObject& self) { return self.now().t; }, "The pseudo-time [s].")
      .def_property_readonly(
          "last_step", [](const MotionObject& self) { return self.now().last_step; },
          "Of the step before [s]; 0: there is none since the phase began.")
      .def_property_readonly(
          "max_step", [](const MotionObject& self) { return self.now().max_step; },
          "The step given, a share of the critical one [s].")
      .def_property_readonly(
          "omega_1", [](const MotionObject& self) { return self.now().omega_1; }, "[rad/s]; 0 unless needs_omega_1.")
      .def_property_readonly(
          "u", [](MotionObject& self) { return self.array<0>(&MotionNow::u); },
          "Displacement since the phase began, (n) [m].")
      .def_property_readonly(
          "v", [](MotionObject& self) { return self.array<1>(&MotionNow::v); }, "Velocity, (n) [m/s].")
      .def_property_readonly(
          "Q", [](MotionObject& self) { return self.array<2>(&MotionNow::Q); },
          "Out-of-balance force F - R(u), (n) [N].")
      .def_property_readonly(
          "a", [](MotionObject& self) { return self.array<3>(&MotionNow::a); }, "The a of M a = Q, (n) [m/s²].")
      .def(
          "mass_product",
          [](const MotionObject& self, const Array& x) {
            const MotionNow& now = self.now();
            Array result(x.size());
            now.mass->apply(vector_of(x, now.u.size(), "x"), {result.mutable_data(), now.u.size()});
            return result;
          },
          "M x; x: (n).");

  module.def(
      "add_damping",
      [](const std::string& name, py::object force, double stiffness_factor, const std::string& equation,
         const std::string& source) {
        add_damping({.name = name, .equation = equation, .source = source, .stiffness_factor = stiffness_factor},
                    [held = hold_for_good(std::move(force))](double alpha, ConstVec v, ConstVec Q, Vec D) {
                      const py::gil_scoped_acquire gil;
                      const Shape shape = {static_cast<py::ssize_t>(v.size())};
                      const Array found = (*held)(copy_of(v, shape), copy_of(Q, shape), alpha).cast<Array>();
                      std::ranges::copy(vector_of(found, D.size(), "D"), D.begin());
                    });
      },
      py::arg("name"), py::arg("force"), py::kw_only(), py::arg("stiffness_factor") = 1.0, py::arg("equation") = "",
      py::arg("source") = "");
  module.def(
      "add_load",
      [](const std::string& name, py::object force, double settles_at) {
        add_load({.name = name, .settles_at = settles_at},
                 [held = hold_for_good(std::move(force))](double t, int dim, ConstVec x, Vec b) {
                   const py::gil_scoped_acquire gil;
                   const Shape shape = {static_cast<py::ssize_t>(x.size()) / dim, dim};
                   const Array found = (*held)(t, copy_of(x, shape)).cast<Array>();
                   if (found.ndim() != 2 || found.shape(0) != shape[0] || found.shape(1) != shape[1])
                     throw std::invalid_argument(
                         fmt::format("the load: expected an array of shape ({}, {})", shape[0], shape[1]));
                   std::copy_n(found.data(), b.size(), b.begin());
                 });
      },
      py::arg("name"), py::arg("force"), py::kw_only(), py::arg("settles_at") = 0.0);
  module.def(
      "add_relaxation",
      [](const std::string& name, py::object make, const std::string& equation, const std::string& source,
         bool needs_omega_1) {
        add_relaxation({.name = name, .equation = equation, .source = source, .needs_omega_1 = needs_omega_1},
                       [held = hold_for_good(std::move(make))]() -> std::unique_ptr<OwnRelaxation> {
                         const py::gil_scoped_acquire gil;
                         return std::make_unique<PythonRelaxation>((*held)());
                       });
      },
      py::arg("name"), py::arg("make"), py::kw_only(), py::arg("equation") = "", py::arg("source") = "",
      py::arg("needs_omega_1") = false);
}

}  // namespace stillpoint::python
