#include "linalg/multigrid.hpp"

#include <stillpoint/vector.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "largest.hpp"
#include "linalg/krylov.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;

namespace {

struct Body {
  SparseMatrix K;
  NodalLayout layout;
  std::vector<double> load;
};

/// Bilinear cells, the base held in both directions and both sides on rollers, so that some nodes keep one component.
Body block(int cells, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all = {"constants.nu=0.3", "grid.basis=linear",
                                  "grid.cells=[" + std::to_string(cells) + "," + std::to_string(cells) + "]"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  const auto phase = make_phase(scenes::load("incompressible", all));
  Body body{phase->tangents().matrix(Tangent::elastic, 0, std::vector<double>(phase->size())), phase->shape().layout(),
            std::vector<double>(phase->size())};
  phase->external_force(0, std::vector<double>(phase->size()), body.load);
  return body;
}

int iterations(const Body& body, const Multigrid& cycle) {
  const LinearMap K = [&](ConstVec x, Vec Kx) {
    const auto n = static_cast<Eigen::Index>(x.size());
    Eigen::Map<Eigen::VectorXd>(Kx.data(), n) = body.K * Eigen::Map<const Eigen::VectorXd>(x.data(), n);
  };
  std::vector<double> u(body.load.size());
  const auto result = conjugate_gradients(
      K, [&](ConstVec b, Vec x) { cycle.apply(b, x); }, body.load, u, 1e-6, 200);
  return result.converged ? result.iterations : 1000;
}

std::vector<double> wave(std::size_t n, double k) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = std::sin(k * static_cast<double>(i * i % 977));
  return x;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Whether there is none to test, as the program was built.
bool is_missing() {
  CHECK(multigrid_is_missing().empty() == STILLPOINT_HAS_MULTIGRID);
  return !multigrid_is_missing().empty();
}

}  // namespace

TEST_CASE("there is multigrid where PETSc was found, and elsewhere a refusal with the package to install") {
  if (is_missing()) {
    CHECK_THAT(multigrid_is_missing(), Catch::Matchers::Contains("libpetsc-real-dev"));
    CHECK_THROWS_AS(make_multigrid(SparseMatrix(1, 1), {}), std::runtime_error);
  }
}

TEST_CASE("a cycle is symmetric and positive definite, and spectrally as good as K itself") {
  if (is_missing()) return;
  const Body body = block(12);
  const auto cycle = make_multigrid(body.K, body.layout);
  const std::size_t n = body.load.size();
  Eigen::MatrixXd B(n, n);
  std::vector<double> unit(n), column(n);
  for (std::size_t k = 0; k < n; ++k) {
    unit[k] = 1;
    cycle->apply(unit, column);
    unit[k] = 0;
    B.col(static_cast<Eigen::Index>(k)) = Eigen::Map<const Eigen::VectorXd>(column.data(), B.rows());
  }
  CHECK((B - B.transpose()).norm() < 1e-12 * B.norm());
  // λ(BK) by the symmetric eigenproblem K x = λ B⁻¹ x, dense.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ends(Eigen::MatrixXd(body.K), B.inverse());
  CHECK(ends.eigenvalues().minCoeff() > 0.1);
  CHECK(ends.eigenvalues().maxCoeff() < 1.5);
}

TEST_CASE("iterations with a cycle do not grow with the unknowns: 15 are enough for 1e3, 1e4 and 1e5") {
  if (is_missing()) return;
  for (const int cells : {22, 70, 224}) {
    const Body body = block(cells);
    CAPTURE(body.load.size());
    const auto cycle = make_multigrid(body.K, body.layout);
    CHECK(cycle->levels() > 1);
    CHECK(cycle->bytes() > 12 * static_cast<std::size_t>(body.K.nonZeros()));
    CHECK(iterations(body, *cycle) <= 15);
  }
}

TEST_CASE("a cycle gives the same bits each time, in place as well, and is linear") {
  if (is_missing()) return;
  const Body body = block(30);
  const auto cycle = make_multigrid(body.K, body.layout), other = make_multigrid(body.K, body.layout);
  const std::size_t n = body.load.size();
  const std::vector<double> a = wave(n, 0.3), b = wave(n, 0.7);
  std::vector<double> Ba(n), Bb(n), again(n), in_place = a, sum(n), B_sum(n);
  cycle->apply(a, Ba);
  cycle->apply(b, Bb);
  cycle->apply(in_place, in_place);
  other->apply(a, again);
  CHECK(in_place == Ba);
  CHECK(again == Ba);
  for (std::size_t i = 0; i < n; ++i) sum[i] = a[i] - 2 * b[i];
  cycle->apply(sum, B_sum);
  for (std::size_t i = 0; i < n; ++i) sum[i] = Ba[i] - 2 * Bb[i];
  CHECK(largest_difference(B_sum, sum) < 1e-11 * largest_magnitude(sum));
  CHECK(std::abs(product(a, Bb) - product(b, Ba)) < 1e-10 * product(a, Ba));
}
