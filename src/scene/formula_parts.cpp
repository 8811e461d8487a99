#include "scene/formula_parts.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stillpoint {
namespace {

// True for a character that ends an operand of a comparison if it stands outside all parentheses.
bool ends_operand(char letter) { return std::string_view("<>=!&|?:,").find(letter) != std::string_view::npos; }

std::size_t begin_of_operand(std::string_view formula, std::size_t end) {
  int depth = 0;
  std::size_t begin = end;
  for (; begin > 0; --begin) {
    const char letter = formula[begin - 1];
    if (letter == ')') ++depth;
    if (letter == '(' && depth-- == 0) break;
    if (depth == 0 && ends_operand(letter)) break;
  }
  return begin;
}

std::size_t end_of_operand(std::string_view formula, std::size_t begin) {
  int depth = 0;
  std::size_t end = begin;
  for (; end < formula.size(); ++end) {
    const char letter = formula[end];
    if (letter == '(') ++depth;
    if (letter == ')' && depth-- == 0) break;
    if (depth == 0 && ends_operand(letter)) break;
  }
  return end;
}

bool is_blank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == std::string_view::npos; }

}  // namespace

std::vector<FormulaComparison> comparisons_in(std::string_view formula) {
  std::vector<FormulaComparison> found;
  for (std::size_t k = 0; k < formula.size(); ++k) {
    const bool with_equals = k + 1 < formula.size() && formula[k + 1] == '=';
    const bool is_one =
        formula[k] == '<' || formula[k] == '>' || (with_equals && (formula[k] == '=' || formula[k] == '!'));
    if (!is_one) continue;
    const std::size_t after = k + (with_equals ? 2 : 1);
    const std::size_t begin = begin_of_operand(formula, k), end = end_of_operand(formula, after);
    const std::string_view left = formula.substr(begin, k - begin), right = formula.substr(after, end - after);
    if (!is_blank(left) && !is_blank(right)) found.push_back({begin, end, fmt::format("({})-({})", left, right)});
    k = after - 1;
  }
  return found;
}

std::vector<std::string> arguments_in(std::string_view formula) {
  std::vector<std::string> found;
  const auto add = [&](std::string part) {
    if (std::ranges::find(found, part) == found.end()) found.push_back(std::move(part));
  };
  for (std::size_t open = 0; open < formula.size(); ++open) {
    if (formula[open] != '(') continue;
    std::vector<std::string_view> arguments;
    std::size_t begin = open + 1;
    int depth = 0;
    for (std::size_t k = begin; k < formula.size(); ++k) {
      if (formula[k] == '(') ++depth;
      const bool closes = formula[k] == ')' && depth-- == 0;
      if (!closes && !(formula[k] == ',' && depth == 0)) continue;
      arguments.push_back(formula.substr(begin, k - begin));
      begin = k + 1;
      if (closes) break;
    }
    for (std::size_t a = 0; a < arguments.size(); ++a) {
      add(std::string(arguments[a]));
      if (a > 0) add(fmt::format("({})-({})", arguments[a - 1], arguments[a]));
    }
  }
  return found;
}

}  // namespace stillpoint
