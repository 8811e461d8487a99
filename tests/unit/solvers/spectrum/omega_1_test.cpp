// omega_1 where K is nearly singular, singular or indefinite, and where modes lie close.
#include <stillpoint/spectrum.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "solvers/spectrum/frequencies.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

TEST_CASE("a body that is not held has a singular K and no omega_1") {
  for (const bool consistent : {false, true}) {
    for (const double stiffness : {1.0, 0.1, 3.7e9}) {
      for (const std::size_t n : {1u, 2u, 7u, 400u}) {
        const Chain chain({.n = n, .stiffness = stiffness, .left_held = false, .consistent = consistent});
        for (const auto method : {omega_1_by_lanczos, omega_1_by_arpack}) {
          const FrequencyEstimate estimate = method(chain, 0, at_rest(chain), SpectrumOptions{});
          INFO("n = " << n << ", k = " << stiffness << ": " << estimate.status);
          CHECK_FALSE(estimate.converged);
          CHECK(estimate.omega == 0);
          CHECK(estimate.status == "K is singular: the body is not held, or has too few material points for its basis");
        }
      }
    }
  }
}

TEST_CASE("a free body is found out although rounding lets the factorisation of its K go through") {
  // Unequal springs, so that the zero pivot comes out as a small number of either sign.
  for (std::size_t n = 2; n <= 60; ++n) {
    const Chain chain({.n = n, .cubic = 1, .left_held = false});
    std::vector<double> u;
    for (std::size_t i = 0; i < n; ++i) u.push_back(std::sin(17.0 * static_cast<double>(i * i)));
    for (const auto method : {omega_1_by_lanczos, omega_1_by_arpack}) {
      INFO("n = " << n);
      CHECK(method(chain, 0, u, SpectrumOptions{}).status ==
            "K is singular: the body is not held, or has too few material points for its basis");
    }
  }
}

TEST_CASE("a body that softens is told from one that is not held") {
  const Chain chain({.n = 5, .cubic = -10});  // k + 3 k₃ e² < 0 for e > 0.18
  const std::vector<double> u = {0.3, 0.3, 0.3, 0.3, 0.3};
  for (const auto method : {omega_1_by_lanczos, omega_1_by_arpack}) {
    CHECK_THAT(method(chain, 0, u, SpectrumOptions{}).status, Contains("indefinite"));
  }
}

TEST_CASE("omega_1 is found where rounding moves the Rayleigh quotient by more than the tolerance") {
  // A beam on two supports, K = T² with T = tridiag(−1, 2, −1): ω_k = 4 sin²(kπ/(2n + 2)), κ = 6e9.
  constexpr int n = 400;
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    T(i, i) = 2;
    if (i > 0) T(i, i - 1) = T(i - 1, i) = -1;
  }
  const PlainSystem beam(T * T, Eigen::MatrixXd::Identity(n, n));
  const double exact = 4 * std::pow(std::sin(std::numbers::pi / (2 * (n + 1))), 2);
  for (const auto method : {omega_1_by_lanczos, omega_1_by_arpack}) {
    const FrequencyEstimate estimate = method(beam, 0, std::vector<double>(n, 0.0), SpectrumOptions{});
    INFO(estimate.status);
    REQUIRE(estimate.converged);
    CHECK(estimate.omega == Approx(exact).epsilon(1e-5));
    CHECK(estimate.iterations < 200);
  }
}

TEST_CASE("omega_1 is found beside a second mode of nearly the same frequency") {
  const PlainSystem pair(Eigen::Vector4d(1, 1 + 1e-5, 5, 7).asDiagonal().toDenseMatrix(), Eigen::Matrix4d::Identity());
  const FrequencyEstimate estimate = omega_1_by_lanczos(pair, 0, std::vector<double>(4, 0.0));
  INFO(estimate.status);
  REQUIRE(estimate.converged);
  CHECK(estimate.omega == near(1));
}

TEST_CASE("omega_1 takes a third of the solutions of inverse iteration where modes lie close") {
  // Modes ω² = 1, 1.3, 1.6, …: inverse iteration gains 1.3² in a step, and needs some 45 to 1e-10.
  constexpr int n = 200;
  Eigen::VectorXd squares(n);
  for (int k = 0; k < n; ++k) squares[k] = 1 + 0.3 * k;
  const PlainSystem system(squares.asDiagonal().toDenseMatrix(), Eigen::MatrixXd::Identity(n, n));
  const FrequencyEstimate estimate = omega_1_by_lanczos(system, 0, std::vector<double>(n, 0.0));
  INFO(estimate.status);
  REQUIRE(estimate.converged);
  CHECK(estimate.iterations <= 15);
  CHECK(std::pow(estimate.omega, 2) == Approx(1).epsilon(1e-10));
  REQUIRE(estimate.mode.size() == n);
  for (std::size_t k = 1; k < n; ++k) CHECK(std::abs(estimate.mode[k]) < 1e-4 * std::abs(estimate.mode[0]));
}

TEST_CASE("a very long held chain is not taken for a free one") {
  const Chain chain({.n = 20000});
  const FrequencyEstimate estimate = omega_1_by_lanczos(chain, 0, at_rest(chain));
  CHECK(estimate.converged);
  CHECK(estimate.omega == Approx(chain.exact_omega(1)).epsilon(1e-6));
}
