// One TOML value read as what the schema wants; what is wrong with it becomes a problem, not an exception.
#pragma once

#include <stillpoint/expression.hpp>
#include <stillpoint/scene.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace stillpoint {

/// What reading a scene shares: the constants that formulas may use, and the problems found so far.
struct Reading {
  Constants constants;
  std::set<std::string> broken;  // constants that could not be computed; what uses them is not reported again
  std::vector<Problem> problems;

  /// Records that the value of the dotted key path is wrong.
  void problem(const Location& where, const std::string& path, const std::string& message);
};

/// Where a number may lie.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_allowed = false, upper_allowed = false;

  bool contains(double value) const;
  /// "greater than 0 and at most 1"
  std::string text() const;
};
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{0, kInfinity, false, false};
inline constexpr Range kNotNegative{0, kInfinity, true, false};

/// "a number", "a string", "an array" …
std::string kind_of(const toml::node& node);

/// The names in a formula: constants, variables, functions.
std::vector<std::string> names_in(std::string_view formula);

/// A finite number in range: an integer, a float, or a string with a formula of the constants.
std::optional<double> read_number(const toml::node& node, const std::string& path, const Range& range,
                                  Reading& reading);

/// A whole number of lower … upper, written like any number.
std::optional<std::int64_t> read_integer(const toml::node& node, const std::string& path, std::int64_t lower,
                                         std::int64_t upper, Reading& reading);

/// A number or a formula of the constants and of variables ("t", "xt", …).
std::optional<Expression> read_formula(const toml::node& node, const std::string& path, const std::string& variables,
                                       Reading& reading);

/// A string.
std::optional<std::string> read_text(const toml::node& node, const std::string& path, Reading& reading);

}  // namespace stillpoint
