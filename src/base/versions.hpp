// Versions of the program and of the libraries that its results depend on.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace stillpoint {

std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace stillpoint
