// The functions that every formula may call.
#pragma once

#include <string>
#include <vector>

namespace stillpoint {

/// "sin", "sqrt", "max" …: names that no constant can take.
const std::vector<std::string>& expression_functions();

}  // namespace stillpoint
