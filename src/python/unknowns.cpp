#include "python/unknowns.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "python/bindings.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint::python {
namespace {

namespace py = pybind11;

// Fields that are the same in all phases, from the data of the points.
const std::map<std::string, std::vector<double> PointData::*> constant_fields = {
    {"initial_position", &PointData::initial_positions}, {"mass", &PointData::masses}};
// Names of fields in Python, and those in Simulation::field().
const std::map<std::string, std::string> computed_fields = {{"position", "position"}, {"displacement", "u"},
                                                            {"velocity", "v"},        {"strain", "strain"},
                                                            {"stress", "stress"},     {"volume", "volume"}};

// An array (P × components), or (P) if there is a single component.
Array array_of_points(ConstVec values, std::size_t points) {
  const std::size_t components = values.size() / points;
  Shape shape = {static_cast<py::ssize_t>(points)};
  if (components > 1) shape.push_back(static_cast<py::ssize_t>(components));
  Array array = copy_of(values, shape);
  make_read_only(array);
  return array;
}

}  // namespace

Array Unknowns::u() {
  const std::shared_ptr<const Vector> y = simulation().at_rest().state();
  return view_of(first_half(y->span()), y);
}

Array Unknowns::v() {
  Simulation& now = simulation().at_rest();
  const std::shared_ptr<const Vector> y = now.state();
  if (!now.system().keeps_momentum()) return view_of(second_half(y->span()), y);
  const ConstVec v = now.v();
  Array array = copy_of(v, {static_cast<py::ssize_t>(v.size())});
  make_read_only(array);
  return array;
}

TrialState& Unknowns::trial(Simulation& now) {
  if (!trial_ || phase_ != now.phases()) trial_ = now.parts().phase.make_trial();
  phase_ = now.phases();
  return *trial_;
}

// Calls function(phase, t, u).
template <class Function>
void Unknowns::at(const py::object& u, const py::object& t, const Function& function) {
  Simulation& now = simulation().at_rest();
  const double time = t.is_none() ? now.t() : t.cast<double>();
  const Array given = u.is_none() ? Array(this->u()) : u.cast<Array>();
  const ConstVec values = vector_of(given, now.system().size(), "u");
  simulation().without_gil([&](Simulation& still) { function(still.parts().phase, time, values); });
}

// Calls function(phase, t, u, out), out: (n), and returns out as an array.
template <class Function>
Array Unknowns::evaluate(const py::object& u, const py::object& t, const Function& function) {
  Array result(static_cast<py::ssize_t>(size()));
  const Vec out(result.mutable_data(), size());
  at(u, t, [&](const LagrangianPhase& phase, double time, ConstVec values) { function(phase, time, values, out); });
  return result;
}

Array Unknowns::external_force(const py::object& u, const py::object& t) {
  return evaluate(u, t, [](const LagrangianPhase& phase, double at, ConstVec values, Vec F) {
    phase.external_force(at, values, F);
  });
}

Array Unknowns::internal_force(const py::object& u, const py::object& t) {
  TrialState& found = trial(simulation().at_rest());
  return evaluate(u, t, [&](const LagrangianPhase& phase, double at, ConstVec values, Vec R) {
    if (!phase.internal_force(at, values, R, found)) throw std::invalid_argument(phase.diagnosis().refusal(found));
  });
}

Array Unknowns::residual(const py::object& u, const py::object& t) {
  if (simulation().at_rest().parts().phase.contact())
    throw std::invalid_argument("walls touch the body: what they press with is no function of u alone");
  Array Q = external_force(u, t);
  const Array R = internal_force(u, t);
  std::transform(Q.data(), Q.data() + Q.size(), R.data(), Q.mutable_data(), std::minus<>());
  return Q;
}

SparseMatrix Unknowns::tangent(const py::object& u, const py::object& t, bool elastic) {
  SparseMatrix K;
  at(u, t, [&](const LagrangianPhase& phase, double time, ConstVec values) {
    K = phase.tangents().matrix(elastic ? Tangent::elastic : Tangent::consistent, time, values);
  });
  return K;
}

Simulation& Unknowns::with_mass() {
  Simulation& now = simulation().at_rest();
  if (now.system().keeps_momentum()) throw std::invalid_argument("this mass is known by its inverse alone");
  return now;
}

SparseMatrix Unknowns::mass_matrix() { return with_mass().system().mass().matrix(); }

Array Unknowns::mass_product(const Array& x) {
  Simulation& now = with_mass();
  Array result(x.size());
  now.system().mass().apply(vector_of(x, size(), "x"), {result.mutable_data(), size()});
  return result;
}

Array Unknowns::mass_solve(const Array& b) {
  Array result(b.size());
  simulation().at_rest().system().mass().solve(vector_of(b, size(), "b"), {result.mutable_data(), size()});
  return result;
}

std::vector<std::string> Points::names() {
  std::vector<std::string> all = simulation().at_rest().parts().phase.info().law_fields;
  for (const auto& [name, field] : constant_fields) all.push_back(name);
  for (const auto& [name, field] : computed_fields) all.push_back(name);
  std::ranges::sort(all);
  return all;
}

Array Points::field(const std::string& name) {
  Simulation& now = simulation().at_rest();
  if (const auto constant = constant_fields.find(name); constant != constant_fields.end())
    return array_of_points(now.parts().phase.fields().point_data().*constant->second, now.points());
  const auto computed = computed_fields.find(name);
  const bool is_remembered = std::ranges::count(now.parts().phase.info().law_fields, name) > 0;
  if (computed == computed_fields.end() && !is_remembered)
    throw py::attribute_error(
        fmt::format("the points have no field '{}'; expected {}", name, fmt::join(names(), ", ")));
  return array_of_points(now.field(computed == computed_fields.end() ? name : computed->second), now.points());
}

void bind_unknowns(py::module_& module) {
  const py::arg_v u("u", py::none()), t("t", py::none());
  py::class_<Unknowns>(module, "Unknowns", "The n free degrees of freedom of the grid, in the present phase.")
      .def_property_readonly("size", &Unknowns::size, "n, their number.")
      .def("__len__", &Unknowns::size)
      .def_property_readonly(
          "u", &Unknowns::u,
          "Displacement since the phase began, (n) [m]: a read-only view of the state itself, which steps change. A "
          "new phase has unknowns of its own: the array of an old one stays as it was at the end of that.")
      .def_property_readonly("v", &Unknowns::v,
                             "Velocity, (n) [m/s]: likewise; with mass.kind = \"multigrid\" a copy of now.")
      .def("residual", &Unknowns::residual, u, t,
           "F - R(u), (n) [N], at time t [s]; None: of the present. Changes nothing in the simulation. ValueError if u "
           "cannot be evaluated, or if walls touch the body.")
      .def("internal_force", &Unknowns::internal_force, u, t, "R(u), likewise.")
      .def("external_force", &Unknowns::external_force, u, t, "F(t, u), likewise.")
      .def("tangent", &Unknowns::tangent, u, t, py::arg("elastic") = false,
           "K = dR/du, likewise, as scipy.sparse.csc_matrix (n × n) [N/m]; elastic: as if no point yielded, symmetric. "
           "Loads that follow u have a derivative of their own, which is no part of it.")
      .def("mass_matrix", &Unknowns::mass_matrix,
           "M as scipy.sparse.csc_matrix (n × n) [kg]. ValueError with mass.kind = \"multigrid\", of which the inverse "
           "alone is known.")
      .def("mass_product", &Unknowns::mass_product, py::arg("x"), "M x; x: (n).")
      .def("mass_solve", &Unknowns::mass_solve, py::arg("b"), "The x of M x = b; b: (n).");
  py::class_<Points>(module, "Points",
                     "The P material points, in the order in which the body was filled. Each field is an array of its "
                     "own, read as of the call: the points are stored in blocks, by cell, and what depends on u is "
                     "computed. (P), or (P × components); in one dimension (P).")
      .def("__len__", &Points::size)
      .def("__dir__", &Points::names)
      .def("__getattr__", &Points::field);
}

}  // namespace stillpoint::python
