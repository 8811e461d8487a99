#include "solvers/spectrum/driven_mode.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

// Chains of springs that nothing holds, each of `length` masses: K has a zero for each.
SparseMatrix chains(int count, int length) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < count; ++c) {
    for (int s = 0; s + 1 < length; ++s) {
      const int i = c * length + s, j = i + 1;
      const double k = 1e3 * (1 + s);
      entries.emplace_back(i, i, k), entries.emplace_back(j, j, k);
      entries.emplace_back(i, j, -k), entries.emplace_back(j, i, -k);
    }
  }
  SparseMatrix K(count * length, count * length);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

std::vector<double> masses(int n) {
  std::vector<double> m;
  for (int i = 0; i < n; ++i) m.push_back(1 + 0.3 * (i % 4));
  return m;
}

}  // namespace

TEST_CASE("of several motions without stiffness the one is found that is the force's own share in them") {
  constexpr int count = 3, length = 7, n = count * length;
  const std::vector<double> m = masses(n);
  const Mass mass = Mass::lumped(m);
  std::vector<double> Q;
  for (int i = 0; i < n; ++i) Q.push_back(std::sin(1.0 + i * i));
  const DrivenMode mode = driven_mode(chains(count, length), mass, Q);
  REQUIRE(mode.found);
  // The projection of M⁻¹Q: each chain moves as a whole, with the mean acceleration of its forces.
  Eigen::VectorXd exact(n);
  for (int c = 0; c < count; ++c) {
    double force = 0, of_chain = 0;
    for (int i = 0; i < length; ++i) force += Q[c * length + i], of_chain += m[c * length + i];
    for (int i = 0; i < length; ++i) exact[c * length + i] = force / of_chain;
  }
  const Eigen::Map<const Eigen::VectorXd> diagonal(m.data(), n), force(Q.data(), n), x(mode.x.data(), n);
  exact /= std::sqrt(exact.cwiseAbs2().dot(diagonal));
  CHECK((x - exact).norm() < 1e-5);  // of a matrix whose condition number is 1e10
  CHECK(mode.share == Approx(exact.dot(force) / std::sqrt(force.cwiseAbs2().cwiseQuotient(diagonal).sum())));
}

TEST_CASE("a force that drives no motion without stiffness has a share of rounding") {
  constexpr int n = 12;
  std::vector<double> Q(n, 0.0);
  Q[0] = 1, Q[5] = -3, Q[11] = 2;
  const DrivenMode mode = driven_mode(chains(1, n), Mass::lumped(masses(n)), Q);
  CHECK(mode.share < 1e-9);
}

TEST_CASE("where every motion has its stiffness none is found, however soft, nor where one has a negative one") {
  constexpr int n = 12;
  const std::vector<double> Q(n, 1.0);
  SparseMatrix held = chains(1, n);
  held.coeffRef(0, 0) += 1e-5;
  CHECK_FALSE(driven_mode(held, Mass::lumped(masses(n)), Q).found);
  SparseMatrix unstable = chains(1, n);
  unstable.coeffRef(0, 0) -= 10;
  CHECK_FALSE(driven_mode(unstable, Mass::lumped(masses(n)), Q).found);
  SparseMatrix broken = chains(1, n);
  broken.coeffRef(0, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(driven_mode(broken, Mass::lumped(masses(n)), Q).found);
  CHECK_FALSE(driven_mode(held, Mass::lumped(masses(n)), std::vector<double>(n, 0.0)).found);
}
