#include "base/exact_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

namespace stillpoint {
namespace {

// Terms from begin to end.
ExactSum sum_of(const std::vector<double>& terms, std::size_t begin, std::size_t end) {
  ExactSum sum;
  sum.add(begin, end, [&](std::size_t i) { return terms[i]; });
  return sum;
}
double value_of(const std::vector<double>& terms) { return sum_of(terms, 0, terms.size()).value(); }

// Of both signs, and of all sizes between 2^-spread and 2^spread.
std::vector<double> random_terms(std::size_t count, double spread, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> exponent(-spread, spread), sign(-1, 1);
  std::vector<double> terms(count);
  for (double& term : terms) term = std::copysign(std::exp2(exponent(engine)), sign(engine));
  return terms;
}

TEST_CASE("a sum has the same bits in any order of its terms, divided in any way") {
  std::mt19937_64 engine(1);
  for (const double spread : {1.0, 20.0, 60.0, 300.0}) {
    INFO("sizes from 2^-" << spread << " to 2^" << spread);
    std::vector<double> terms = random_terms(5000, spread, engine);
    const double alone = value_of(terms);
    CHECK(alone != 0);
    for (int trial = 0; trial < 20; ++trial) {
      std::ranges::shuffle(terms, engine);
      ExactSum parts;
      for (std::size_t begin = 0; begin < terms.size();) {
        const std::size_t end = std::min(terms.size(), begin + engine() % 1500);
        parts.add(sum_of(terms, begin, end));
        begin = end;
      }
      CHECK(parts.value() == alone);
    }
    std::ranges::sort(terms, {}, [](double x) { return std::abs(x); });  // each of a new size
    CHECK(value_of(terms) == alone);
    std::ranges::reverse(terms);
    CHECK(value_of(terms) == alone);
  }
}

// A long double has 64 binary places, and the terms here have so many between them.
TEST_CASE("a sum is right to 2^-64 of its largest term for each of its terms") {
  std::mt19937_64 engine(2);
  for (const double spread : {0.5, 4.0, 40.0}) {
    const std::vector<double> terms = random_terms(300, spread, engine);
    long double expected = 0;
    double largest = 0;
    std::vector<double> by_size = terms;
    std::ranges::sort(by_size, {}, [](double x) { return std::abs(x); });
    for (const double term : by_size) expected += term, largest = std::max(largest, std::abs(term));
    const double allowed = 300 * std::exp2(-64) * largest;  // as much again by the long doubles
    const auto error = static_cast<double>(value_of(terms) - expected);
    CHECK(std::abs(error) <= 2 * allowed + std::exp2(-53) * std::abs(static_cast<double>(expected)));
  }
}

TEST_CASE("what cancels leaves nothing, and what is left of large terms is there") {
  CHECK(value_of({1e16, 1, -1e16}) == 1);
  CHECK(value_of({3e-9, 1e8, -3e-9, -1e8}) == 0);
  CHECK(value_of({0.1, 0.2, -0.3}) == 0x1p-55);  // 0.1 + 0.2 is 0x1p-54 in doubles
  const std::vector<double> same(100'000, 0.1);
  CHECK(value_of(same) == 1e4);  // nearest to 100 000 times the double, which term by term is missed by 2e-8
}

TEST_CASE("nothing, zeros and a single term are their own sum") {
  CHECK(value_of({}) == 0);
  CHECK(value_of({0, -0.0}) == 0);
  for (const double x : {1.0, -3.7, 1e-200, 1e290, 0x1p31, -0x1p-33, 0x1.fffffffffffffp31}) CHECK(value_of({x}) == x);
}

TEST_CASE("a term that is no number, infinite or beyond all bins is seen in the sum wherever it stands") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const std::size_t at : {0UL, 5UL, 600UL, 1029UL}) {
    std::vector<double> terms(1030, 1.0);
    terms[at] = nan;
    CHECK(std::isnan(value_of(terms)));
    terms[at] = infinite;
    CHECK(value_of(terms) == infinite);
    terms[at] = -infinite;
    CHECK(value_of(terms) == -infinite);
    terms[(at + 700) % 1030] = infinite;
    CHECK(std::isnan(value_of(terms)));
    terms.assign(1030, 1.0);
    terms[at] = 1e308;
    CHECK(value_of(terms) == 1e308);
    terms[at] = 1e306;
    terms[(at + 1) % 1030] = -1e306;
    CHECK(value_of(terms) == 1028);
  }
}

}  // namespace
}  // namespace stillpoint
