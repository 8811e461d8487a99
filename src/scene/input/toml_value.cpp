#include "scene/input/toml_value.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/formula_parts.hpp"
#include "scene/input/toml_source.hpp"

namespace stillpoint {
namespace {

/// The location in the file of character `position` of a string; empty if it cannot be told from the string alone.
std::optional<Location> location_in_string(const toml::value<std::string>& text, int position) {
  const toml::source_region& region = text.source();
  Location where = location_of(region);
  if (position < 0 || where.line == 0 || region.begin.line != region.end.line) return std::nullopt;
  // Two quotes around as many columns as the string has characters: no escapes, no triple quotes.
  const auto characters =
      std::count_if(text->begin(), text->end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  if (static_cast<long>(region.end.column - region.begin.column) != characters + 2) return std::nullopt;
  where.column += 1 + position;
  return where;
}

/// Compiles the formula in a string.
std::optional<Expression> compile(const toml::value<std::string>& text, const Value& value,
                                  const std::string& variables) {
  for (const std::string& name : names_in(*text)) {
    if (!value.reading.broken.contains(name)) continue;
    value.reading.wrong.insert(value.path);
    return std::nullopt;
  }
  try {
    return Expression(*text, value.reading.constants, variables);
  } catch (const ExpressionError& error) {
    if (const auto where = location_in_string(text, error.position())) {
      value.reading.problem(*where, value.path, error.what());
    } else if (error.position() >= 0 && !text->empty()) {
      value.problem(fmt::format("{} (at character {} of {})", error.what(), error.position() + 1, in_quotes(*text)));
    } else {
      value.problem(error.what());
    }
    return std::nullopt;
  }
}

}  // namespace

void Reading::problem(const Location& where, const std::string& path, const std::string& message,
                      const std::string& key) {
  wrong.insert(path);
  constexpr std::size_t longest = 200;  // bytes of a path, which may hold names that users gave
  // A program's own problem has no location.
  const std::string& wrong_key = key.empty() ? path : key;
  add({where, path.empty() ? message : shortened(path, longest) + ": " + message, where.file.empty() ? wrong_key : ""});
}

void Reading::add(Mistake problem) {
  constexpr std::size_t most = 200;
  if (problems.size() == most) {
    problems.push_back({problem.where, "from here on, more is wrong than is listed"});
    throw EnoughProblems();
  }
  problems.push_back(std::move(problem));
}

void Value::problem(const std::string& message) const { reading.problem(location_of(node.source()), path, message); }

bool Range::contains(double value) const {
  return (lower_allowed ? value >= lower : value > lower) && (upper_allowed ? value <= upper : value < upper);
}

std::string Range::text() const {
  const std::string above =
      std::isfinite(lower) ? fmt::format("{} {}", lower_allowed ? "at least" : "greater than", lower) : "";
  const std::string below =
      std::isfinite(upper) ? fmt::format("{} {}", upper_allowed ? "at most" : "less than", upper) : "";
  return above + (!above.empty() && !below.empty() ? " and " : "") + below;
}

std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return node.is_array_of_tables() ? "an array of tables" : "an array";
    case toml::node_type::string:
      return "the string " + in_quotes(*node.value<std::string>());
    case toml::node_type::integer:
      return fmt::format("the number {}", *node.value<std::int64_t>());
    case toml::node_type::floating_point:
      return fmt::format("the number {}", *node.value<double>());
    case toml::node_type::boolean:
      return *node.value<bool>() ? "true" : "false";
    default:
      return "a date or time";
  }
}

std::optional<double> read_number(const Value& value, const Range& range) {
  std::optional<double> number;
  if (const auto* text = value.node.as_string()) {
    if (const auto formula = compile(*text, value, "")) number = (*formula)({}, 0);
  } else if (const auto* integer = value.node.as_integer()) {
    number = static_cast<double>(integer->get());
  } else if (const auto* real = value.node.as_floating_point()) {
    number = real->get();
  } else {
    value.problem(fmt::format("expected a number or a formula, found {}", kind_of(value.node)));
  }
  if (!number) return std::nullopt;
  if (std::isfinite(*number) && range.contains(*number)) return number;
  value.problem(std::isfinite(*number) ? fmt::format("must be {}, not {}", range.text(), *number)
                                       : fmt::format("expected a finite number, found {}", *number));
  return std::nullopt;
}

std::optional<std::int64_t> read_whole(const Value& value, const Range& range) {
  std::optional<std::int64_t> whole;
  std::string found;
  if (const auto* integer = value.node.as_integer()) {
    whole = integer->get();
    found = fmt::format("{}", *whole);
  } else {
    const auto real = read_number(value);
    if (!real) return std::nullopt;
    found = fmt::format("{}", *real);
    constexpr double exact = 9007199254740992.0;  // 2^53: up to here doubles and whole numbers are the same
    if (std::abs(*real) <= exact && std::trunc(*real) == *real) whole = static_cast<std::int64_t>(*real);
  }
  if (whole && range.contains(static_cast<double>(*whole))) return whole;
  const std::string limits = std::isinf(range.upper) ? fmt::format("of at least {}", range.lower)
                                                     : fmt::format("from {} to {}", range.lower, range.upper);
  value.problem(fmt::format("must be a whole number {}, not {}", limits, found));
  return std::nullopt;
}

std::optional<Expression> read_formula(const Value& value, const std::string& variables) {
  if (const auto* text = value.node.as_string()) return compile(*text, value, variables);
  if (const auto number = read_number(value)) return Expression(*number);
  return std::nullopt;
}

std::optional<bool> read_truth(const Value& value) {
  if (const auto* const truth = value.node.as_boolean()) return truth->get();
  value.problem(fmt::format("expected true or false, found {}", kind_of(value.node)));
  return std::nullopt;
}

std::optional<std::string> read_text(const Value& value) {
  if (const auto* text = value.node.as_string()) return text->get();
  value.problem(fmt::format("expected a string, found {}", kind_of(value.node)));
  return std::nullopt;
}

}  // namespace stillpoint
