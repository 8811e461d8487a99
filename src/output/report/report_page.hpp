// report.html: one file that a browser shows without a network, of a run or of a study.
#pragma once

#include <string>

#include "base/json.hpp"

namespace stillpoint {

constexpr const char* report_name = "report.html";

/// Its text: page.html of this room around the data, which page.js and its neighbours show by data.kind: "run",
/// "compare" or "converge".
std::string report_page(const std::string& title, const Json& data);

}  // namespace stillpoint
