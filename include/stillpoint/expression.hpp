// A formula in x, y, z, t and the scene's constants, compiled by muParser.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

namespace stillpoint {

using Constants = std::map<std::string, double>;

/// A fault in a formula and its position (0-based character; -1 if unknown).
class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(const std::string& what, int position) : std::runtime_error(what), position_(position) {}
  int position() const { return position_; }

 private:
  int position_;
};

/// A formula with value semantics. Threads that evaluate one, or its copies, wait for each other.
class Expression {
 public:
  /// The constant 0.
  Expression();
  explicit Expression(double value);
  /// variables: the names that the formula may use, of "x", "y", "z", "t". Throws ExpressionError, also if a formula
  /// without variables is not a finite number.
  Expression(const std::string& text, const Constants& constants, const std::string& variables = "xyzt");

  /// x: up to three coordinates [m], the missing ones 0; t [s].
  double operator()(std::span<const double> x, double t) const;
  bool uses(char variable) const;
  bool uses_position() const { return uses('x') || uses('y') || uses('z'); }
  bool constant() const { return !uses_position() && !uses('t'); }
  const std::string& text() const;
  /// A formula in the same variables and the constants that this one may use. Throws ExpressionError.
  Expression with_text(const std::string& text) const;

 private:
  struct Source;
  std::shared_ptr<Source> source_;  // null: a plain number
  double value_ = 0;
  std::string text_;
};

}  // namespace stillpoint
