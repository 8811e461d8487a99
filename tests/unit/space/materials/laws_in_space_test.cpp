// The laws of three dimensions against those of two, whose third direction is a principal one, and against Eigen.
#include <stillpoint/drucker_prager.hpp>
#include <stillpoint/hencky.hpp>
#include <stillpoint/linear_elastic.hpp>
#include <stillpoint/mohr_coulomb.hpp>
#include <stillpoint/neo_hookean.hpp>

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "largest.hpp"
#include "law_checks.hpp"
#include "space/materials/deformation.hpp"
#include "space/materials/eigen_tensors.hpp"

using namespace stillpoint;
using checks::lame, checks::minus, checks::young;
using test::matrix_of, test::tensor_of_matrix;
using enum StressState;

namespace {

struct ConeLaws {
  template <StressState S>
  using Law = DruckerPrager<S>;
  static constexpr DruckerPragerParameters soil = {
      .E = 1e7, .nu = 0.25, .phi = 30, .psi = 10, .c = 2e3, .tension = 1e3};
};
struct PyramidLaws {
  template <StressState S>
  using Law = MohrCoulomb<S>;
  static inline const MohrCoulombParameters soil = {.E = 1e7, .nu = 0.25, .c = 2e3, .phi = 30, .psi = 10};
};
const DruckerPragerParameters& cone_soil = ConeLaws::soil;

static_assert(HistoryLaw<DruckerPrager<space>> && ElasticLaw<Hencky<space>>);

/// The gradient of two dimensions in space, its axes x and y there called `first` and the one after it.
template <StressState S>
Gradient<space> raised(const Gradient<S>& H, int first) {
  const int x = first, y = (first + 1) % 3, z = (first + 2) % 3;
  Gradient<space> raised{};
  raised[3 * x + x] = H[0];
  raised[3 * x + y] = H[1];
  raised[3 * y + x] = H[2];
  raised[3 * y + y] = H[3];
  if constexpr (S == axisymmetric) raised[3 * z + z] = H[4];
  return raised;
}
/// xx, yy, zz, xy of two dimensions likewise.
template <StressState S>
Stress<space> raised_stress(const Stress<S>& s, int first) {
  const int x = first, y = (first + 1) % 3, z = (first + 2) % 3;
  Stress<space> raised{};
  raised[x] = s[0];
  raised[y] = s[1];
  raised[z] = s[2];
  raised[3 + first] = s[3];  // xy, yz or zx
  return raised;
}

/// Steps of a walk that strains, turns, yields and opens.
template <StressState S>
std::vector<Gradient<S>> walk(double size, int steps) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Gradient<S>> walk(static_cast<std::size_t>(steps));
  Gradient<S> H{};
  for (auto& to : walk) {
    for (double& h : H) h += uniform(random);
    to = H;
  }
  return walk;
}

}  // namespace

TEMPLATE_TEST_CASE("an elastic law in space gives what it gives in the plane and around an axis, along any two axes",
                   "", (std::pair<LinearElastic<space>, LinearElastic<plane_strain>>),
                   (std::pair<LinearElastic<space>, LinearElastic<axisymmetric>>),
                   (std::pair<NeoHookean<space>, NeoHookean<plane_strain>>),
                   (std::pair<NeoHookean<space>, NeoHookean<axisymmetric>>),
                   (std::pair<Hencky<space>, Hencky<plane_strain>>), (std::pair<Hencky<space>, Hencky<axisymmetric>>)) {
  using Flat = typename TestType::second_type;
  constexpr StressState S = Flat::state;
  const typename TestType::first_type law(lame);
  const Flat flat(lame);
  for (const auto& H : checks::deformations<S>()) {
    for (const int first : {0, 1, 2}) {
      const auto raised_H = raised<S>(H, first);
      CHECK(checks::relative_distance(law.cauchy(raised_H), raised_stress<S>(flat.cauchy(H), first)) < 1e-11);
      Gradient<space> in_two = law.first_piola(raised_H);
      if constexpr (S == plane_strain) in_two[4 * ((first + 2) % 3)] = 0;  // P_zz, of which the plane does not know
      CHECK(checks::relative_distance(in_two, raised<S>(flat.first_piola(H), first)) < 1e-11);
    }
  }
}

TEST_CASE("the logarithm of a tensor is that of its eigenvalues, from 1e-2 to 1e2, equal and nearly equal ones too") {
  const std::vector<std::array<double, 3>> all = {
      {1, 1, 1},       {1, 1, 1 + 1e-12},    {2, 2, 2},          {1e-2, 1, 1e2},           {1e-2, 1e-2, 1e2},
      {1e2, 1e2, 1e2}, {0.5, 0.5 + 1e-9, 3}, {1 + 1e-5, 1, 0.9}, {0.1, 7, 7 * (1 + 1e-14)}};
  const Eigen::Matrix3d Q = matrix_of(checks::rotation<SpaceTensor>(1.1));
  for (const auto& b : all) {
    CAPTURE(b[0], b[1], b[2]);
    const Eigen::Vector3d values(b[0], b[1], b[2]), minus_one(b[0] - 1, b[1] - 1, b[2] - 1);
    const Eigen::Matrix3d B = Q * minus_one.asDiagonal() * Q.transpose();
    const Eigen::Matrix3d exact = Q * values.array().log().matrix().asDiagonal() * Q.transpose();
    const Eigen::Matrix3d found = matrix_of(log_of_unit_plus(tensor_of_matrix(B)));
    // Invariants of the tensor, rounded beside its largest eigenvalue, lose the square of their ratio.
    const double ratio = values.maxCoeff() / values.minCoeff();
    CHECK((found - exact).norm() <= 1e-14 + 1e-17 * ratio * ratio + 1e-13 * exact.norm());
    CHECK((matrix_of(log_of_one(tensor_of_matrix(B))) - exact).norm() <=
          1e-14 + 1e-17 * ratio * ratio + 1e-13 * exact.norm());
  }
}

TEST_CASE("the logarithm of a small strain keeps its digits") {
  const SpaceTensor B{1e-9, 2e-10, -3e-10, 2e-10, -4e-9, 1e-9, -3e-10, 1e-9, 2e-9};
  const Eigen::Matrix3d b = matrix_of(B), exact = b - b * b / 2 + b * b * b / 3;
  CHECK((matrix_of(log_of_unit_plus(B)) - exact).norm() <= 1e-15 * exact.norm());
  CHECK((matrix_of(log_of_one(B)) - exact).norm() <= 1e-15 * exact.norm());
}

TEST_CASE("the logarithm of one point is the same on both sides of the strain from which it takes roots") {
  const SpaceTensor direction{0.5, 0.2, -0.3, 0.2, -0.4, 0.1, -0.3, 0.1, 0.6};
  const double norm = matrix_of(direction).norm();
  for (const double size : {1e-3, 0.05, 0.1999, 0.2001}) {
    const SpaceTensor B = size / norm * direction;
    const Eigen::Matrix3d by_roots = matrix_of(log_of_unit_plus(B));
    CHECK((matrix_of(log_of_one(B)) - by_roots).norm() <= 1e-14 * by_roots.norm());  // four roots round
  }
}

TEST_CASE(
    "Hencky's stress and rate of a small strain are those of any strain, and a large one is not taken for small") {
  const Hencky<space> law({.lambda = 1.5, .mu = 1});
  const Gradient<space> dH{0.3, 0.2, -0.1, 0.15, -0.4, 0.25, -0.35, 0.1, 0.2};
  bool some_large = false;
  for (const double size : {1e-9, 1e-3, 0.03, 0.06, 0.1, 0.3}) {
    for (Gradient<space> H : checks::deformations<space>()) {
      for (double& h : H) h *= size;
      CAPTURE(size);
      const double strain = matrix_of(left_strain(displacement_gradient<space>(H))).norm();
      CHECK(law.is_small(H) == (strain < 0.2));
      some_large = some_large || !law.is_small(H);
      if (!law.is_small(H)) continue;
      const auto check = [](const Gradient<space>& by_series, const Gradient<space>& by_roots) {
        double scale = 0;
        for (const double component : by_roots) scale = std::max(scale, std::abs(component));
        for (std::size_t k = 0; k < by_roots.size(); ++k)
          CHECK(std::abs(by_series[k] - by_roots[k]) <= 2e-14 * scale);  // roots round
      };
      check(law.first_piola_of_small(H), law.first_piola(H));
      check(law.rate_of_small(H, dH), law.rate(H, dH));
    }
  }
  CHECK(some_large);
}

TEMPLATE_TEST_CASE("the rate of an elastic law is that of its moduli, at small and large strains", "", Hencky<space>,
                   NeoHookean<space>, Hencky<plane_strain>, NeoHookean<plane_strain>, Hencky<axisymmetric>,
                   NeoHookean<axisymmetric>, Hencky<StressState::plane_stress>, NeoHookean<StressState::plane_stress>) {
  constexpr StressState S = TestType::state;
  constexpr int n = gradient_components(S);
  const TestType law({.lambda = 1.5, .mu = 1});
  Gradient<S> dH;
  for (int a = 0; a < n; ++a) dH[a] = 0.3 - 0.11 * a;
  for (const double size : {0.0, 1e-9, 1e-3, 1.0}) {
    for (Gradient<S> H : checks::deformations<S>()) {
      CAPTURE(size);
      for (double& h : H) h *= size;
      const auto A = law.moduli(H);
      const Gradient<S> rate = law.rate(H, dH);
      for (int a = 0; a < n; ++a) {
        double expected = 0, scale = 0;
        for (int b = 0; b < n; ++b) expected += A[n * a + b] * dH[b], scale += std::abs(A[n * a + b] * dH[b]);
        CHECK(std::abs(rate[a] - expected) <= 1e-12 * scale);  // roots, and products in another order
      }
    }
  }
}

TEMPLATE_TEST_CASE("a law without history in space is not a number where the body is turned inside out", "",
                   NeoHookean<space>, Hencky<space>) {
  for (const int axis : {0, 4, 8}) {
    Gradient<space> H{};
    H[static_cast<std::size_t>(axis)] = -1.1;
    for (const double P : TestType(lame).first_piola(H)) CHECK((std::isnan(P) || P == 0));
    CHECK(std::isnan(TestType(lame).first_piola(H)[static_cast<std::size_t>(axis)]));
  }
}

TEMPLATE_TEST_CASE_SIG("a walk of plastic strain in space ends where it ends in the plane and around an axis", "",
                       ((class Soil, StressState S), Soil, S), (ConeLaws, plane_strain), (ConeLaws, axisymmetric),
                       (PyramidLaws, plane_strain), (PyramidLaws, axisymmetric)) {
  const typename Soil::template Law<S> flat(Soil::soil);
  const typename Soil::template Law<space> law(Soil::soil);
  for (const int first : {0, 1, 2}) {
    auto now = flat.initial_history({-3e3, -5e3, -2e3, 1e3});
    auto in_space = law.initial_history(raised_stress<S>({-3e3, -5e3, -2e3, 1e3}, first));
    Gradient<S> last{};
    double largest = 0, gap = 0;
    for (const auto& H : walk<S>(2e-3, 200)) {
      const auto dH = minus<S>(H, last);
      const auto P = flat.first_piola(H, dH, 0, now);
      Gradient<space> raised_P = law.first_piola(raised<S>(H, first), raised<S>(dH, first), 0, in_space);
      if constexpr (S == plane_strain) raised_P[4 * ((first + 2) % 3)] = 0;
      largest = std::max(largest, largest_difference(raised_P, raised<S>(P, first)));
      gap = std::max(gap, now[4]);
      last = H;
    }
    CHECK(largest < 1e-6);  // rounding of E in 200 steps
    CHECK(now[5] > 0.05);   // it has yielded,
    CHECK(gap > 1e-4);      // and opened
    CHECK(in_space[6] == Approx(now[4]).margin(1e-12));
    CHECK(in_space[7] == Approx(now[5]).epsilon(1e-9));
  }
}

TEMPLATE_TEST_CASE("a walk of plastic strain that is seen from turned axes has the turned stress", "", ConeLaws,
                   PyramidLaws) {
  const SpaceTensor Q = checks::rotation<SpaceTensor>(0.8);
  const auto turned = [&](const Gradient<space>& H) { return gradient_part<space>(Q * in_space(H) * transpose(Q)); };
  const typename TestType::template Law<space> law(TestType::soil);
  auto here = law.initial_history({-3e3, -5e3, -2e3, 1e3, 500, -700});
  auto there = law.initial_history(checks::turned<space>(Q, law.cauchy(here)));
  Gradient<space> last{};
  for (const auto& H : walk<space>(2e-3, 200)) {
    const auto dH = minus<space>(H, last);
    const auto P = law.first_piola(H, dH, 0, here), P_there = law.first_piola(turned(H), turned(dH), 0, there);
    CHECK(largest_difference(P_there, turned(P)) < 1e-6);  // rounding of E
    last = H;
  }
  CHECK(here[7] > 0.05);
}

TEST_CASE("a rotation in space by 90 degrees turns the stress exactly, in any number of increments") {
  constexpr double quarter = std::numbers::pi / 2, K = 1e7;
  const Stress<space> before = {-3e3, 1e3, -2e3, 2e3, 1e3, -5e2};
  const DruckerPrager<space> law({.E = K, .nu = 0.2, .phi = 30, .c = 1e6});
  const Stress<space> exact = checks::turned<space>(checks::rotation<SpaceTensor>(quarter), before);
  for (const int steps : {1, 10, 1000}) {
    auto now = law.initial_history(before);
    Gradient<space> last{};
    for (int k = 1; k <= steps; ++k) {
      const auto H = gradient_part<space>(checks::rotation<SpaceTensor>(quarter * k / steps) - identity<SpaceTensor>);
      law.first_piola(H, minus<space>(H, last), 0, now);
      last = H;
    }
    const double rounding = 1e-16 * K * std::sqrt(steps) + 1e-15 * steps * 3e3;  // of H, and of the products
    CHECK(largest_difference(law.cauchy(now), exact) < 10 * rounding);
  }
}

TEMPLATE_TEST_CASE("moduli in space are the derivative of the stress: yielding, opening and elastic", "", ConeLaws,
                   PyramidLaws) {
  const typename TestType::template Law<space> law(TestType::soil);
  for (const double size : {1e-5, 2e-3, 0.05}) {
    for (const double spread : {-1.0, 0.0, 1.0}) {
      auto now = law.initial_history({-3e3, -5e3, -2e3, 1e3, 500, -700});
      Gradient<space> H = {0.3, 0.5, -0.4, 0.1, -0.2, 0.6, -0.5, 0.2, 0.1};
      for (double& h : H) h *= size;
      for (const std::size_t axis : {0, 4, 8}) H[axis] += spread * size;
      const auto P = [&](const Gradient<space>& at) {
        auto next = now;
        return law.first_piola(at, at, 0, next);
      };
      const auto exact = checks::differences<space>(P, H);
      CHECK(checks::relative_distance(law.moduli(H, H, 0, now), exact) < 1e-6);  // rounding/d, and curvature
      const auto A = law.elastic_moduli(H, now);
      for (int a = 0; a < 9; ++a)
        for (int b = 0; b < a; ++b) CHECK(A[9 * a + b] == Approx(A[9 * b + a]).margin(1e-9 * cone_soil.E));
    }
  }
}

TEST_CASE("products, determinants and inverses of gradients in space are those of matrices") {
  constexpr Kinematics K = Kinematics::space;
  const auto as_matrix = [](const TensorOf<K>& A) {
    return Eigen::Matrix3d(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(A.data()));
  };
  const auto all = checks::deformations<space>();
  for (std::size_t k = 1; k < all.size(); ++k) {
    const auto A = plus_identity<K>(all[k]), B = plus_identity<K>(all[k - 1]);
    CHECK((as_matrix(product<K>(A, B)) - as_matrix(A) * as_matrix(B)).norm() < 1e-14);
    CHECK((as_matrix(transposed<K>(A)) - as_matrix(A).transpose()).norm() == 0);
    CHECK(determinant<K>(A) == Approx(as_matrix(A).determinant()).epsilon(1e-13));
    CHECK((as_matrix(inverse<K>(A)) - as_matrix(A).inverse()).norm() < 1e-12);
  }
  CHECK(stillpoint::tensor_of<K>({1, 2, 3, 4, 5, 6}) == TensorOf<K>{1, 4, 6, 4, 2, 5, 6, 5, 3});
}
