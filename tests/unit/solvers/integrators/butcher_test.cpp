#include "solvers/integrators/butcher.hpp"

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

struct OrderCondition {
  int order;
  double residual;
};

// Σ_i b_i Φ_i − 1/γ for the eight rooted trees of order ≤ 4 [Hairer, Nørsett & Wanner, Solving ODEs I, table II.2.1].
std::vector<OrderCondition> order_conditions(const ButcherTable& table, const std::vector<double>& b) {
  const std::size_t s = b.size();
  std::vector<double> Ac(s), Acc(s), AAc(s);
  const auto multiply = [&](auto&& x, std::vector<double>& y) {
    for (std::size_t i = 0; i < s; ++i) {
      for (std::size_t j = 0; j < s; ++j) y[i] += table.A[i * s + j] * x(j);
    }
  };
  const std::vector<double>& c = table.c;
  multiply([&](std::size_t j) { return c[j]; }, Ac);
  multiply([&](std::size_t j) { return c[j] * c[j]; }, Acc);
  multiply([&](std::size_t j) { return Ac[j]; }, AAc);
  const auto sum = [&](auto&& phi) {
    double total = 0;
    for (std::size_t i = 0; i < s; ++i) total += b[i] * phi(i);
    return total;
  };
  return {{1, sum([](std::size_t) { return 1.0; }) - 1},
          {2, sum([&](std::size_t i) { return c[i]; }) - 1. / 2},
          {3, sum([&](std::size_t i) { return c[i] * c[i]; }) - 1. / 3},
          {3, sum([&](std::size_t i) { return Ac[i]; }) - 1. / 6},
          {4, sum([&](std::size_t i) { return c[i] * c[i] * c[i]; }) - 1. / 4},
          {4, sum([&](std::size_t i) { return c[i] * Ac[i]; }) - 1. / 8},
          {4, sum([&](std::size_t i) { return Acc[i]; }) - 1. / 12},
          {4, sum([&](std::size_t i) { return AAc[i]; }) - 1. / 24}};
}

// The largest order, at most 4, up to which every condition holds.
int order_of(const ButcherTable& table, const std::vector<double>& b) {
  int order = 4;
  for (const OrderCondition& condition : order_conditions(table, b)) {
    if (!(std::abs(condition.residual) <= 1e-14)) order = std::min(order, condition.order - 1);
  }
  return order;
}

const ButcherTable heun_euler = {"Heun-Euler", 2, 2, 1, {0, 0, 1, 0}, {0.5, 0.5}, {0, 1}, {1, 0}};

}  // namespace

TEST_CASE("the custom Butcher tables have the orders that they claim, embedding included") {
  for (const ButcherTable& table : {classical_rk4(), sofroniou_spaletta_5_3_4(), jameson_5()}) {
    INFO(table.name);
    CHECK(order_of(table, table.b) == table.order);
    if (!table.b_embedded.empty()) CHECK(order_of(table, table.b_embedded) == table.embedded_order);
  }
  CHECK(sofroniou_spaletta_5_3_4().embedded_order == 3);
}

TEST_CASE("the custom Butcher tables are explicit and their nodes are the row sums") {
  for (const ButcherTable& table : {classical_rk4(), sofroniou_spaletta_5_3_4(), jameson_5()}) {
    INFO(table.name);
    REQUIRE(table.A.size() == table.b.size() * table.b.size());
    REQUIRE(table.c.size() == table.b.size());
    for (int i = 0; i < table.stages; ++i) {
      double sum = 0;
      for (int j = 0; j < table.stages; ++j) {
        sum += table.a(i, j);
        if (j >= i) CHECK(table.a(i, j) == 0);
      }
      CHECK(table.c[static_cast<std::size_t>(i)] == Approx(sum).margin(1e-15));
    }
  }
}

TEST_CASE("a last node of 1 alone does not make a table first same as last") {
  CHECK(first_same_as_last(sofroniou_spaletta_5_3_4()));
  CHECK_FALSE(first_same_as_last(classical_rk4()));  // c_4 = 1, but the last row is not b
  CHECK_FALSE(first_same_as_last(heun_euler));
  CHECK_FALSE(first_same_as_last(jameson_5()));
  ButcherTable other_row = sofroniou_spaletta_5_3_4();  // c_5 = 1 and b_5 = 0, but another last row
  other_row.A[20] += 0.1;
  other_row.A[21] -= 0.1;
  CHECK_FALSE(first_same_as_last(other_row));
  CHECK(effective_stages(sofroniou_spaletta_5_3_4()) == 4);
  CHECK(effective_stages(classical_rk4()) == 4);
  CHECK(effective_stages(jameson_5()) == 5);
}

TEST_CASE("the amplification equals the spectral radius of one step of the damped oscillator") {
  // One step by the stages themselves, on both unit vectors; the 2 × 2 map's eigenvalues from its trace and
  // determinant.
  const auto step = [](const ButcherTable& table, double h, double omega, double rate, double u, double v) {
    const auto s = static_cast<std::size_t>(table.stages);
    std::vector<double> du(s), dv(s);
    for (std::size_t i = 0; i < s; ++i) {
      double U = u, V = v;
      for (std::size_t j = 0; j < i; ++j) U += h * table.A[i * s + j] * du[j], V += h * table.A[i * s + j] * dv[j];
      du[i] = V;
      dv[i] = -omega * omega * U - rate * V;
    }
    for (std::size_t i = 0; i < s; ++i) u += h * table.b[i] * du[i], v += h * table.b[i] * dv[i];
    return std::pair(u, v);
  };
  for (const ButcherTable& table : {classical_rk4(), sofroniou_spaletta_5_3_4(), jameson_5(), heun_euler}) {
    const AmplificationRadius amplification = amplification_of(table);
    for (const double rate : {0.0, 0.3, 4.0, 9.0}) {  // overdamped above 4
      const double h = 0.7, omega = 2;
      const auto [a, c] = step(table, h, omega, rate, 1, 0);
      const auto [b, d] = step(table, h, omega, rate, 0, 1);
      const double mean = (a + d) / 2, determinant = a * d - b * c, discriminant = mean * mean - determinant;
      const double radius =
          discriminant < 0 ? std::sqrt(determinant) : std::abs(mean) + std::sqrt(std::max(discriminant, 0.0));
      INFO(table.name << ", rate " << rate);
      CHECK(amplification(h, omega, rate) == Approx(radius).epsilon(rate == 4 ? 1e-7 : 1e-12));  // a double root at 4
    }
  }
}

TEST_CASE("a mode without stiffness or damping is carried unchanged") {
  CHECK(amplification_of(classical_rk4())(0.1, 0, 0) == 1);
  CHECK(amplification_of(classical_rk4())(0.1, 0, 3) == 1);  // λ = 0 and −3
}
