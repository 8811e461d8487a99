// A formula is refused with a reason, or computed: with the same bits by a copy of it.
#include <stillpoint/expression.hpp>

#include <array>
#include <limits>

#include "fuzz_target.hpp"

using namespace stillpoint;
using namespace stillpoint::fuzz;

namespace {

constexpr double kLargest = std::numeric_limits<double>::max(), kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::array<double, 4>, 4> kPlaces = {
    {{0, 0, 0, 0}, {0.3, -2, 7, 1.5}, {kLargest, -kLargest, 1e-310, 1e9}, {kNan, kNan, kNan, kNan}}};

void compute(const std::string& text, const std::string& variables) {
  const Expression formula(text, {{"P0", 2.0}, {"l", 10.0}}, variables);
  const Expression copy = formula;
  for (const auto& place : kPlaces) {
    const std::span<const double> x(place.data(), 3);
    const double value = formula(x, place[3]), again = copy(x, place[3]);
    require(value == again || (value != value && again != again), "a copy computes the same");
  }
  if (formula.constant()) require(formula({}, 0) - formula({}, 0) == 0, "a constant formula is a finite number");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = text_of(data, size);
  for (const char* variables : {"", "t", "xt", "xyzt"}) {
    try {
      compute(text, variables);
    } catch (const ExpressionError& error) {
      require_clear({{{"formula", 0, 0}, error.what()}});
      require(error.position() >= -1 && error.position() <= static_cast<int>(size), "a position lies in the formula");
    }
  }
  return 0;
}
