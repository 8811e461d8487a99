// The lowest frequency, as the conjugate directions of auto show it.
#include <cmath>
#include <cstddef>

#include <catch2/catch.hpp>

#include "solvers/relaxation/relaxing.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("auto learns the lowest frequency that its load drives, and keeps quiet before it knows", "[strategies]") {
  class Oscillators final : public Chain {  // ω² = 1, and 199 from 100 to 199
   public:
    explicit Oscillators(double load_on_slowest) : Chain({.n = 200}), load_on_slowest_(load_on_slowest) {}
    static double squared(std::size_t i) { return i == 0 ? 1 : 99.5 + 0.5 * static_cast<double>(i); }
    void external_force(double, ConstVec, Vec F) const override {
      for (std::size_t i = 0; i < F.size(); ++i) F[i] = i == 0 ? load_on_slowest_ : 1;
    }
    bool internal_force(double, ConstVec u, Vec R, TrialState&) const override {
      for (std::size_t i = 0; i < R.size(); ++i) R[i] = squared(i) * u[i];
      return true;
    }

   private:
    double load_on_slowest_;
  };
  for (const double load : {1.0, 1e-3, 0.0}) {
    Oscillators system(load);
    Relaxing relaxing(system, {.strategy = "auto", .options = {.linear = true}}, 0.9 * 2 / std::sqrt(199.0));
    CHECK_FALSE(relaxing.stepper->lowest_frequency());
    const double exact = std::sqrt(Oscillators::squared(load > 0 ? 0 : 1));
    CAPTURE(load);
    for (int k = 0; k < 16; ++k) {
      relaxing.step();
      const auto known = relaxing.stepper->lowest_frequency();
      if (known) CHECK(*known <= 1.02 * exact);
    }
    REQUIRE(relaxing.stepper->lowest_frequency());
    CHECK(*relaxing.stepper->lowest_frequency() == Approx(exact).epsilon(5e-3));
  }
}
