#include "space/points/value_by_place.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/throw_scene_error.hpp"
#include "space/materials/material_laws.hpp"

namespace stillpoint {

double value_by_place(const MaterialSpec& material, const std::string& name, std::span<const double> position) {
  const auto formula = material.by_place.find(name);
  if (formula == material.by_place.end()) return material.parameters.at(name);
  const double value = formula->second(position, 0);
  const auto law = std::ranges::find(material_laws(), material.law, &LawInfo::name);
  const auto parameter = std::ranges::find(law->parameters, name, &ParameterInfo::name);
  const bool is_above = parameter->lower_allowed ? value >= parameter->lower : value > parameter->lower;
  if (!is_above || !std::isfinite(value))
    throw_scene_error(fmt::format("material.{}.{}", material.name, name),
                      fmt::format("must be {} {} everywhere, not {} at ({:.6g})", parameter->lower_allowed ? ">=" : ">",
                                  parameter->lower, value, fmt::join(position, ", ")));
  return value;
}

std::vector<double> values_by_place(const MaterialSpec& material, const std::string& name,
                                    const std::vector<std::vector<double>>& positions) {
  std::vector<double> values;
  for (const auto& x : positions) values.push_back(value_by_place(material, name, x));
  return values;
}

InitialGround initial_ground(const MaterialSpec& material, const std::vector<std::vector<double>>& positions) {
  InitialGround ground;
  for (const auto& [name, formula] : material.by_place) {
    if (name == "OCR" || name == "pc") ground.consolidation = values_by_place(material, name, positions);
    if (name == "e0") ground.void_ratio = values_by_place(material, name, positions);
  }
  return ground;
}

}  // namespace stillpoint
