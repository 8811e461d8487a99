// The return of principal stresses to Mohr–Coulomb's pyramid, beside one that tries every set of active planes.
#include <stillpoint/mohr_coulomb_return.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "law_checks.hpp"

namespace stillpoint {
namespace {

using checks::one_degree;
using Eigen::Matrix3d, Eigen::Vector3d;

constexpr IsotropicModuli elastic_moduli{2e7, 1e7};

struct Plane {
  Vector3d normal, flow;
  double limit;  // normal·σ ≤ limit
};

// The six faces of the pyramid and the three of the cut-off, for principal stresses in any order.
std::vector<Plane> planes(double sin_phi, double sin_psi, double k, double tension) {
  std::vector<Plane> all;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      if (a == b) continue;
      all.push_back({Vector3d::Unit(a) * (1 + sin_phi) - Vector3d::Unit(b) * (1 - sin_phi),
                     Vector3d::Unit(a) * (1 + sin_psi) - Vector3d::Unit(b) * (1 - sin_psi), 2 * k});
    }
    if (std::isfinite(tension)) all.push_back({Vector3d::Unit(a), Vector3d::Unit(a), tension});
  }
  return all;
}

// Koiter: σ = x − C Σ Δγ_k n_k with Δγ_k ≥ 0, f_k = 0 for the active planes and f ≤ 0 for all.
std::optional<Vector3d> with_active(const std::vector<Plane>& all, const std::vector<std::size_t>& active,
                                    const Vector3d& x, double scale) {
  const double lambda = elastic_moduli.bulk - 2 * elastic_moduli.shear / 3;
  const Matrix3d C = lambda * Matrix3d::Ones() + 2 * elastic_moduli.shear * Matrix3d::Identity();
  const auto n = static_cast<Eigen::Index>(active.size());
  Eigen::MatrixXd A(n, n);
  Eigen::VectorXd f(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Plane& plane = all[active[static_cast<std::size_t>(i)]];
    f[i] = plane.normal.dot(x) - plane.limit;
    for (Eigen::Index j = 0; j < n; ++j) A(i, j) = plane.normal.dot(C * all[active[static_cast<std::size_t>(j)]].flow);
  }
  Vector3d sigma = x;
  if (n > 0) {
    const Eigen::FullPivLU<Eigen::MatrixXd> factors(A);
    if (!factors.isInvertible()) return std::nullopt;
    const Eigen::VectorXd multipliers = factors.solve(f);
    if (multipliers.minCoeff() < -1e-12 * scale / elastic_moduli.shear) return std::nullopt;
    for (Eigen::Index i = 0; i < n; ++i) sigma -= multipliers[i] * (C * all[active[static_cast<std::size_t>(i)]].flow);
  }
  for (const Plane& plane : all)
    if (plane.normal.dot(sigma) - plane.limit > 1e-9 * scale) return std::nullopt;
  return sigma;
}

Vector3d by_enumeration(const std::vector<Plane>& all, const Vector3d& x, double scale) {
  if (const auto found = with_active(all, {}, x, scale)) return *found;
  for (std::size_t a = 0; a < all.size(); ++a)
    if (const auto found = with_active(all, {a}, x, scale)) return *found;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b)
      if (const auto found = with_active(all, {a, b}, x, scale)) return *found;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b)
      for (std::size_t c = b + 1; c < all.size(); ++c)
        if (const auto found = with_active(all, {a, b, c}, x, scale)) return *found;
  return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

struct Soil {
  double c, phi, psi, tension;
};
constexpr double none = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE(
    "a return to Mohr-Coulomb's pyramid is Koiter's on faces, edges, the apex and the cut-off's planes and corners") {
  const auto [c, phi, psi, tension] = GENERATE(
      Soil{1e4, 30, 30, none}, Soil{1e4, 30, 0, none}, Soil{1e4, 35, 10, none}, Soil{0, 35, 0, none},
      Soil{0, 30, 30, none}, Soil{1e4, 0, 0, none}, Soil{1e4, 0, 0, 5e3}, Soil{1e4, 0, 0, 0}, Soil{1e4, 30, 30, 5e3},
      Soil{1e4, 30, 5, 0}, Soil{1e4, 30, 0, 1.5e4}, Soil{1e4, 60, 20, 2e3}, Soil{1e4, 1, 1, 1e5});
  const double sin_phi = std::sin(phi * one_degree), sin_psi = std::sin(psi * one_degree),
               k = c * std::cos(phi * one_degree);
  const MohrCoulombStrength strength = MohrCoulombStrength::from(sin_phi, sin_psi, k, tension);
  const double cut = phi == 0 ? tension : strength.tension;
  const std::vector<Plane> all = planes(sin_phi, sin_psi, k, cut);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> stress(-6e4, 6e4);
  int compared = 0;
  for (int n = 0; n < 400; ++n) {
    Vector3d x{stress(random), stress(random), stress(random)};
    if (n % 5 == 0) x[1] = x[0];  // equal ones, which a triaxial test has
    std::sort(x.data(), x.data() + 3, std::greater<>());
    const Principal<double> found = returned(Principal<double>{x[0], x[1], x[2]}, strength, elastic_moduli);
    const Vector3d right = by_enumeration(all, x, 6e4);
    CAPTURE(c, phi, psi, tension, x.transpose(), right.transpose(), found[0], found[1], found[2]);
    REQUIRE(right.allFinite());
    for (int a = 0; a < 3; ++a) REQUIRE(std::abs(found[a] - right[a]) <= 1e-10 * 6e4);
    ++compared;
  }
  CHECK(compared == 400);
}

}  // namespace stillpoint
