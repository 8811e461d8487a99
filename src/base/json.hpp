// What the files in JSON have in common.
#pragma once

#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "base/versions.hpp"

namespace stillpoint {

using Json = nlohmann::ordered_json;

/// null for what JSON has no word for, inf and nan, and for what was not computed.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
inline Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

inline Json versions_of_libraries() {
  Json versions = Json::object();
  for (const auto& [name, version] : library_versions()) versions[name] = version;
  return versions;
}

}  // namespace stillpoint
