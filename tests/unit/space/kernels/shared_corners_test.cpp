// Sums at functions that cells of several ranks have.
#include <cstddef>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "space/kernels/corner_sum.hpp"
#include "thread_ranks.hpp"

using namespace stillpoint;
using test::as_ranks;

namespace {

constexpr int side = 7, per_cell = 4, components = 2;
constexpr std::size_t functions = (side + 1) * (side + 1);

/// Cells of two materials in a grid of side × side, some of which are empty, with values at their corners.
struct Cells {
  explicit Cells(unsigned seed) {
    std::mt19937_64 random(seed);
    for (int material = 0; material < 2; ++material) {
      for (int cell = 0; cell < side * side; ++cell) {
        if (random() % 3 == 0) continue;
        places.push_back({material, cell});
        const int first = cell / side * (side + 1) + cell % side;
        for (const int step : {0, 1, side + 1, side + 2}) function_of_corner.push_back(first + step);
        for (int k = 0; k < per_cell * components; ++k)
          values.push_back(std::uniform_real_distribution<double>(-1, 1)(random));
      }
    }
  }
  std::vector<CellPlace> places;
  std::vector<int> function_of_corner;
  std::vector<double> values;
};

std::vector<double> sums_of(const CornerSum& corner_sum, std::vector<double> values) {
  values.resize(components * corner_sum.corners() + CornerSum::slack);
  std::vector<double> sums(components * functions);
  corner_sum.for_functions(values.data(), components, [&](std::size_t f) {
    const auto sum = corner_sum.sum<components>(f, values.data());
    for (std::size_t i = 0; i < components; ++i) sums[components * f + i] = sum[static_cast<int>(i)];
  });
  corner_sum.complete(sums.data(), components);
  return sums;
}

}  // namespace

TEST_CASE("sums at functions have the same bits on any number of ranks, whichever of them has which cell") {
  for (unsigned seed = 1; seed < 6; ++seed) {
    const Cells all(seed);
    CornerSum alone;
    alone.rebuild(all.function_of_corner, functions);
    const std::vector<double> expected = sums_of(alone, all.values);
    for (const int count : {1, 2, 3, 5}) {
      std::vector<std::vector<double>> found(static_cast<std::size_t>(count));
      std::vector<char> reach_alike(static_cast<std::size_t>(count), 1);
      as_ranks(count, [&](const Ranks& ranks) {
        std::mt19937_64 random(seed);
        std::vector<int> owner(side * side);  // of a cell with all its materials
        for (int& rank : owner) rank = static_cast<int>(random() % static_cast<unsigned>(count));
        Cells mine(seed);
        mine.places.clear();
        mine.function_of_corner.clear();
        mine.values.clear();
        for (std::size_t k = 0; k < all.places.size(); ++k) {
          if (owner[static_cast<std::size_t>(all.places[k].cell)] != ranks.rank()) continue;
          mine.places.push_back(all.places[k]);
          for (std::size_t a = 0; a < per_cell; ++a)
            mine.function_of_corner.push_back(all.function_of_corner[per_cell * k + a]);
          for (std::size_t c = 0; c < per_cell * components; ++c)
            mine.values.push_back(all.values[per_cell * components * k + c]);
        }
        CornerSum corner_sum;
        corner_sum.rebuild(mine.function_of_corner, functions, &ranks, mine.places);
        const auto r = static_cast<std::size_t>(ranks.rank());
        found[r] = sums_of(corner_sum, mine.values);
        for (std::size_t f = 0; f < functions; ++f)
          if (corner_sum.reaches(f) != alone.reaches(f)) reach_alike[r] = 0;
      });
      for (std::size_t r = 0; r < found.size(); ++r) {
        CHECK(found[r] == expected);
        CHECK(reach_alike[r]);
      }
    }
  }
}

TEST_CASE("all ranks hear if what one of them sums is not good, and if one of them wishes the end") {
  const Cells all(1);
  std::vector<char> good(3), bad(3), wish(3);
  as_ranks(3, [&](const Ranks& ranks) {
    std::vector<int> mine;
    std::vector<CellPlace> places;
    for (std::size_t k = static_cast<std::size_t>(ranks.rank()); k < all.places.size(); k += 3) {
      places.push_back(all.places[k]);
      for (std::size_t a = 0; a < per_cell; ++a) mine.push_back(all.function_of_corner[per_cell * k + a]);
    }
    CornerSum corner_sum;
    corner_sum.rebuild(mine, functions, &ranks, places);
    const auto r = static_cast<std::size_t>(ranks.rank());
    std::vector<double> sums(functions);
    good[r] = corner_sum.complete(sums.data(), 1);
    bad[r] = corner_sum.complete(sums.data(), 1, r != 1);
    wish[r] = ranks.someone_wishes_end();
    if (r == 2) ranks.wish_for_end();
    corner_sum.complete(sums.data(), 1);
    wish[r] = wish[r] == 0 && ranks.someone_wishes_end();
  });
  for (std::size_t r = 0; r < 3; ++r) {
    CHECK(good[r]);
    CHECK_FALSE(bad[r]);
    CHECK(wish[r]);
  }
}
