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

}  // namespace stillpoint
