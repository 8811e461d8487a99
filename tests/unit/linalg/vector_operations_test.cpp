// Our N_Vector operations against plain loops.
#include <stillpoint/vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <nvector/nvector_serial.h>
#include <omp.h>

#include "largest.hpp"
#include "linalg/sundials.hpp"
#include "random_values.hpp"

using stillpoint::NVectorHandle;
using stillpoint::Vector;
using stillpoint::VectorSpace;
using stillpoint::test::random_values;
using Values = std::vector<double>;

namespace {

// Around the widths of lanes and blocks, and long enough for threads.
const std::vector<std::size_t> lengths = {1, 15, 16, 17, 1023, 1025, 70001};

struct Sample {
  explicit Sample(std::size_t n) : x(random_values(n, 2, 1)), y(random_values(n, 2, 2)), z(n, 7.0) {}
  VectorSpace space;
  Values x, y, z;
  Vector X = space.view(x), Y = space.view(y), Z = space.view(z);
};

// result_i = expected(i) to the last bit
template <class Expected>
bool equals(const Values& result, const Expected& expected) {
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (result[i] != expected(i)) return false;
  }
  return true;
}

long double plain_sum(std::size_t n, const std::function<long double(std::size_t)>& term) {
  long double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += term(i);
  return sum;
}

}  // namespace

TEST_CASE("vector operations entry by entry agree with plain loops", "[vector]") {
  for (const std::size_t n : lengths) {
    Sample s(n);
    const Values &x = s.x, &y = s.y, &z = s.z;
    const NVectorHandle X = s.X.handle(), Y = s.Y.handle(), Z = s.Z.handle();
    CAPTURE(n);
    for (const auto& [a, b] :
         {std::pair{1., 1.}, {1., -1.}, {-1., 1.}, {1., 0.3}, {0.3, 1.}, {2., 2.}, {0., 1.}, {0.7, -1.3}}) {
      CAPTURE(a, b);
      N_VLinearSum(a, X, b, Y, Z);
      // No tighter than a rounding: the compiler may or may not fuse a product with a sum.
      CHECK(std::ranges::all_of(z, [&, a = a, b = b, i = std::size_t{0}](double value) mutable {
        const double expected = a * x[i] + b * y[i];
        ++i;
        return std::abs(value - expected) <= 1e-15 * 4;
      }));
    }
    N_VConst(3, Z);
    CHECK(equals(z, [](std::size_t) { return 3; }));
    N_VScale(1, X, Z);
    CHECK(z == x);
    N_VScale(-0.7, X, Z);
    CHECK(equals(z, [&](std::size_t i) { return -0.7 * x[i]; }));
    N_VProd(X, Y, Z);
    CHECK(equals(z, [&](std::size_t i) { return x[i] * y[i]; }));
    N_VDiv(X, Y, Z);
    CHECK(equals(z, [&](std::size_t i) { return x[i] / y[i]; }));
    N_VAbs(X, Z);
    CHECK(equals(z, [&](std::size_t i) { return std::abs(x[i]); }));
    N_VInv(X, Z);
    CHECK(equals(z, [&](std::size_t i) { return 1 / x[i]; }));
    N_VAddConst(X, 0.5, Z);
    CHECK(equals(z, [&](std::size_t i) { return x[i] + 0.5; }));
    N_VLinearSum(0.5, X, 1, Y, Y);  // in place
    const Values y_before = random_values(n, 2, 2);
    CHECK(std::abs(y[n - 1] - (0.5 * x[n - 1] + y_before[n - 1])) < 1e-15);
  }
}

TEST_CASE("vector reductions agree with plain sums in higher precision", "[vector]") {
  for (const std::size_t n : lengths) {
    Sample s(n);
    const Values &x = s.x, &y = s.y;
    const NVectorHandle X = s.X.handle(), Y = s.Y.handle();
    const auto agrees = [&](double value, long double exact) {
      return std::abs(value - exact) <= 1e-14L * static_cast<long double>(n);
    };
    const long double squares =
        plain_sum(n, [&](std::size_t i) { return powl(static_cast<long double>(x[i]) * y[i], 2); });
    CAPTURE(n);
    CHECK(agrees(N_VDotProd(X, Y), plain_sum(n, [&](std::size_t i) { return static_cast<long double>(x[i]) * y[i]; })));
    CHECK(agrees(N_VL1Norm(X), plain_sum(n, [&](std::size_t i) { return std::abs(x[i]); })));
    CHECK(agrees(N_VWL2Norm(X, Y), sqrtl(squares)));
    CHECK(agrees(N_VWrmsNorm(X, Y), sqrtl(squares / static_cast<long double>(n))));
    CHECK(N_VMin(X) == *std::ranges::min_element(x));
    CHECK(N_VMaxNorm(X) == std::abs(*std::ranges::max_element(x, {}, [](double v) { return std::abs(v); })));
    CHECK(agrees(stillpoint::norm(s.X),
                 sqrtl(plain_sum(n, [&](std::size_t i) { return static_cast<long double>(x[i]) * x[i]; }))));
  }
}

TEST_CASE("linear combinations of any number of vectors agree with plain loops, zero factors or not", "[vector]") {
  for (const std::size_t n : {std::size_t{33}, std::size_t{40000}}) {
    VectorSpace space;
    for (int count = 1; count <= 35; count += n < 100 ? 1 : 11) {
      std::vector<Vector> vectors;
      std::vector<NVectorHandle> X;
      Values c;
      for (int k = 0; k < count; ++k) {
        vectors.push_back(space.make(n));
        std::ranges::copy(random_values(n, 2, static_cast<unsigned>(k)), vectors.back().span().begin());
        X.push_back(vectors.back().handle());
        c.push_back(k % 3 == 1 ? 0 : 1.0 / (k + 1));
      }
      Values expected(n, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < X.size(); ++k) expected[i] += c[k] * vectors[k].span()[i];
      }
      Vector z = space.make(n);
      CHECK(N_VLinearCombination(count, c.data(), X.data(), z.handle()) == 0);
      CHECK(N_VLinearCombination(count, c.data(), X.data(), X[0]) == 0);  // in place
      Largest difference;
      for (std::size_t i = 0; i < n; ++i) {
        difference.take_magnitude(z.span()[i] - expected[i]);
        difference.take_magnitude(vectors[0].span()[i] - expected[i]);
      }
      CAPTURE(n, count);
      CHECK(difference.value() < 1e-14);
    }
    Values zeros = {0, 0};
    Vector x = space.make(n), z = space.make(n);
    N_VConst(5, z.handle());
    std::vector<NVectorHandle> X = {x.handle(), x.handle()};
    N_VLinearCombination(2, zeros.data(), X.data(), z.handle());
    CHECK(stillpoint::max_norm(z) == 0);
  }
}

TEST_CASE("multiple scaled additions and dot products agree with single ones", "[vector]") {
  Sample s(100);
  Vector other = s.space.make(100);
  std::vector<NVectorHandle> Y = {s.X.handle(), s.Y.handle()}, Z = {s.Z.handle(), other.handle()};
  Values a = {2, -3}, products(2);
  N_VScaleAddMulti(2, a.data(), s.X.handle(), Y.data(), Z.data());
  CHECK(s.z[7] == Approx(2 * s.x[7] + s.x[7]));
  CHECK(other.span()[99] == Approx(-3 * s.x[99] + s.y[99]));
  N_VDotProdMulti(2, s.X.handle(), Y.data(), products.data());
  CHECK(products[0] == stillpoint::dot(s.X, s.X));
  CHECK(products[1] == stillpoint::dot(s.X, s.Y));
}

TEST_CASE("products of one vector with several in one pass have the bits of each alone, at any length", "[vector]") {
  const VectorSpace space;
  for (const std::size_t n : {1u, 15u, 16u, 511u, 512u, 513u, 1025u, 8191u, 8192u, 100'003u}) {
    CAPTURE(n);
    std::vector<Vector> all;
    for (unsigned seed = 0; seed < 11; ++seed) {
      Vector& v = all.emplace_back(space.make(n));
      std::ranges::copy(random_values(n, 2, seed + 1), v.span().begin());
    }
    const auto few = stillpoint::dots(all[0], all[0], all[1], all[2]);
    for (std::size_t k = 0; k < few.size(); ++k) CHECK(few[k] == stillpoint::dot(all[0], all[k]));
    std::vector<NVectorHandle> Y;  // more than one pass takes
    for (const Vector& v : all) Y.push_back(v.handle());
    Values products(Y.size());
    stillpoint::dot_each(all[0], Y, products);
    for (std::size_t k = 0; k < Y.size(); ++k) CHECK(products[k] == stillpoint::dot(all[0], all[k]));
    all[1].span()[n / 2] = std::numeric_limits<double>::quiet_NaN();
    const auto [whole, broken] = stillpoint::dots(all[0], all[2], all[1]);
    CHECK(whole == few[2]);
    CHECK(std::isnan(broken));
  }
}

TEST_CASE("reductions give the same bits for one and for two threads", "[vector]") {
  Sample s(1'234'567);
  const auto all = [&] {
    return Values{stillpoint::dot(s.X, s.Y), N_VL1Norm(s.X.handle()), N_VWrmsNorm(s.X.handle(), s.Y.handle()),
                  stillpoint::max_norm(s.X), N_VMin(s.X.handle())};
  };
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Values one = all();
  omp_set_num_threads(2);
  const Values two = all();
  omp_set_num_threads(threads);
  CHECK(one == two);
}

TEST_CASE("the bits of a sum do not depend on where in memory its vectors lie", "[vector]") {
  const Values values = random_values(100'000, 2, 3);
  Values padded(values.size() + 8);
  VectorSpace space;
  Values sums;
  for (std::ptrdiff_t shift = 0; shift < 8; ++shift) {
    std::ranges::copy(values, padded.begin() + shift);
    const Vector x = space.view({padded.data() + shift, values.size()});
    sums.push_back(stillpoint::dot(x, x));
  }
  CHECK(std::ranges::all_of(sums, [&](double sum) { return sum == sums[0]; }));
}

TEST_CASE("NaN and infinity survive the maximum norm wherever they stand", "[vector]") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const std::size_t place : {0u, 1u, 50u, 99u}) {
    Sample s(100);
    s.x[place] = -infinity;
    CHECK(stillpoint::max_norm(s.X) == infinity);
    s.x[place] = -nan;
    CHECK(std::isnan(stillpoint::max_norm(s.X)));
    s.x[99 - place] = infinity;
    CHECK(std::isnan(stillpoint::max_norm(s.X)));
    // An adopted vector brings SUNDIALS' own maximum, which loses NaN.
    const NVectorHandle stock = N_VMake_Serial(100, s.x.data(), static_cast<SUNContext>(s.space.sundials_context()));
    const Vector adopted = s.space.adopt(stock);
    CHECK(std::isnan(stillpoint::max_norm(adopted)));
    N_VDestroy(stock);
  }
}
