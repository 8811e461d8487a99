// The unknowns and the material points of a simulation, as arrays.
#pragma once

#include <stillpoint/sparse_matrix.hpp>

#include <string>
#include <vector>

#include "python/arrays.hpp"
#include "python/simulation.hpp"

namespace stillpoint::python {

/// The base of objects that belong to a simulation, and keep it alive.
class OfSimulation {
 public:
  explicit OfSimulation(pybind11::object simulation)
      : kept_(std::move(simulation)), simulation_(kept_.cast<SimulationObject&>()) {}

 protected:
  SimulationObject& simulation() { return simulation_; }

 private:
  pybind11::object kept_;
  SimulationObject& simulation_;
};

class Unknowns : public OfSimulation {
 public:
  using OfSimulation::OfSimulation;
  std::size_t size() { return simulation().at_rest().system().size(); }
  Array u();
  Array v();
  /// Q = F − R(u), R(u) and F(u) at t; None: the present u or t. (n) each.
  Array residual(const pybind11::object& u, const pybind11::object& t);
  Array internal_force(const pybind11::object& u, const pybind11::object& t);
  Array external_force(const pybind11::object& u, const pybind11::object& t);
  /// K = ∂R/∂u at t, (n × n); elastic: as if no point yielded, symmetric.
  SparseMatrix tangent(const pybind11::object& u, const pybind11::object& t, bool elastic);
  SparseMatrix mass_matrix();
  Array mass_product(const Array& x);
  Array mass_solve(const Array& b);

 private:
  template <class Function>
  void at(const pybind11::object& u, const pybind11::object& t, const Function& function);
  template <class Function>
  Array evaluate(const pybind11::object& u, const pybind11::object& t, const Function& function);
  Simulation& with_mass();
  TrialState& trial(Simulation& simulation);

  std::unique_ptr<TrialState> trial_;
  int phase_ = 0;  // phase of the trial
};

class Points : public OfSimulation {
 public:
  using OfSimulation::OfSimulation;
  std::size_t size() { return simulation().at_rest().points(); }
  std::vector<std::string> names();
  /// Throws py::attribute_error if there is no field of that name.
  Array field(const std::string& name);
};

}  // namespace stillpoint::python
