// The balance of a static problem on its way from the state at the start to the whole load.
#include "system/static_balance.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"
#include "random_values.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("Q is (1 − s) R₀ + s F − R at the load factor s, and the residual its norm over that of the whole load") {
  const Chain chain({.n = 5, .cubic = 0.5, .load = 0.3});
  const std::vector<double> start = random_values(5, 1, 1), u = random_values(5, 1, 2);
  std::vector<double> R0(5), R(5);
  const auto trial = chain.make_trial();
  REQUIRE(chain.internal_force(0, start, R0, *trial));
  REQUIRE(chain.internal_force(0, u, R, *trial));
  StaticBalance balance(chain, 0, {});
  REQUIRE(balance.start(start));
  for (const double s : {0.0, 0.25, 1.0}) {
    CAPTURE(s);
    REQUIRE(balance.evaluate(s, u));
    double squares = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      const double Q = (1 - s) * R0[i] + s * 0.3 - R[i];
      CHECK(balance.Q.span()[i] == Approx(Q).margin(1e-15));
      squares += Q * Q;
    }
    CHECK(balance.residual() == Approx(std::sqrt(squares) / (0.3 * std::sqrt(5.0))));
  }
  CHECK(balance.evaluations == 4);
}

TEST_CASE("a static problem begins in balance at the load factor 0, whatever its state") {
  const Chain chain({.n = 5, .cubic = 0.5, .load = 0.3});
  const std::vector<double> start = random_values(5, 1);
  StaticBalance balance(chain, 0, {});
  REQUIRE(balance.start(start));
  REQUIRE(balance.evaluate(0, start));
  CHECK(balance.residual() == 0);
}

TEST_CASE("a state that cannot be evaluated is none of a static problem, and contact is refused") {
  const Chain chain({.n = 2, .cubic = 1});
  StaticBalance balance(chain, 0, {});
  CHECK_FALSE(balance.start(std::vector<double>{1e200, 0}));
  class Touching : public Chain, private Contact {
   public:
    Touching() { contact_ = this; }

   private:
    void add_force(double, const LinearDamping&, Vec) const override {}
    void hold(Vec) const override {}
    ContactChange update(double, Vec, Vec) override { return ContactChange::nothing; }
    double squared_forces(double sum) const override { return sum; }
  };
  CHECK_THROWS_AS(StaticBalance(Touching(), 0, {}), std::invalid_argument);
}
