#include "simulation/watch/limit_load.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace stillpoint;
using Catch::Matchers::Contains;

namespace {

constexpr double asked = 0.01;
constexpr double balanced = 1e-4;

/// λP = λ.
bool observe(LimitLoad& limit, const LoadState& load) { return limit.take(load, load.factor); }

/// Drives `limit` along factor_at(q) from 0 to q_end; the q at which it says that the limit is reached, q_end if never.
template <class FactorAt, class BodyAt>
double drive(LimitLoad& limit, double q_end, const FactorAt& factor_at, const BodyAt& body_at) {
  constexpr int steps = 5000;
  for (int k = 1; k <= steps; ++k) {
    const double q = q_end * k / steps;
    if (observe(limit, {.factor = factor_at(q), .displacement = q, .prescribed = q}) && limit.reached(body_at(q)))
      return q;
  }
  return q_end;
}
/// Of a body that yields ever more, in balance and at rest.
template <class FactorAt>
double drive(LimitLoad& limit, double q_end, const FactorAt& factor_at, double residual = balanced) {
  return drive(limit, q_end, factor_at,
               [&](double q) { return LimitLoad::Body{.residual = residual, .plastic_strain = q}; });
}

}  // namespace

TEST_CASE("the factor of an elastic body grows as fast as its displacement, whatever the stiffness and the sign") {
  for (const double k : {1e-6, 3.0, 1e9}) {
    CAPTURE(k);
    LimitLoad limit(asked);
    CHECK(drive(limit, 7, [k](double q) { return k * q; }) == 7);
    REQUIRE(limit.growth());
    CHECK(*limit.growth() == Approx(1).epsilon(1e-9));
    LimitLoad backwards(asked);
    for (int i = 1; i < 5000; ++i)
      CHECK_FALSE((observe(backwards, {.factor = k * i, .displacement = -1e-3 * i, .prescribed = -1e-3 * i}) &&
                   backwards.reached({.plastic_strain = 1.0 * i})));
    CHECK(*backwards.growth() == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("the growth of a hyperbolic curve is that of its formula") {
  // λ = q/(a + q): q/λ dλ/dq = a/(a + q), in the middle of the last fifth
  LimitLoad limit(0);
  drive(limit, 3, [](double q) { return q / (0.5 + q); });
  CHECK(limit.growth().value() == Approx(0.5 / (0.5 + 0.9 * 3)).epsilon(0.02));  // a line through a fifth of a curve
}

TEST_CASE("a limit is reached once the factor grows no more, and not while the body is out of balance") {
  const auto capped = [](double q) { return std::min(q, 1.0); };
  LimitLoad limit(asked);
  const double q = drive(limit, 5, capped);
  CHECK(q > 1.25 * 1.2);  // the last fifth of the way has to be flat, and a quarter more
  CHECK(q < 1.25 * 1.3);
  CHECK(limit.growth().value() <= asked);
  for (const double residual : {0.5, std::nan("")}) {
    LimitLoad moving(asked);
    CHECK(drive(moving, 5, capped, residual) == 5);
  }
}

TEST_CASE("the jolt with which a displacement sets in is no measure of what the body bears later") {
  LimitLoad limit(asked);
  CHECK(drive(limit, 5, [](double q) { return q < 0.01 ? 2.0 : q; }) == 5);
  CHECK(limit.growth().value() == Approx(1).epsilon(1e-3));
}

TEST_CASE("what other loads do before and beside is no limit: an elastic body grows by 1 from wherever it begins") {
  LimitLoad held(asked);  // before it is driven, other loads settle against what holds it
  for (int k = 1; k <= 5000; ++k)
    CHECK_FALSE(observe(held, {.factor = 1e-3 * std::tanh(0.01 * k), .displacement = -1e-9 * k, .prescribed = 0}));
  CHECK_FALSE(held.growth());
  LimitLoad preloaded(asked);
  observe(preloaded, {.factor = 1e4, .displacement = 0, .prescribed = 0});
  CHECK(drive(preloaded, 5, [](double q) { return 1e4 + q; }) == 5);
  CHECK(preloaded.growth().value() == Approx(1).epsilon(1e-6));
}

TEST_CASE("a peak is a limit, and what swings about a rising curve is none") {
  LimitLoad peak(asked);
  CHECK(drive(peak, 3, [](double q) { return q * std::exp(-q); }) ==
        Approx(1.25 * 1.1).epsilon(0.05));  // the peak is at 1
  LimitLoad swinging(asked);
  CHECK(drive(swinging, 5, [](double q) { return q + 0.02 * std::sin(100 * q); }) == 5);
}

TEST_CASE("without a criterion no limit is reached, and what turns back or stands is no new displacement") {
  LimitLoad unasked(0);
  CHECK(drive(unasked, 5, [](double) { return 1.0; }) == 5);
  LimitLoad turned(asked);
  drive(turned, 1, [](double q) { return q; });
  const double before = turned.growth().value();
  for (int k = 0; k < 1000; ++k) observe(turned, {.factor = 0.5, .displacement = 0.5, .prescribed = 0.5});
  CHECK(turned.growth().value() == before);
}

TEST_CASE("a limit load that was saved on the way is found at the same displacement") {
  const auto curve = [](double q) { return std::tanh(q); };
  LimitLoad whole(asked);
  const double expected = drive(whole, 10, curve);
  REQUIRE(expected < 10);
  LimitLoad first(asked), second(asked);
  SavedState saved;
  for (int k = 1; k <= 5000; ++k) {
    const double q = 10.0 * k / 5000;
    LimitLoad& now = k <= 777 ? first : second;
    const bool found = observe(now, {.factor = curve(q), .displacement = q, .prescribed = q}) &&
                       now.reached({.residual = balanced, .plastic_strain = q});
    if (k == 777) {
      first.archive(StateArchive::saving(saved));
      second.archive(StateArchive::restoring(saved));
    }
    if (!found) continue;
    CHECK(q == expected);
    return;
  }
  FAIL("no limit was found");
}

TEST_CASE("a factor that stands still is no limit while the body is thrown about, and the reason says so") {
  const auto flat = [](double q) { return std::min(q, 1.0); };
  LimitLoad thrown(asked);
  const auto moving = [](double q) {
    return LimitLoad::Body{.residual = balanced, .kinetic_energy = 45 * q, .plastic_strain = q};
  };
  CHECK(drive(thrown, 5, flat, moving) == 5);
  CHECK_THAT(thrown.description(), Contains("the kinetic energy has been") && Contains("not quasi-static"));
  // At every other moment at rest, as at the turning points of a swing.
  LimitLoad swinging(asked);
  int looks = 0;
  const auto turning = [&](double q) {
    return LimitLoad::Body{.residual = balanced, .kinetic_energy = ++looks % 2 ? 0 : 0.1 * q, .plastic_strain = q};
  };
  CHECK(drive(swinging, 5, flat, turning) == 5);
  LimitLoad slow(asked);
  const auto quasi_static = [](double q) {
    return LimitLoad::Body{.residual = balanced, .kinetic_energy = 1e-4 * q, .plastic_strain = q};
  };
  CHECK(drive(slow, 5, flat, quasi_static) < 5);
  CHECK(slow.growth().value() <= asked);
  CHECK_THAT(slow.description(), !Contains("but"));
  LimitLoad unknown(asked);
  const auto no_number = [](double q) {
    return LimitLoad::Body{.residual = balanced, .kinetic_energy = std::nan(""), .plastic_strain = q};
  };
  CHECK(drive(unknown, 5, flat, no_number) == 5);
}

TEST_CASE("an elastic body has no limit load, however its factor stands or falls, and one that slides on a wall has") {
  for (const bool snaps : {false, true}) {
    const auto factor = [snaps](double q) { return snaps ? q * std::exp(-q) : std::min(q, 1.0); };
    LimitLoad elastic(asked);
    const auto never_yields = [](double) { return LimitLoad::Body{.residual = balanced}; };
    CHECK(drive(elastic, 5, factor, never_yields) == 5);
    CHECK_THAT(elastic.description(), Contains("no point yields and nothing slides"));
    LimitLoad early(asked);  // it yielded once, and does not any more
    const auto yielded = [](double q) {
      return LimitLoad::Body{.residual = balanced, .plastic_strain = std::min(q, 0.1)};
    };
    CHECK(drive(early, 5, factor, yielded) == 5);
    LimitLoad sliding(asked);
    const auto slides = [](double q) { return LimitLoad::Body{.residual = balanced, .slides = q > 1}; };
    CHECK(drive(sliding, 5, factor, slides) < 5);
  }
}

TEST_CASE("what keeps a flat factor from being a limit is named: never that it grew less than it may, and no more") {
  const auto flat = [](double q) { return std::min(q, 1.0); };
  LimitLoad damped(asked);
  CHECK(drive(damped, 5, flat, 0.03) == 5);
  CHECK_THAT(damped.description(), Contains("but the residual is 0.03 of 0.001 at most"));
  LimitLoad young(asked);
  drive(young, 1.3, flat);
  CHECK_THAT(young.description(), Contains("but it has done so only since q(t) ="));
  LimitLoad growing(asked);
  drive(growing, 5, [](double q) { return q; });
  CHECK_THAT(growing.description(), !Contains("but"));
}
