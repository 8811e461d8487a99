// What the text of a formula holds: the functions that every one may call, and names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

/// "sin", "sqrt", "max" …: names that no constant can take.
const std::vector<std::string>& expression_functions();

/// The names in a formula: constants, variables, functions.
std::vector<std::string> names_in(std::string_view formula);

}  // namespace stillpoint
