// The words in the text of a formula: the functions and numbers that every formula has, and names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

/// "sin", "sqrt", "max" …: names that no constant can take.
const std::vector<std::string>& expression_functions();

/// "e" and "pi", which every formula has.
const std::vector<std::string>& expression_constants();

/// The names in a formula: constants, variables, functions.
std::vector<std::string> names_in(std::string_view formula);

}  // namespace stillpoint
