#include <stillpoint/spectrum.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "chain.hpp"
#include "dense.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;
using stillpoint::test::Chain;
using stillpoint::test::ChainOptions;

namespace {

using FrequencyMethod = FrequencyEstimate (*)(const SemiDiscrete&, double, ConstVec, const SpectrumOptions&);

std::vector<double> at_rest(const Chain& chain) { return std::vector<double>(chain.size(), 0.0); }

// ω of K x = ω² M x in ascending order by Eigen's dense solver.
Eigen::VectorXd dense_frequencies(const Chain& chain, ConstVec u) {
  const SparseMatrix K = chain.tangents().matrix(Tangent::consistent, 0, u), M = chain.mass().matrix();
  return test::dense_eigenvalues(K, M).cwiseMax(0).cwiseSqrt();
}

std::vector<ChainOptions> held_chains() {
  std::vector<double> masses;
  for (int i = 0; i < 25; ++i) masses.push_back(1 + 0.9 * std::sin(7.0 * i));
  std::vector<ChainOptions> chains;
  for (const bool consistent : {false, true}) {
    for (const std::size_t n : {1u, 2u, 3u, 5u, 12u, 30u}) {
      chains.push_back({.n = n, .mass = 2, .stiffness = 3e6, .consistent = consistent});
    }
    chains.push_back({.n = 10, .right_held = true, .consistent = consistent});
    chains.push_back({.stiffness = 1e-3, .masses = masses, .consistent = consistent});
  }
  return chains;
}

Approx near(double value) { return Approx(value).epsilon(1e-8); }

}  // namespace

TEST_CASE("every method agrees with the dense solution to 1e-8 at its default options") {
  for (const ChainOptions& options : held_chains()) {
    const Chain chain(options);
    const std::vector<double> u = at_rest(chain);
    const Eigen::VectorXd omega = dense_frequencies(chain, u);
    const double lowest = omega[0], highest = omega[omega.size() - 1];
    INFO("n = " << chain.size() << (options.consistent ? ", consistent" : ", lumped"));
    const std::vector<std::pair<FrequencyMethod, double>> cases = {{omega_max_by_power_iteration, highest},
                                                                   {omega_1_by_lanczos, lowest},
                                                                   {omega_1_by_arpack, lowest},
                                                                   {omega_max_by_arpack, highest}};
    for (const auto& [method, expected] : cases) {
      const FrequencyEstimate estimate = method(chain, 0, u, SpectrumOptions{});
      INFO(estimate.status);
      CHECK(estimate.converged);
      CHECK(estimate.omega == near(expected));
      CHECK(estimate.iterations > 0);
      CHECK(estimate.wall_s >= 0);
      CHECK_FALSE(estimate.status.empty());
    }
  }
}

TEST_CASE("Lanczos' method with a tolerance is above omega_max by no more than that, or says that it is not there") {
  for (const ChainOptions& options : held_chains()) {
    const Chain chain(options);
    const std::vector<double> u = at_rest(chain);
    const double exact = dense_frequencies(chain, u).maxCoeff();
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      const FrequencyEstimate estimate = omega_max_by_lanczos(chain, 0, u, 400, tolerance);
      INFO("n = " << chain.size() << ", tolerance " << tolerance << ": " << estimate.status);
      CHECK(estimate.converged);
      CHECK(estimate.omega == Approx(exact).epsilon(1.01 * tolerance));
      CHECK(estimate.omega > exact * (1 - 1e-12));
    }
  }
  const Chain crowded({.n = 2000});  // whose highest frequencies are 1e-6 apart
  CHECK_FALSE(omega_max_by_lanczos(crowded, 0, at_rest(crowded), 40, 1e-7).converged);
  CHECK(omega_max_by_lanczos(crowded, 0, at_rest(crowded), 40).converged);
}

TEST_CASE("the frequencies of an equal chain are the exact ones") {
  const Chain chain({.n = 200, .mass = 0.5, .stiffness = 8});
  const std::vector<double> u = at_rest(chain);
  CHECK(omega_1_by_lanczos(chain, 0, u).omega == near(chain.exact_omega(1)));
  CHECK(omega_1_by_arpack(chain, 0, u).omega == near(chain.exact_omega(1)));
  CHECK(omega_max_by_arpack(chain, 0, u).omega == near(chain.exact_omega(200)));
}

TEST_CASE("frequencies belong to the tangent at u, not to the state at rest") {
  const Chain chain({.n = 6, .cubic = 5});
  const std::vector<double> u = {0.1, 0.4, 0.5, 1, 1.1, 2};
  const Eigen::VectorXd omega = dense_frequencies(chain, u);
  REQUIRE(omega[0] > 1.01 * dense_frequencies(chain, at_rest(chain))[0]);
  CHECK(omega_1_by_lanczos(chain, 0, u).omega == near(omega[0]));
  CHECK(omega_1_by_arpack(chain, 0, u).omega == near(omega[0]));
  CHECK(omega_max_by_power_iteration(chain, 0, u).omega == near(omega[5]));
  CHECK(omega_max_by_arpack(chain, 0, u).omega == near(omega[5]));
}

TEST_CASE("power iteration claims convergence only where its error is within the tolerance, however slow it is") {
  // The top of a long chain is crowded: the change of ω² in one iteration is far below the error that is left.
  for (const std::size_t n : {20u, 60u, 120u}) {
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      const Chain chain({.n = n});
      const FrequencyEstimate estimate =
          omega_max_by_power_iteration(chain, 0, at_rest(chain), {.tolerance = tolerance, .max_iterations = 100000});
      INFO("n = " << n << ", tolerance " << tolerance << ": " << estimate.status);
      REQUIRE(estimate.converged);
      CHECK(estimate.omega <= chain.exact_omega(n) * (1 + 1e-14));  // from below
      CHECK(1 - std::pow(estimate.omega / chain.exact_omega(n), 2) < tolerance);
    }
  }
}

TEST_CASE("a method that runs out of iterations says so") {
  const Chain chain({.n = 1000, .consistent = true});
  const SpectrumOptions few = {.tolerance = 1e-14, .max_iterations = 5};
  for (const auto method : {omega_max_by_power_iteration, omega_1_by_lanczos, omega_max_by_arpack}) {
    const FrequencyEstimate estimate = method(chain, 0, at_rest(chain), few);
    CHECK_FALSE(estimate.converged);
    CHECK_THAT(estimate.status, Contains("> tolerance"));
  }
}

TEST_CASE("Gershgorin bounds omega_max from above, close by for an equal chain") {
  for (const ChainOptions& options : held_chains()) {
    const Chain chain(options);
    const Eigen::VectorXd omega = dense_frequencies(chain, at_rest(chain));
    const FrequencyEstimate bound = omega_max_bound_by_gershgorin(chain, 0, at_rest(chain));
    INFO("n = " << chain.size() << (options.consistent ? ", consistent: " : ", lumped: ") << bound.status);
    REQUIRE(bound.converged);
    CHECK(bound.omega >= omega[omega.size() - 1] * (1 - 1e-14));
    CHECK(bound.omega <= 1.8 * omega[omega.size() - 1]);
  }
  const Chain chain({.n = 30});
  CHECK(omega_max_bound_by_gershgorin(chain, 0, at_rest(chain)).omega == Approx(2));  // √4, exactly 2 sin(…) below
}

namespace {

// K = diag(1, k), M full: hats with few points, for which Gershgorin's lower circle of M is negative.
class PlainSystem : public Chain {
 public:
  PlainSystem(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M)
      : Chain({.n = static_cast<std::size_t>(K.rows())}), K_(K), M_(Mass::consistent(M.sparseView())) {}
  const Mass& mass() const override { return M_; }
  SparseMatrix matrix(Tangent, double, ConstVec) const override { return K_.sparseView(); }
  void apply(Tangent, double, ConstVec, ConstVec du, Vec dR) const override {
    const auto n = static_cast<Eigen::Index>(size());
    Eigen::Map<Eigen::VectorXd>(dR.data(), n) = K_ * Eigen::Map<const Eigen::VectorXd>(du.data(), n);
  }

 private:
  Eigen::MatrixXd K_;
  Mass M_;
};

}  // namespace

TEST_CASE("Gershgorin's bound holds where the circles of M reach below zero and a factor has to certify it") {
  Eigen::Matrix3d M, K;
  M << 2, 1.4, 0.9, 1.4, 2, 1.4, 0.9, 1.4, 2;
  K << 2, -1, 0, -1, 3, -1, 0, -1, 4;
  const PlainSystem system(K, M);
  const std::vector<double> u(3, 0.0);
  const double highest = std::sqrt(test::dense_eigenvalues(K, M).maxCoeff());
  const FrequencyEstimate bound = omega_max_bound_by_gershgorin(system, 0, u);
  REQUIRE(bound.converged);
  CHECK_THAT(bound.status, Contains("a factor of M"));
  CHECK(bound.omega >= highest);
  CHECK(bound.omega <= 1.5 * highest);
  CHECK(omega_max_by_arpack(system, 0, u).omega == near(highest));
}

TEST_CASE("Gershgorin's bound does not change with the units of a degree of freedom") {
  const auto bound_with = [](double s) {  // the second degree of freedom measured in units of 1/s
    Eigen::Matrix2d M, K;
    M << 2, 0.5 * s, 0.5 * s, s * s;
    K << 3, -s, -s, 5 * s * s;
    return omega_max_bound_by_gershgorin(PlainSystem(K, M), 0, std::vector<double>(2, 0.0)).omega;
  };
  CHECK(bound_with(1000) == Approx(bound_with(1)).epsilon(1e-6));
}

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

TEST_CASE("a free chain still has its omega_max") {
  const Chain chain({.n = 10, .left_held = false});
  const Eigen::VectorXd omega = dense_frequencies(chain, at_rest(chain));
  CHECK(omega_max_by_power_iteration(chain, 0, at_rest(chain)).omega == near(omega[9]));
  CHECK(omega_max_by_arpack(chain, 0, at_rest(chain)).omega == near(omega[9]));
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

TEST_CASE("Lanczos' method shows its mode, that of the lowest frequency") {
  const Chain chain({.n = 30});
  const std::vector<double> mode = omega_1_by_lanczos(chain, 0, at_rest(chain)).mode;
  REQUIRE(mode.size() == chain.size());
  for (std::size_t i = 0; i < mode.size(); ++i) {
    const double angle = std::numbers::pi / 2 * static_cast<double>(i + 1) / (static_cast<double>(mode.size()) + 0.5);
    CHECK(std::abs(mode[i] / mode.back()) ==
          Approx(std::sin(angle) / std::sin(std::numbers::pi / 2 * 30 / 30.5)).margin(1e-3));
  }
}

TEST_CASE("a very long held chain is not taken for a free one") {
  const Chain chain({.n = 20000});
  const FrequencyEstimate estimate = omega_1_by_lanczos(chain, 0, at_rest(chain));
  CHECK(estimate.converged);
  CHECK(estimate.omega == Approx(chain.exact_omega(1)).epsilon(1e-6));
}

TEST_CASE("a tangent that is not finite gives no frequency") {
  const Chain chain({.n = 5, .cubic = 1});
  const std::vector<double> u(5, std::numeric_limits<double>::quiet_NaN());
  for (const auto method : {omega_max_by_power_iteration, omega_1_by_lanczos, omega_1_by_arpack, omega_max_by_arpack}) {
    const FrequencyEstimate estimate = method(chain, 0, u, SpectrumOptions{});
    CHECK_FALSE(estimate.converged);
    CHECK(estimate.omega == 0);
    CHECK_THAT(estimate.status, Contains("not finite"));
  }
  CHECK_FALSE(omega_max_bound_by_gershgorin(chain, 0, u).converged);
}

TEST_CASE("frequencies are the same bits in every run") {
  const Chain chain({.n = 40, .consistent = true});
  for (const auto method : {omega_max_by_power_iteration, omega_1_by_lanczos, omega_1_by_arpack, omega_max_by_arpack}) {
    const SpectrumOptions options;
    CHECK(method(chain, 0, at_rest(chain), options).omega == method(chain, 0, at_rest(chain), options).omega);
  }
}

TEST_CASE("spectrum options out of range are refused by name") {
  CHECK(SpectrumOptions{}.validate().empty());
  CHECK_THAT((SpectrumOptions{.tolerance = 0}.validate()), Contains("tolerance"));
  CHECK_THAT((SpectrumOptions{.max_iterations = 0}.validate()), Contains("max_iterations"));
  const Chain chain;
  for (const auto method : {omega_max_by_power_iteration, omega_1_by_lanczos, omega_1_by_arpack}) {
    CHECK_THROWS_AS(method(chain, 0, at_rest(chain), {.tolerance = -1}), std::invalid_argument);
  }
}
