// The parts of a formula's text: its names, and those at which its value may jump or bend, which are its comparisons
// and the arguments of its functions.
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

/// "a < b" within a formula.
struct FormulaComparison {
  std::size_t begin, end;  // the characters of its text, the end not included
  std::string difference;  // "(a)-(b)", which has another sign where the comparison has another value
};
/// All comparisons in a formula, also those inside the operands of others.
std::vector<FormulaComparison> comparisons_in(std::string_view formula);

/// The argument in each pair of parentheses; if there are several arguments, also the differences of neighbours. A
/// function that bends or jumps does so at a zero of one of these: |x| at a zero of x, max(a, b) at a zero of a − b.
std::vector<std::string> arguments_in(std::string_view formula);

}  // namespace stillpoint
