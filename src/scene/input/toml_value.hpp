// One TOML value read as what its key takes; what is wrong with it becomes a problem, not an exception.
#pragma once

#include <stillpoint/expression.hpp>
#include <stillpoint/scene_error.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace stillpoint {

/// The state that all readers of a scene share: the constants that formulas may use, and the problems found so far.
struct Reading {
  int dim = 1;
  Constants constants{};
  std::set<std::string> broken{};  // constants that could not be computed; what uses them is not reported again
  std::set<std::string> wrong{};   // dotted keys whose values are wrong, or could not be computed
  std::vector<Mistake> problems{};

  /// Records that the value of the dotted key path is wrong, or a key in it.
  void problem(const Location& where, const std::string& path, const std::string& message, const std::string& key = {});
  /// Records what is wrong. Throws EnoughProblems after the last that is listed.
  void add(Mistake problem);
};

/// Thrown if more is wrong with a scene than anybody reads.
struct EnoughProblems {};

/// A TOML node, and the dotted key under which it stands ("support[0].at").
struct Value {
  const toml::node& node;
  std::string path;
  Reading& reading;

  void problem(const std::string& message) const;
};

/// The range of a number.
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
/// From 0 to 1, 1 itself not.
inline constexpr Range kShare{0, 1, true, false};
inline constexpr Range from(double lower, double upper) { return {lower, upper, true, true}; }

/// "a number", "a string", "an array" …
std::string kind_of(const toml::node& node);

/// A finite number in range: an integer, a float, or a string with a formula of the constants.
std::optional<double> read_number(const Value& value, const Range& range = kAnyNumber);

/// A whole number in range, written like any number.
std::optional<std::int64_t> read_whole(const Value& value, const Range& range);

/// A number or a formula of the constants and of variables ("t", "xt", …).
std::optional<Expression> read_formula(const Value& value, const std::string& variables);

/// true or false.
std::optional<bool> read_truth(const Value& value);

/// A string.
std::optional<std::string> read_text(const Value& value);

}  // namespace stillpoint
