#include "space/points/moment_fit.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "largest.hpp"

using namespace stillpoint;

namespace {

Eigen::MatrixXd row(std::initializer_list<double> places) {
  Eigen::MatrixXd xi(1, static_cast<Eigen::Index>(places.size()));
  std::copy(places.begin(), places.end(), xi.data());
  return xi;
}

// Mean of x^k over [−1, 1].
double mean_of_power(int k) { return k % 2 == 1 ? 0.0 : 1.0 / (k + 1); }

}  // namespace

TEST_CASE("three evenly spread points get the shares 3/8, 1/4, 3/8 [Więckowski 2011, section 3.1]") {
  const MomentFit fit = fit_moments(row({-2.0 / 3, 0, 2.0 / 3}));
  CHECK(fit.weights(0) == Approx(3.0 / 8).epsilon(1e-13));
  CHECK(fit.weights(1) == Approx(1.0 / 4).epsilon(1e-13));
  CHECK(fit.weights(2) == Approx(3.0 / 8).epsilon(1e-13));
  CHECK(fit.degree == 3);  // 2, and 3 by symmetry
  CHECK_FALSE(fit.limited_by_sign);
}

TEST_CASE("points at Gauss places get the Gauss weights and their degree 2n - 1") {
  const double g = std::sqrt(3.0 / 5);
  const MomentFit fit = fit_moments(row({-g, 0, g}));
  CHECK(fit.weights(0) == Approx(5.0 / 18).epsilon(1e-12));
  CHECK(fit.weights(1) == Approx(8.0 / 18).epsilon(1e-12));
  CHECK(fit.degree == 5);
}

TEST_CASE("one point off the middle of a cell can carry constants only") {
  const MomentFit fit = fit_moments(row({0.3}));
  CHECK(fit.weights(0) == 1);
  CHECK(fit.degree == 0);
}

TEST_CASE("where only negative weights fit, the degree is lowered and it is said so") {
  // All points right of the middle: Σ w x = 0 needs a negative weight.
  const MomentFit fit = fit_moments(row({0.2, 0.5, 0.9}));
  CHECK(fit.degree == 0);
  CHECK(fit.limited_by_sign);
  CHECK(smallest_value(fit.weights) >= 0);
}

TEST_CASE("a fit whose nearest weights are negative is mended where non-negative ones exist") {
  // Crowded on the right: the fit nearest to equal weights is negative there, though others serve.
  const Eigen::MatrixXd xi = row({-0.1, 0.7, 0.8, 0.85, 0.9, 0.95});
  const MomentFit fit = fit_moments(xi);
  CHECK(fit.degree >= 1);
  CHECK(smallest_value(fit.weights) >= 0);
  CHECK(fit.weights.sum() == Approx(1).epsilon(1e-12));
  CHECK(xi.row(0).dot(fit.weights) == Approx(0).margin(1e-12));
}

TEST_CASE("random cells: the weights are not negative and integrate every polynomial up to the degree claimed") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  for (const int dim : {1, 2, 3}) {
    for (int n = 1; n <= 12; ++n) {
      Eigen::MatrixXd xi(dim, n);
      for (double& x : xi.reshaped()) x = place(random);
      const MomentFit fit = fit_moments(xi);
      CAPTURE(dim, n, fit.degree);
      CHECK(smallest_value(fit.weights) >= 0);
      for (int k = 0; k <= fit.degree; ++k) {
        for (int d = 0; d < dim; ++d) {
          CHECK(xi.row(d).array().pow(k).matrix().dot(fit.weights) == Approx(mean_of_power(k)).margin(1e-10));
        }
      }
      if (dim > 1 && fit.degree >= 1) {
        CHECK((xi.row(0).array() * xi.row(1).array()).matrix().dot(fit.weights) == Approx(0).margin(1e-10));
      }
    }
  }
}

TEST_CASE("a 3 by 3 raster gets the product of the weights of its rows") {
  Eigen::MatrixXd xi(2, 9);
  for (int p = 0; p < 9; ++p) xi.col(p) << (p % 3 - 1) * 2.0 / 3, (p / 3 - 1) * 2.0 / 3;
  const MomentFit fit = fit_moments(xi);
  const double share[3] = {3.0 / 8, 1.0 / 4, 3.0 / 8};
  for (int p = 0; p < 9; ++p) CHECK(fit.weights(p) == Approx(share[p % 3] * share[p / 3]).epsilon(1e-12));
  CHECK(fit.degree == 3);
}

TEST_CASE("equal weights are credited with the degree that they integrate, no more") {
  CHECK(equal_weights(row({-2.0 / 3, 0, 2.0 / 3})).degree == 1);
  const double g = 1 / std::sqrt(3.0);
  CHECK(equal_weights(row({-g, g})).degree == 3);  // the two-point Gauss rule has equal weights
}
