#include <stillpoint/expression.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <muParser.h>

#include "base/special_functions.hpp"
#include "base/text.hpp"
#include "scene/formula_parts.hpp"

namespace stillpoint {
namespace {

constexpr std::string_view kVariables = "xyzt";
/// muParser's time grows with the square of the length; a formula this long takes it about 5 ms.
constexpr std::size_t kLongest = 4000;
/// The characters of muParser's operators. By default they include letters, and at each operator of x+x+x… it would
/// read on to the end.
constexpr const char* kOperatorCharacters = "+-*/^?<>=#!$%&|~";

/// A function that formulas have beyond muParser's own: Bessel's functions of the first kind.
struct OwnFunction {
  const char* name;
  double (*value)(double);
};
constexpr std::array<OwnFunction, 2> kOwnFunctions = {{{"bessel_j0", bessel_j0}, {"bessel_j1", bessel_j1}}};

/// Known in every formula; a scene has no others of these names.
const Constants& default_constants() {
  static const Constants constants = {{"pi", std::numbers::pi}, {"e", std::numbers::e}};
  return constants;
}

/// The value of a text that is nothing but a decimal number; muParser is not needed for it.
std::optional<double> plain_number(std::string_view text) {
  const auto is_space = [](char letter) { return letter == ' ' || letter == '\t'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // "inf" and "nan" are numbers to from_chars; here they are names that no one defined.
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Refuses what muParser would accept although no formula here means it: strings, assignments to x, several results.
void check_characters(const std::string& text) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) throw ExpressionError("the formula is empty", 0);
  if (text.size() > kLongest)
    throw ExpressionError(fmt::format("a formula has {} characters at most, not {}", kLongest, text.size()), -1);
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char letter = text[k];
    const bool printable = letter >= 0x20 && letter < 0x7f;
    const bool space = letter == '\t' || letter == '\n' || letter == '\r';
    // All letters before this one are ASCII, so the byte number is the character number.
    if ((!printable && !space) || letter == '"') {
      std::size_t length = 1;
      while (k + length < text.size() && (static_cast<unsigned char>(text[k + length]) & 0xC0) == 0x80) ++length;
      throw ExpressionError(fmt::format("a formula cannot hold {}", in_quotes(text.substr(k, length))),
                            static_cast<int>(k));
    }
    if (letter != '=') continue;
    const bool second = k > 0 && std::string_view("=<>!").find(text[k - 1]) != std::string_view::npos;
    const bool first = k + 1 < text.size() && text[k + 1] == '=';
    if (!first && !second) throw ExpressionError("'=' assigns; to compare, write '=='", static_cast<int>(k));
  }
}

/// muParser's error in this program's words, with the position of the offending token.
ExpressionError in_our_words(const mu::ParserError& error, const std::string& text, const Constants& constants,
                             const std::string& variables) {
  std::string token = error.GetToken();
  while (!token.empty() && token.back() == ' ') token.pop_back();
  // After an unexpected end muParser counts a space that it appended.
  int position = std::min(error.GetPos(), static_cast<int>(text.size()));
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN: {
      const char letter = token.empty() ? '\0' : token.front();
      const bool is_name = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || letter == '_';
      if (!is_name) return {fmt::format("unexpected {}", in_quotes(token)), position};
      if (token.size() == 1 && kVariables.find(letter) != std::string_view::npos)
        return {fmt::format("'{}' cannot be used here: this is a {}", token,
                            variables.empty() ? "number, the same everywhere and at all times"
                                              : fmt::format("formula of {}", fmt::join(variables, ", "))),
                position};
      std::vector<std::string> names = expression_functions();
      const bool is_function = std::find(names.begin(), names.end(), token) != names.end();
      for (const Constants* const known : {&constants, &default_constants()})
        for (const auto& constant : *known) names.push_back(constant.first);
      for (const char name : variables) names.emplace_back(1, name);
      const std::string meant = nearest(token, names);
      if (is_function) return {fmt::format("the function {} needs its arguments in ( )", in_quotes(token)), position};
      return {
          fmt::format("unknown name {}{}", in_quotes(token), meant.empty() ? "" : "; did you mean '" + meant + "'?"),
          position};
    }
    case mu::ecUNEXPECTED_EOF:
      return {"the formula ends too early", position};
    case mu::ecMISSING_PARENS:
      return {"a ')' is missing", position};
    case mu::ecUNEXPECTED_OPERATOR:
    case mu::ecUNEXPECTED_PARENS:
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
    case mu::ecUNEXPECTED_ARG_SEP:
      return {fmt::format("unexpected {}", in_quotes(token.empty() ? "," : token)), position};
    case mu::ecTOO_MANY_PARAMS:
    case mu::ecTOO_FEW_PARAMS: {
      // muParser points behind the arguments; the function's name is the better position.
      const auto name = text.rfind(token, static_cast<std::size_t>(std::max(position, 0)));
      if (name != std::string::npos) position = static_cast<int>(name);
      const bool few = error.GetCode() == mu::ecTOO_FEW_PARAMS;
      return {fmt::format("too {} arguments for {}", few ? "few" : "many", in_quotes(token)), position};
    }
    case mu::ecMISSING_ELSE_CLAUSE:
      return {"'?' without its ':'", position};
    default:
      return {error.GetMsg(), position};
  }
}

}  // namespace

const std::vector<std::string>& expression_functions() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    const mu::Parser parser;
    for (const auto& function : parser.GetFunDef()) found.push_back(function.first);
    for (const OwnFunction& function : kOwnFunctions) found.emplace_back(function.name);
    return found;
  }();
  return names;
}

const std::vector<std::string>& expression_constants() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    for (const auto& constant : default_constants()) found.push_back(constant.first);
    return found;
  }();
  return names;
}

std::vector<std::string> names_in(std::string_view formula) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::vector<std::string> names;
  for (std::size_t k = 0; k < formula.size();) {
    const std::size_t begin = k;
    if (is_letter(formula[k])) {
      while (k < formula.size() && (is_letter(formula[k]) || is_digit(formula[k]))) ++k;
      names.emplace_back(formula.substr(begin, k - begin));
    } else if (is_digit(formula[k])) {
      while (k < formula.size() && (is_digit(formula[k]) || formula[k] == '.')) ++k;
      // The e of 1e-3 is no name, but that of 2e is.
      if (k < formula.size() && (formula[k] == 'e' || formula[k] == 'E')) {
        std::size_t digits = k + 1;
        if (digits < formula.size() && (formula[digits] == '+' || formula[digits] == '-')) ++digits;
        if (digits < formula.size() && is_digit(formula[digits])) k = digits;
        while (k < formula.size() && is_digit(formula[k])) ++k;
      }
    } else {
      ++k;
    }
  }
  return names;
}

namespace {

/// muParser's form of a formula, some 5 kB.
struct Compiled {
  std::array<double, 4> values{};  // of x, y, z, t; the parser reads them in place
  mu::Parser parser;

  Compiled(const std::string& text, const std::string& used, const Constants& constants) {
    parser.ClearConst();  // muParser's own are called _pi and _e
    parser.DefineOprtChars(kOperatorCharacters);
    for (const auto& [name, value] : kOwnFunctions) parser.DefineFun(name, value);
    for (const char name : used) parser.DefineVar(std::string(1, name), &values.at(kVariables.find(name)));
    for (const auto& [name, value] : constants) parser.DefineConst(name, value);
    parser.SetExpr(text);
    parser.Eval();
  }
  Compiled(const Compiled&) = delete;
  Compiled& operator=(const Compiled&) = delete;

  double evaluate() {
    try {
      return parser.Eval();
    } catch (const mu::ParserError& error) {
      throw ExpressionError(error.GetMsg(), error.GetPos());
    }
  }
};

}  // namespace

/// The parts of a formula, and its compiled form, which is not there before somebody wants a value: a scene may have
/// hundreds of thousands of formulas. Copies share both; one thread at a time evaluates.
struct Expression::Source {
  std::string text, variables;
  Constants constants;  // those that the formula names
  std::string used;     // those of x, y, z, t that it depends on

  Source(std::string text_, const Constants& all, std::string variables_)
      : text(std::move(text_)), variables(std::move(variables_)) {
    check_characters(text);
    for (const char name : variables)
      if (all.contains(std::string(1, name)))
        throw ExpressionError(fmt::format("the constant '{}' has the name of a variable", name), -1);
    for (const std::string& name : names_in(text)) look_up(name, all);
  }

  double evaluate(std::span<const double> x, double t) {
    const std::scoped_lock lock(mutex_);
    if (!compiled_) compiled_ = std::make_unique<Compiled>(text, used, constants);
    for (std::size_t axis = 0; axis < 3; ++axis) compiled_->values[axis] = axis < x.size() ? x[axis] : 0;
    compiled_->values[3] = t;
    return compiled_->evaluate();
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<Compiled> compiled_;

  void look_up(const std::string& name, const Constants& all) {
    if (name.size() == 1 && variables.find(name) != std::string::npos) {
      if (used.find(name) == std::string::npos) used += name;
      return;
    }
    for (const Constants* const known : {&all, &default_constants()}) {
      const auto found = known->find(name);
      if (found == known->end()) continue;
      constants.insert(*found);
      return;
    }
  }
};

Expression::Expression() : Expression(0.0) {}

Expression::Expression(double value) : value_(value), text_(fmt::format("{}", value)) {}

Expression::Expression(const std::string& text, const Constants& constants, const std::string& variables)
    : text_(text) {
  if (const auto number = plain_number(text)) {
    value_ = *number;
    return;
  }
  const auto source = std::make_shared<Source>(text, constants, variables);
  try {
    Compiled compiled(text, source->used, source->constants);
    if (compiled.parser.GetNumResults() != 1)
      throw ExpressionError("a formula has one value; ',' makes more of them", -1);
    value_ = compiled.evaluate();
  } catch (const mu::ParserError& error) {
    throw in_our_words(error, text, constants, variables);
  }
  if (!source->used.empty()) {
    source_ = source;
  } else if (!std::isfinite(value_)) {
    throw ExpressionError(fmt::format("the value {} is not a finite number", value_), -1);
  }
}

double Expression::operator()(std::span<const double> x, double t) const {
  if (!source_) return value_;
  return source_->evaluate(x, t);
}

bool Expression::uses(char variable) const { return source_ && source_->used.find(variable) != std::string::npos; }

const std::string& Expression::text() const { return text_; }

Expression Expression::with_text(const std::string& text) const {
  return source_ ? Expression(text, source_->constants, source_->variables) : Expression(text, {});
}

}  // namespace stillpoint
