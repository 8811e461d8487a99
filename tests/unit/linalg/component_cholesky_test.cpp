#include "linalg/component_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "base/thread_team.hpp"

namespace stillpoint {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

// Chains of these lengths among n unknowns, in no order, and a few entries twice.
struct Chains {
  Chains(int n, const std::vector<int>& lengths) : A(Eigen::MatrixXd::Zero(n, n)) {
    std::vector<int> unknowns(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) unknowns[static_cast<std::size_t>(k)] = k;
    std::mt19937 engine(3);
    std::shuffle(unknowns.begin(), unknowns.end(), engine);
    auto next = unknowns.begin();
    for (const int length : lengths) {
      for (int k = 0; k < length; ++k, ++next) {
        add(*next, *next, 3 + 0.1 * k);
        if (k == 0) continue;
        for (int half = 0; half < 2; ++half) add(*next, *(next - 1), -0.5), add(*(next - 1), *next, -0.5);
      }
    }
  }
  void add(int i, int j, double value) {
    entries.emplace_back(i, j, value);
    A(i, j) += value;
  }

  Entries entries;
  Eigen::MatrixXd A;  // 0 where an unknown is in no chain
};

std::vector<double> numbered(std::size_t n) {
  std::vector<double> b(n);
  for (std::size_t k = 0; k < n; ++k) b[k] = std::sin(1.0 + static_cast<double>(k));
  return b;
}

TEST_CASE("systems of components, a few unknowns each or hundreds, are solved as the whole is") {
  const std::vector<int> lengths =
      GENERATE(std::vector{1, 2, 3, 8}, std::vector{64, 65, 3}, std::vector{300, 1, 1, 200});
  const Chains chains(600, lengths);
  const ComponentCholesky factor(chains.entries, 600);
  REQUIRE(factor.positive_definite());
  const std::size_t n = factor.unknowns().size();
  REQUIRE(n == static_cast<std::size_t>((chains.A.diagonal().array() != 0).count()));
  const std::vector<double> b = numbered(n);
  std::vector<double> x = b;
  factor.solve(x, x);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(600), expected = all;
  for (std::size_t k = 0; k < n; ++k) all[factor.unknowns()[k]] = x[k], expected[factor.unknowns()[k]] = b[k];
  CHECK((chains.A * all - expected).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("components are solved with the same bits on any number of threads") {
  const Chains chains(9000, std::vector<int>(3000, 3));
  const ComponentCholesky factor(chains.entries, 9000);
  const auto solved = [&](int threads) {
    const ThreadScope scope(threads);
    std::vector<double> x = numbered(9000);
    factor.solve(x, x);
    return x;
  };
  const std::vector<double> alone = solved(1);
  CHECK(std::isfinite(alone[0] + alone[8999]));
  CHECK(solved(2) == alone);
  CHECK(solved(3) == alone);
}

TEST_CASE("a component that is not positive definite, or singular to rounding, is found among others") {
  for (const double last : {1.0, 1.0 - 1e-10, 1.0 + 1e-17, std::nan("")}) {
    for (const int wide : {0, 100}) {
      Entries entries = Chains(120, wide > 0 ? std::vector{2, wide} : std::vector{2}).entries;
      // [[1, 1], [1, last]] beside them
      entries.emplace_back(200, 200, 1), entries.emplace_back(201, 201, last);
      entries.emplace_back(200, 201, 1), entries.emplace_back(201, 200, 1);
      CHECK_FALSE(ComponentCholesky(entries, 202).positive_definite());
      entries.emplace_back(201, 201, 1e-6);
      CHECK(ComponentCholesky(entries, 202).positive_definite() == !std::isnan(last));
    }
  }
  CHECK(ComponentCholesky(Entries{}, 3).positive_definite());
  CHECK(ComponentCholesky(Entries{}, 3).unknowns().empty());
}

}  // namespace
}  // namespace stillpoint
