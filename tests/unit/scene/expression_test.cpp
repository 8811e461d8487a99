#include <stillpoint/expression.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "allocation_count.hpp"

using stillpoint::Constants;
using stillpoint::Expression;
using stillpoint::ExpressionError;

namespace {

const Constants kConstants = {{"P0", 2.0}, {"l", 10.0}};

double value(const std::string& text, double x = 0, double t = 0) {
  const std::array<double, 1> place = {x};
  return Expression(text, kConstants)(place, t);
}

/// The error that a formula gives: its message and its position.
std::pair<std::string, int> error_of(const std::string& text, const std::string& variables = "xyzt",
                                     const Constants& constants = kConstants) {
  try {
    const Expression compiled(text, constants, variables);
  } catch (const ExpressionError& error) {
    return {error.what(), error.position()};
  }
  return {"no error", -2};
}

using Error = std::pair<std::string, int>;

}  // namespace

TEST_CASE("formulas follow the usual rules of arithmetic") {
  CHECK(value("1e-3") == 0.001);
  CHECK(value(" 7 ") == 7);
  CHECK(value("P0*x^2", 3) == 18);
  CHECK(value("-x^2", 3) == -9);
  CHECK(value("2^3^2") == 512);
  CHECK(value("1 - 2 - 3") == -4);
  CHECK(value("7/2") == 3.5);
  CHECK(value("sin(pi*x/l)", 5) == Approx(1));
  CHECK(value("e^1") == std::numbers::e);
  CHECK(value("max(x, 2, 1)", 1) == 2);
}

TEST_CASE("conditions choose between two formulas") {
  CHECK(value("t < 1 ? t : 1", 0, 0.25) == 0.25);
  CHECK(value("t < 1 ? t : 1", 0, 4) == 1);
  CHECK(value("x >= 2 && t == 0 ? 1 : 0", 2, 0) == 1);
}

TEST_CASE("constants that are handed to a formula win over its numbers e and pi, which no scene can name anew") {
  CHECK(Expression("e", {{"e", 0.6}})({}, 0) == 0.6);
}

TEST_CASE("a formula takes up to three coordinates, and the missing ones are 0") {
  const Expression sum("x + 10*y + 100*z + 1000*t", {});
  CHECK(sum(std::array{1.0, 2.0, 3.0}, 4) == 4321);
  CHECK(sum(std::array{1.0}, 4) == 4001);
}

TEST_CASE("a formula knows which variables it uses") {
  const Expression ramp("P0*t", kConstants);
  CHECK(ramp.uses('t'));
  CHECK_FALSE(ramp.uses('x'));
  CHECK_FALSE(ramp.constant());
  CHECK(Expression("P0*2", kConstants).constant());
  CHECK(Expression(3.0).constant());
  CHECK(Expression()({}, 0) == 0);
  CHECK(ramp.text() == "P0*t");
}

TEST_CASE("a copy has its own variables and outlives the original") {
  std::optional<Expression> original(Expression("x + t", {}));
  const Expression copy = *original;
  Expression assigned;
  assigned = copy;
  original.reset();
  CHECK(copy(std::array{1.0}, 2) == 3);
  CHECK(assigned(std::array{5.0}, 2) == 7);
  const Expression moved = std::move(assigned);
  CHECK(moved(std::array{6.0}, 2) == 8);
}

TEST_CASE("an unknown name is reported at its place, with the name that was meant") {
  CHECK(error_of("2*P1") == Error("unknown name 'P1'; did you mean 'P0'?", 2));
  CHECK(error_of("sine(x)") == Error("unknown name 'sine'; did you mean 'sin'?", 0));
  CHECK(error_of("mushroom") == Error("unknown name 'mushroom'", 0));
  CHECK(error_of("inf").first.starts_with("unknown name 'inf'"));
}

TEST_CASE("a variable that has no meaning here is refused as such") {
  CHECK(error_of("2*x", "t") == Error("'x' cannot be used here: this is a formula of t", 2));
  CHECK(error_of("2*t", "") ==
        Error("'t' cannot be used here: this is a number, the same everywhere and at all times", 2));
}

TEST_CASE("a syntax error says what is wrong and where") {
  CHECK(error_of("") == Error("the formula is empty", 0));
  CHECK(error_of("x*") == Error("the formula ends too early", 2));
  CHECK(error_of("3*(x") == Error("a ')' is missing", 4));
  CHECK(error_of("3*x)") == Error("unexpected ')'", 3));
  CHECK(error_of("2**3") == Error("unexpected '*'", 2));
  CHECK(error_of("2x") == Error("unexpected 'x'", 1));
  CHECK(error_of("x ? 1") == Error("'?' without its ':'", -1));
  CHECK(error_of("1 + atan2(x)") == Error("too few arguments for 'atan2'", 4));
  CHECK(error_of("sin*2") == Error("the function 'sin' needs its arguments in ( )", 0));
}

TEST_CASE("what muParser would quietly accept but no formula means is refused") {
  CHECK(error_of("x = 2") == Error("'=' assigns; to compare, write '=='", 2));
  CHECK(error_of("1,2") == Error("a formula has one value; ',' makes more of them", -1));
  CHECK(error_of("\"x\"") == Error("a formula cannot hold '\"'", 0));
  CHECK(error_of("2*π") == Error("a formula cannot hold 'π'", 2));
  CHECK(error_of(std::string("1\0+1", 4)) == Error("a formula cannot hold '\\x00'", 1));
  CHECK(error_of("x", "xt", {{"x", 1.0}}) == Error("the constant 'x' has the name of a variable", -1));
}

TEST_CASE("a formula without variables is a finite number") {
  CHECK(error_of("1/0") == Error("the value inf is not a finite number", -1));
  CHECK(error_of("sqrt(-1)").first.find("is not a finite number") != std::string::npos);
  CHECK(error_of("1e999").second != -2);
  CHECK(error_of("1/x") == Error("no error", -2));  // x decides
}

TEST_CASE("a formula is no longer than 4000 characters, however it gets there") {
  const auto repeated = [](const std::string& part, std::size_t size) {
    std::string text;
    while (text.size() < size) text += part;
    return text;
  };
  const auto is_refused = [](const std::string& text) {
    return error_of(text).first == "a formula has 4000 characters at most, not " + std::to_string(text.size());
  };
  for (const char* part : {"x+", "x^", "2^", "sin(x)*", "x?t:", "x>"}) {
    CAPTURE(part);
    CHECK(error_of(repeated(part, 3900) + "x") == Error("no error", -2));
    CHECK(is_refused(repeated(part, 4001)));
    CHECK(is_refused(repeated(part, 1'000'000)));
  }
  CHECK(error_of(repeated("(", 1999) + "x" + repeated(")", 1999)) == Error("no error", -2));
  CHECK(error_of(repeated("sin(", 3192) + "x" + repeated(")", 798)) == Error("no error", -2));
  CHECK(is_refused(repeated("(", 3000) + "x" + repeated(")", 3000)));
  CHECK(is_refused(repeated("x?", 4000) + "1" + repeated(":1", 4000)));
  CHECK(is_refused(repeated("1", 5000)));
  CHECK(is_refused(repeated(" ", 5000) + "x"));
  CHECK(is_refused("max(" + repeated("x,", 4000) + "x)"));
}

TEST_CASE("a formula takes memory for the constants that it names, not for all of a scene") {
  Constants many = kConstants;
  for (int k = 0; k < 1000; ++k) many["constant_" + std::to_string(k)] = k;
  const auto allocations = [](const Constants& constants) {
    const long before = stillpoint::test::allocation_count();
    const Expression formula("P0*x + l*t", constants);
    const Expression copy = formula;
    return stillpoint::test::allocation_count() - before;
  };
  allocations(kConstants);  // what is made once
  CHECK(allocations(many) == allocations(kConstants));
}

TEST_CASE("endless formulas are refused or computed, without harm") {
  const auto survives = [](const std::string& text) { return !error_of(text).first.empty(); };
  CHECK(survives(std::string(100000, '(') + "1"));
  CHECK(survives(std::string(2000, '(') + "x" + std::string(2000, ')')));
  CHECK(survives(std::string(100000, '-') + "1"));
  CHECK(survives(std::string(100000, '1')));
  CHECK(survives(std::string(100000, 'a')));
  std::string tower = "x";
  for (int k = 0; k < 2000; ++k) tower += "^x";
  CHECK(survives(tower));
  std::string choices;
  for (int k = 0; k < 1000; ++k) choices += "x?t:";
  CHECK(survives(choices + "1"));
}

TEST_CASE("formulas know Bessel's functions") {
  CHECK(value("bessel_j0(x)", 2.404825557695773) == Approx(0).margin(1e-15));
  CHECK(value("2*bessel_j1(x) + P0", 1) == Approx(2 * 0.440050585744933516 + 2).epsilon(1e-15));
  CHECK(error_of("besel_j1(x)").first.find("did you mean 'bessel_j1'") != std::string::npos);
}
