// Material laws with a history written in Python, asked for blocks of points at a time.
#include <stillpoint/own_history_law.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/held.hpp"
#include "space/materials/turned_increment.hpp"

namespace stillpoint::python {
namespace {

namespace py = pybind11;

/// What Python gives to add_history_law().
struct Functions {
  Held answer, elastic, moduli, parameters;  // moduli: None, if they are found by differences
};

Shape shape_of(std::size_t rows, std::size_t columns) {
  return {static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)};
}

/// The entries of what Python returned, which has to have this many rows and columns.
const double* matrix_of(const Array& array, std::size_t rows, std::size_t columns, const char* name) {
  const Shape expected = shape_of(rows, columns);
  if (array.ndim() != 2 || array.shape(0) != expected[0] || array.shape(1) != expected[1])
    throw std::invalid_argument(fmt::format("{}: expected an array of shape ({}, {})", name, rows, columns));
  return array.data();
}

/// The history of a point: the Cauchy stress, then the law's own numbers.
template <StressState S>
class PythonLaw final : public HistoryAnswers {
  static constexpr std::size_t components = gradient_components(S), stresses = stress_components(S);

 public:
  PythonLaw(Functions functions, const std::vector<std::string>& names)
      : HistoryAnswers({.names = names_after_stress(names)}),
        functions_(std::move(functions)),
        internals_(names.size()) {}

  void first_piola(const PointsWithHistory& at) const noexcept override {
    fill(at.P, at.points, at.stride);
    guarded([&] {
      Array stress(shape_of(at.points, stresses)), strain(shape_of(at.points, stresses)),
          internal(shape_of(at.points, internals_));
      std::vector<double> det_g(at.points);
      std::vector<Gradient<S>> H(at.points);
      for (std::size_t q = 0; q < at.points; ++q) {
        Gradient<S> dH;
        Stress<S> before;
        for (std::size_t c = 0; c < components; ++c) {
          H[q][c] = at.H[at.stride * c + q];
          dH[c] = at.dH[at.stride * c + q];
        }
        for (std::size_t a = 0; a < stresses; ++a) before[a] = at.committed[at.history_stride * a + q];
        const TurnedIncrement<double> by = turned_increment<S, double>(H[q], dH);
        det_g[q] = by.det_g;
        put(by, before, q, stress, strain);
        for (std::size_t k = 0; k < internals_; ++k)
          internal.mutable_data()[internals_ * q + k] = at.committed[at.history_stride * (stresses + k) + q];
      }
      const auto [after, next] = ask(stress, strain, internal, at.dt);
      const double* const sigma = matrix_of(after, at.points, stresses, "the stress that a law returns");
      const double* const own = matrix_of(next, at.points, internals_, "the history that a law returns");
      for (std::size_t q = 0; q < at.points; ++q) {
        Stress<S> of_point;
        std::copy_n(sigma + stresses * q, stresses, of_point.begin());
        const auto P = nominal_stress<S, double>(H[q], det_g[q], of_point);
        for (std::size_t c = 0; c < components; ++c) at.P[at.stride * c + q] = P[c];
        for (std::size_t a = 0; a < stresses; ++a) at.next[at.history_stride * a + q] = of_point[a];
        for (std::size_t k = 0; k < internals_; ++k)
          at.next[at.history_stride * (stresses + k) + q] = own[internals_ * q + k];
      }
    });
  }

  void moduli(const double* H, const double* dH, double dt, const double* committed,
              double* A) const noexcept override {
    fill(A, components * components, 1);
    guarded([&] {
      const auto by = turned_increment<S, Dual<components>>(variables(gradient(H)), variables(gradient(dH)));
      Stress<S> before;
      std::copy_n(committed, stresses, before.begin());
      // The point itself and, for moduli by differences, two beside it for each component of the strain.
      const bool by_differences = functions_.moduli->is_none();
      const std::size_t points = by_differences ? 1 + 2 * stresses : 1;
      constexpr double difference = 1e-7;  // of strain: an error of its square, and of rounding over it
      Array stress(shape_of(points, stresses)), strain(shape_of(points, stresses)),
          internal(shape_of(points, internals_));
      for (std::size_t q = 0; q < points; ++q) {
        put(values_of(by), before, q, stress, strain);
        std::copy_n(committed + stresses, internals_, internal.mutable_data() + internals_ * q);
        if (q > 0) strain.mutable_data()[stresses * q + (q - 1) / 2] += q % 2 == 1 ? difference : -difference;
      }
      const auto [after, next] = ask(stress, strain, internal, dt);
      const double* const sigma = matrix_of(after, points, stresses, "the stress that a law returns");
      StrainModuli<S> C;
      if (by_differences) {
        for (std::size_t a = 0; a < stresses; ++a) {
          for (std::size_t b = 0; b < stresses; ++b)
            C[a][b] = (sigma[stresses * (1 + 2 * b) + a] - sigma[stresses * (2 + 2 * b) + a]) / (2 * difference);
        }
      } else {
        const auto found =
            (*functions_.moduli)(stress, strain, internal, dt, *functions_.parameters).template cast<Array>();
        if (found.size() != static_cast<py::ssize_t>(stresses * stresses))
          throw std::invalid_argument(fmt::format("moduli: expected an array of shape (1, {0}, {0})", stresses));
        for (std::size_t a = 0; a < stresses; ++a) std::copy_n(found.data() + stresses * a, stresses, C[a].begin());
      }
      Stress<S> of_point;
      std::copy_n(sigma, stresses, of_point.begin());
      std::ranges::copy(moduli_of_increment<S>(gradient(H), by, of_point, C), A);
    });
  }

  void elastic_moduli(const double* H, const double* committed, double* A) const noexcept override {
    fill(A, components * components, 1);
    guarded([&] {
      Stress<S> sigma;
      std::copy_n(committed, stresses, sigma.begin());
      const auto [K, G] = (*functions_.elastic)(copy_of({committed, stresses}, shape_of(1, stresses)),
                                                copy_of({committed + stresses, internals_}, shape_of(1, internals_)),
                                                *functions_.parameters)
                              .template cast<std::pair<Array, Array>>();
      if (K.size() != 1 || G.size() != 1)
        throw std::invalid_argument("elastic: expected a bulk and a shear modulus of each point");
      std::ranges::copy(ElasticRate<S>(gradient(H), sigma, *K.data(), *G.data()).moduli(), A);
    });
  }
  void cauchy(const double* committed, double* sigma) const noexcept override {
    std::copy_n(committed, stresses, sigma);
  }
  void initial_history(const double* sigma, double* first) const noexcept override {
    std::fill_n(first, history(), 0.0);
    std::copy_n(sigma, stresses, first);
  }
  void try_out(const double* committed) const override {
    Moduli<S> A;
    elastic_moduli(Gradient<S>{}.data(), committed, A.data());
    throw_what_failed();
  }
  void throw_what_failed() const override {
    const std::scoped_lock lock(mutex_);
    if (const auto raised = std::exchange(raised_, nullptr)) std::rethrow_exception(raised);
  }

 private:
  static std::vector<std::string> names_after_stress(const std::vector<std::string>& names) {
    std::vector<std::string> all(stresses);
    all.insert(all.end(), names.begin(), names.end());
    return all;
  }
  static Gradient<S> gradient(const double* H) {
    Gradient<S> of_point;
    std::copy_n(H, components, of_point.begin());
    return of_point;
  }
  static void fill(double* values, std::size_t count, std::size_t stride) {
    const std::size_t rows = stride > 1 ? components : 1;
    for (std::size_t row = 0; row < rows; ++row)
      std::fill_n(values + stride * row, count, std::numeric_limits<double>::quiet_NaN());
  }
  static void put(const TurnedIncrement<double>& by, const Stress<S>& before, std::size_t q, Array& stress,
                  Array& strain) {
    std::ranges::copy(turned_stress<S>(by.rotation, before), stress.mutable_data() + stresses * q);
    std::ranges::copy(strain_vector<S>(by.strain), strain.mutable_data() + stresses * q);
  }
  std::pair<Array, Array> ask(const Array& stress, const Array& strain, const Array& internal, double dt) const {
    return (*functions_.answer)(stress, strain, internal, dt, *functions_.parameters)
        .template cast<std::pair<Array, Array>>();
  }
  // What Python raises is kept for throw_what_failed(): loops over blocks run in several threads.
  template <class Body>
  void guarded(const Body& body) const noexcept {
    const py::gil_scoped_acquire gil;
    try {
      body();
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!raised_) raised_ = std::current_exception();
    }
  }

  Functions functions_;
  std::size_t internals_;
  mutable std::mutex mutex_;
  mutable std::exception_ptr raised_;
};

template <StressState S>
MakeHistoryLaw maker(const Functions& functions, const std::vector<std::string>& names) {
  return [functions, names](const LawParameters& parameters) -> std::unique_ptr<HistoryAnswers> {
    const py::gil_scoped_acquire gil;
    Functions of_law = functions;
    of_law.parameters = hold(py::cast(parameters));
    return std::make_unique<PythonLaw<S>>(std::move(of_law), names);
  };
}

}  // namespace

void bind_laws(py::module_& module) {
  module.def(
      "add_history_law",
      [](const std::string& name, py::object answer, py::object elastic, py::object moduli,
         const std::map<std::string, std::optional<double>>& parameters, const std::vector<std::string>& history,
         const std::string& equation, const std::string& source) {
        OwnLaw about{.name = name, .equation = equation, .source = source};
        for (const auto& [key, fallback] : parameters)
          about.parameters.push_back(
              {.name = key, .lower = -std::numeric_limits<double>::infinity(), .fallback = fallback});
        const Functions functions{hold_for_good(std::move(answer)), hold_for_good(std::move(elastic)),
                                  hold_for_good(std::move(moduli)), nullptr};
        add_history_law(about, history,
                        {{StressState::plane_strain, maker<StressState::plane_strain>(functions, history)},
                         {StressState::axisymmetric, maker<StressState::axisymmetric>(functions, history)},
                         {StressState::space, maker<StressState::space>(functions, history)}});
      },
      py::arg("name"), py::arg("answer"), py::arg("elastic"), py::arg("moduli"), py::kw_only(), py::arg("parameters"),
      py::arg("history"), py::arg("equation"), py::arg("source"));
}

}  // namespace stillpoint::python
