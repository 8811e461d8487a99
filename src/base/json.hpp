// Helpers that all files in JSON share.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace stillpoint {

using Json = nlohmann::ordered_json;

/// A number, or null for inf and nan, which JSON lacks, and for a value that was not computed.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
inline Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }
inline Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

/// The text of a file that holds it.
inline std::string file_text(const Json& json) { return json.dump(1) + "\n"; }

/// The versions of the program and of the libraries that its results depend on, by name.
Json versions_of_libraries();

}  // namespace stillpoint
