#include "linalg/lanczos.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "linalg/krylov.hpp"

using namespace stillpoint;

namespace {

// A of the eigenvalues lambda.
LinearMap diagonal_map(const std::vector<double>& lambda) {
  return [&lambda](ConstVec x, Vec y) {
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = lambda[i] * x[i];
  };
}

Lanczos begun(const LinearMap& A, const LinearMap& solve_B, std::size_t n) {
  Vector b = VectorSpace().make(n);
  for (std::size_t i = 0; i < n; ++i) b.span()[i] = 1 + static_cast<double>(i % 5);
  return Lanczos(A, solve_B, std::move(b));
}

}  // namespace

TEST_CASE("what Lanczos' method has not seen of its start is what conjugate gradients leave of it, step by step") {
  constexpr std::size_t n = 40;
  std::vector<double> lambda(n), b(n), x(n);
  for (std::size_t i = 0; i < n; ++i) lambda[i] = 1 + std::pow(static_cast<double>(i), 1.5);
  for (std::size_t i = 0; i < n; ++i) b[i] = 1 + static_cast<double>(i % 5);
  const LinearMap identity = [](ConstVec r, Vec z) { std::copy(r.begin(), r.end(), z.begin()); };
  double norm_of_b = 0;
  for (const double value : b) norm_of_b += value * value;
  norm_of_b = std::sqrt(norm_of_b);
  Lanczos lanczos = begun(diagonal_map(lambda), identity, n);
  int compared = 0;
  conjugate_gradients(diagonal_map(lambda), identity, b, x, 1e-2, 100, [&](double left) {
    REQUIRE(lanczos.step());
    CHECK(lanczos.residual() == Approx(left / norm_of_b).epsilon(1e-6));
    ++compared;
  });
  CHECK(compared > 5);  // later rounding takes the two apart
}

TEST_CASE("Lanczos' method finds no rest where A is not positive definite") {
  std::vector<double> lambda(20, 1.0);
  for (std::size_t i = 0; i < lambda.size(); ++i) lambda[i] = static_cast<double>(i) - 3;
  const LinearMap identity = [](ConstVec r, Vec z) { std::copy(r.begin(), r.end(), z.begin()); };
  Lanczos indefinite = begun(diagonal_map(lambda), identity, lambda.size());
  for (int step = 0; step < 15 && indefinite.step(); ++step) {
  }
  CHECK(indefinite.residual() == std::numeric_limits<double>::infinity());
}
