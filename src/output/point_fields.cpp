#include "output/point_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "output/field_frame.hpp"
#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

// The suffixes of a field's components; empty for a single component.
std::vector<std::string> suffixes(const LagrangianPhase& phase, const std::string& name) {
  const PhaseInfo& info = phase.info();
  std::vector<std::string> components;
  if (name == "u" || name == "v") components = axis_names(info.dim);
  if (name == "stress" || name == "effective_stress") components = stress_names(info.stress_components);
  if (name == "strain") components = gradient_names(info.dim, info.gradient_components);
  if (components.size() < 2) return {""};
  return components;
}

bool has_of_law(const LagrangianPhase& phase, const std::string& name) {
  const std::vector<std::string>& of_laws = phase.info().law_fields;
  return std::ranges::find(of_laws, name) != of_laws.end();
}

}  // namespace

std::vector<double> point_field(const LagrangianPhase& phase, const std::string& name, double t, ConstVec u,
                                ConstVec v) {
  std::vector<double> values(suffixes(phase, name).size() * phase.points());
  if (name == "u") {
    phase.fields().point_displacement(t, u, values);
  } else if (name == "v") {
    phase.fields().point_velocity(t, v, values);
  } else if (name == "strain") {
    phase.fields().point_strain(t, u, values);
  } else if (name == "stress") {
    phase.fields().point_stress(t, u, values);
  } else if (name == "effective_stress") {
    phase.fields().point_stress(t, u, values);
    if (!has_of_law(phase, "pore_pressure")) return values;
    std::vector<double> pressure(phase.points());
    phase.fields().point_field(PointQuantity::pore_pressure, t, u, pressure);
    const std::size_t components = values.size() / pressure.size();
    for (std::size_t p = 0; p < pressure.size(); ++p)
      make_effective(Vec(values).subspan(components * p, components), pressure[p]);
  } else if (name == "pore_pressure" && has_of_law(phase, name)) {
    phase.fields().point_field(PointQuantity::pore_pressure, t, u, values);
  } else if (name == "volume") {
    phase.fields().point_field(PointQuantity::volume, t, u, values);
  } else {
    if (!is_field(phase, name)) throw std::invalid_argument("there is no field " + name);
    phase.fields().point_history(name, values);
  }
  return values;
}

void make_effective(Vec stress, double pore_pressure) {
  for (double& normal : stress.first(3)) normal += pore_pressure;
}

std::vector<double> strain_tensors(const LagrangianPhase& phase, double t, ConstVec u) {
  const PhaseInfo& info = phase.info();
  const auto dim = static_cast<std::size_t>(info.dim), of_gradient = static_cast<std::size_t>(info.gradient_components),
             components = static_cast<std::size_t>(info.stress_components);
  std::vector<double> gradient(of_gradient * phase.points());
  phase.fields().point_strain(t, u, gradient);
  std::vector<double> strain(components * phase.points(), 0.0);
  for (std::size_t k = 0; k < strain.size(); ++k) {
    const auto [i, j] = tensor_places[k % components];
    const double* const H = &gradient[k / components * of_gradient];
    if (i < dim && j < dim) strain[k] = (H[dim * i + j] + H[dim * j + i]) / 2;
    if (i >= dim && of_gradient > dim * dim) strain[k] = H[dim * dim];
  }
  return strain;
}

LargestStrain largest_strain(const LagrangianPhase& phase, double t, ConstVec u) {
  const auto components = static_cast<std::size_t>(phase.info().gradient_components);
  std::vector<double> gradient(components * phase.points());
  phase.fields().point_strain(t, u, gradient);
  LargestStrain most;
  for (std::size_t k = 0; k < gradient.size(); ++k)
    if (std::abs(gradient[k]) > most.strain) most = {std::abs(gradient[k]), k / components};
  return most;
}

bool is_field(const LagrangianPhase& phase, const std::string& name) {
  constexpr std::array always = {"u", "v", "strain", "stress", "volume"};
  const bool is_effective = name == "effective_stress" && phase.info().stress_components > 1;
  return std::ranges::find(always, name) != always.end() || is_effective || has_of_law(phase, name);
}

std::vector<double> current_positions(const LagrangianPhase& phase, double t, ConstVec u) {
  std::vector<double> position = phase.fields().point_data().initial_positions;
  std::vector<double> displacement(position.size());
  phase.fields().point_displacement(t, u, displacement);
  for (std::size_t i = 0; i < position.size(); ++i) position[i] += displacement[i];
  return position;
}

std::vector<double> change_of(const LagrangianPhase& phase, PointQuantity quantity, double t, ConstVec x) {
  const PhaseInfo& info = phase.info();
  const bool is_vector = quantity == PointQuantity::displacement || quantity == PointQuantity::velocity;
  const int components = is_vector                           ? info.dim
                         : quantity == PointQuantity::strain ? info.gradient_components
                         : quantity == PointQuantity::stress ? info.stress_components
                                                             : 1;
  const std::vector<double> nothing(x.size(), 0.0);
  std::vector<double> values(static_cast<std::size_t>(components) * phase.points()), rest(values.size());
  phase.fields().point_field(quantity, t, x, values);
  phase.fields().point_field(quantity, t, nothing, rest);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= rest[i];
  return values;
}

std::vector<double> lengths_of(ConstVec vectors, std::size_t dim) {
  std::vector<double> lengths(vectors.size() / dim);
  for (std::size_t p = 0; p < lengths.size(); ++p) {
    double square = 0;
    for (const double x : vectors.subspan(dim * p, dim)) square += x * x;
    lengths[p] = std::sqrt(square);
  }
  return lengths;
}

PointFieldComponent find_point_field(const LagrangianPhase& phase, const std::string& field) {
  const std::size_t dot = field.find('.');
  const std::string name = field.substr(0, dot), suffix = dot == std::string::npos ? "" : field.substr(dot + 1);
  const std::vector<std::string> components = suffixes(phase, name);
  const auto found = std::ranges::find(components, suffix);
  if (found == components.end()) throw std::invalid_argument("there is no field " + field);
  return {name, static_cast<std::size_t>(found - components.begin()), components.size()};
}

}  // namespace stillpoint
