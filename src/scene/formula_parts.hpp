// Where the text of a formula may switch: its comparisons, and what its functions are given.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

/// "a < b" within a formula.
struct Comparison {
  std::size_t begin, end;  // of its text
  std::string difference;  // "(a)-(b)", which has another sign where the comparison has another value
};
/// One inside another's operands counts as well.
std::vector<Comparison> comparisons_in(std::string_view formula);

/// What stands in each pair of parentheses, and of several arguments also the differences of those next to each other:
/// a function that bends or jumps does so where one of these vanishes, |x| where x does, max(a, b) where a − b does.
std::vector<std::string> arguments_in(std::string_view formula);

}  // namespace stillpoint
