#include "simulation/watch/standstill.hpp"

#include <catch2/catch.hpp>

using stillpoint::Standstill;

namespace {

void take(Standstill& standstill, int steps, double h, bool is_cut = false) {
  for (int k = 0; k < steps; ++k) standstill.take(h, is_cut);
}

}  // namespace

TEST_CASE("a run stands still after thousands of steps on end that are next to nothing") {
  Standstill standstill(2.0);
  take(standstill, Standstill::patience - 1, 1e-6);
  CHECK_FALSE(standstill.lasts());
  take(standstill, 1, 1e-6);
  CHECK(standstill.lasts());
}

TEST_CASE("a run that takes one longer step on its way, or is asked to land on many times, does not stand still") {
  Standstill standstill(2.0);
  take(standstill, Standstill::patience - 1, 1e-6);
  take(standstill, 1, 1e-5);
  take(standstill, Standstill::patience - 1, 1e-6);
  CHECK_FALSE(standstill.lasts());
  take(standstill, 5 * Standstill::patience, 1e-9, /*is_cut=*/true);
  CHECK_FALSE(standstill.lasts());
}
