#include "scene/formula_parts.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

std::vector<std::string> differences(const std::string& formula) {
  std::vector<std::string> found;
  for (const FormulaComparison& comparison : comparisons_in(formula)) found.push_back(comparison.difference);
  return found;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("the two sides of a comparison end at what binds less than it does") {
  CHECK(differences("t>3").front() == "(t)-(3)");
  CHECK(differences("P*(t >= 2*T + 1)*(t<5)") == Texts{"(t )-( 2*T + 1)", "(t)-(5)"});
  CHECK(differences("t<1 ? t : 2").front() == "(t)-(1 )");
  CHECK(differences("t>1 && sin(t)!=0 || t==7") == Texts{"(t)-(1 )", "( sin(t))-(0 )", "( t)-(7)"});
  CHECK(differences("max(t<1, x<2)") == Texts{"(t)-(1)", "( x)-(2)"});
  CHECK(differences("P*t").empty());
  CHECK(differences("t<").empty());
}

TEST_CASE("a comparison's text is found where it stands") {
  const std::string formula = "1e3*(t>2)";
  const std::vector<FormulaComparison> found = comparisons_in(formula);
  REQUIRE(found.size() == 1);
  CHECK(formula.substr(found[0].begin, found[0].end - found[0].begin) == "t>2");
}

TEST_CASE("what stands in parentheses is an argument, and of several their differences as well") {
  CHECK(arguments_in("max(0, 1-abs(t-3))") == Texts{"0", " 1-abs(t-3)", "(0)-( 1-abs(t-3))", "t-3"});
  CHECK(arguments_in("t*2").empty());
  CHECK(arguments_in("sin(t").empty());
}
