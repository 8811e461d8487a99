// report.html: the report of a run or a study in one file that a browser shows without a network.
#pragma once

#include <string>

#include "base/json.hpp"

namespace stillpoint {

constexpr const char* report_name = "report.html";

/// The text of report.html: page.html of this folder around the data, which page.js and its neighbours show by
/// data.kind: "run", "compare", "converge" or "safety".
std::string report_page(const std::string& title, const Json& data);

}  // namespace stillpoint
