// What ranks tell each other.
#include "parallel/of_all.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "thread_ranks.hpp"

using namespace stillpoint;
using test::as_ranks;

TEST_CASE("a sum over ranks has the same bits however its terms are divided among them") {
  std::mt19937_64 random(3);
  std::vector<double> terms(1000);
  for (double& term : terms)
    term = std::ldexp(std::uniform_real_distribution<double>(-1, 1)(random), static_cast<int>(random() % 80));
  const double alone = sum_over_ranks(nullptr, terms.size(), [&](std::size_t k) { return terms[k]; });
  for (const int count : {1, 2, 3, 7}) {
    const auto n = static_cast<std::size_t>(count);
    // One term in so many, or one range of them after the other.
    for (const bool by_ranges : {false, true}) {
      std::vector<double> sums(n);
      as_ranks(count, [&](const Ranks& ranks) {
        const auto r = static_cast<std::size_t>(ranks.rank());
        std::vector<double> mine;
        for (std::size_t k = 0; k < terms.size(); ++k)
          if ((by_ranges ? k * n / terms.size() : k % n) == r) mine.push_back(terms[k]);
        sums[r] = sum_over_ranks(&ranks, mine.size(), [&](std::size_t k) { return mine[k]; });
      });
      for (const double sum : sums) CHECK(sum == alone);
    }
  }
}

TEST_CASE("the largest value of all ranks is NaN if one of them is") {
  std::vector<double> found(3), with_nan(3);
  as_ranks(3, [&](const Ranks& ranks) {
    const auto r = static_cast<std::size_t>(ranks.rank());
    found[r] = largest_of_all(&ranks, r == 1 ? 7.0 : -2.0);
    with_nan[r] = largest_of_all(&ranks, r == 0 ? std::numeric_limits<double>::quiet_NaN() : 5.0);
  });
  for (std::size_t r = 0; r < 3; ++r) {
    CHECK(found[r] == 7);
    CHECK(std::isnan(with_nan[r]));
  }
}

TEST_CASE(
    "lists of ranks are joined in their order, empty ones too, and the first text that says something is told to all") {
  std::vector<std::vector<int>> lists(4);
  std::vector<std::string> texts(4);
  std::vector<char> any(4), all(4);
  as_ranks(4, [&](const Ranks& ranks) {
    const auto r = static_cast<std::size_t>(ranks.rank());
    lists[r] = joined_lists(&ranks, std::vector<int>(r % 3, ranks.rank()));
    texts[r] = first_text(&ranks, r < 2 ? "" : "rank " + std::to_string(r));
    any[r] = is_so_for_any(&ranks, r == 2);
    all[r] = is_so_for_all(&ranks, r != 2);
  });
  for (std::size_t r = 0; r < 4; ++r) {
    CHECK(lists[r] == std::vector<int>{1, 2, 2});
    CHECK(texts[r] == "rank 2");
    CHECK(any[r]);
    CHECK_FALSE(all[r]);
  }
}
