// Points by chance: as far from their regular places as the scene says, and the same for the same seed.
#include <cmath>
#include <cstddef>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "space/points/placed_bodies.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("jitter moves every point by at most its share of half the spacing, so that each stays in its cell") {
  for (const Placement placement : {Placement::uniform, Placement::gauss}) {
    BodySpec body = box({0, 0}, {4, 2});
    body.placement = placement;
    body.points_per_cell = {3, 2};
    const auto regular = place(body);
    body.jitter = 0.999;
    const auto jittered = place(body);
    check_cells(jittered);
    CHECK(volume_of(jittered) == Approx(8).epsilon(1e-12));
    Largest farthest;
    for (std::size_t p = 0; p < regular.size(); ++p)
      farthest.take_magnitude(jittered.position(p)[0] - regular.position(p)[0]);
    // Half the spacing; of three Gauss points the middle one has more room, 0.387 of half a cell.
    const double room = placement == Placement::uniform ? 0.5 / 3 / 2 : 0.25 * std::sqrt(0.6) / 2;
    CHECK(farthest.value() < room);
    CHECK(farthest.value() > 0.95 * room);
    // Neighbours keep their order.
    for (std::size_t p = 0; p + 1 < jittered.size(); ++p)
      if (p % 3 != 2) CHECK(jittered.position(p)[0] < jittered.position(p + 1)[0]);

    body.jitter = 0.1;
    const auto little = place(body);
    for (std::size_t p = 0; p < regular.size(); ++p)
      CHECK(std::abs(little.position(p)[0] - regular.position(p)[0]) <= 0.1 * room);
  }
}

TEST_CASE("jittered and random points are the same for the same seed, and others for another") {
  for (const bool random : {true, false}) {
    BodySpec body = box({0, 0}, {4, 2});
    if (random) body.placement = Placement::random;
    if (!random) body.jitter = 0.5;
    const auto first = place(body), again = place(body);
    body.seed = 2;
    const auto other = place(body);
    CHECK(first.x == again.x);
    CHECK(first.volume == again.volume);
    CHECK_FALSE(first.x[0] == other.x[0]);
    CHECK_FALSE(first.x[1] == other.x[1]);
  }
}
