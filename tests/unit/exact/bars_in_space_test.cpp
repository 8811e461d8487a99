// Saint-Venant's bars: what makes them solutions, by central differences, and their published figures.
#include <stillpoint/stillpoint.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "largest.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::TemporaryFolder;

namespace {

using Vector3 = std::array<double, 3>;
using Stress6 = std::array<double, 6>;  // xx, yy, zz, xy, yz, zx
constexpr double young = 2, poisson = 0.3, mu = young / (2 * (1 + poisson)),
                 lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
constexpr double a = 0.3, b = 0.2;  // halves of the sides along y and z

/// Of a scene with that E and ν, and the solution with these keys.
Scene bar_scene(const std::string& solution, double half_depth = a, double half_width = b, double length = 1.2) {
  const TemporaryFolder folder;
  const std::string exact = fmt::format("exact={{{}, depth={}, width={}, x0=0.1, y0=0.2, z0=-0.1}}", solution,
                                        2 * half_depth, 2 * half_width);
  return load_scene(folder.write("bar.toml", fmt::format(R"(
dim = 3
[grid]
min = [0.1, {}, {}]
max = [{}, {}, {}]
cells = [1, 1, 1]
[body]
material = "stuff"
[material.stuff]
law = "linear-elastic"
E = {}
nu = {}
rho = 1
)",
                                                         0.2 - half_depth, -0.1 - half_width, 0.1 + length,
                                                         0.2 + half_depth, -0.1 + half_width, young, poisson)),
                    {exact});
}

/// y and z are those of the section.
struct Bar {
  explicit Bar(const Scene& of) : exact(exact_solution(of)) {}
  Vector3 u(const Vector3& x) const {
    Vector3 value{};
    exact->displacement(moved(x), 0, value);
    return value;
  }
  Stress6 stress(const Vector3& x) const {
    Stress6 value{};
    exact->stress(moved(x), 0, value);
    return value;
  }
  static Vector3 moved(const Vector3& x) { return {x[0] + 0.1, x[1] + 0.2, x[2] - 0.1}; }

  std::unique_ptr<ExactSolution> exact;
};

double slope(const std::function<double(const Vector3&)>& f, const Vector3& x, std::size_t axis) {
  constexpr double h = 1e-3;
  const auto at = [&](double step) {
    Vector3 moved = x;
    moved[axis] += step;
    return f(moved);
  };
  return (at(-2 * h) - 8 * at(-h) + 8 * at(h) - at(2 * h)) / (12 * h);
}

constexpr std::size_t component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

/// The largest part of div σ, and of σ less Hooke's of the displacement, inside the bar.
struct Faults {
  double balance, law;
};
Faults faults_of(const Bar& bar) {
  Largest balance, law;
  for (const Vector3& x : {Vector3{0.3, 0.07, 0.05}, {0.9, -0.2, 0.12}, {0.1, 0.25, -0.17}, {0.5, -0.28, -0.01}}) {
    double H[3][3], trace = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        H[i][j] = slope([&](const Vector3& at) { return bar.u(at)[i]; }, x, j);
        sum += slope([&](const Vector3& at) { return bar.stress(at)[component[i][j]]; }, x, j);
      }
      trace += H[i][i];
      balance.take_magnitude(sum);
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        law.take_magnitude(bar.stress(x)[component[i][j]] - mu * (H[i][j] + H[j][i]) - (i == j ? lambda * trace : 0));
  }
  return {balance.value(), law.value()};
}

/// Of the traction on the four sides.
double largest_traction(const Bar& bar) {
  Largest largest;
  for (const double along : {-0.8, -0.3, 0.1, 0.6}) {
    const Stress6 top = bar.stress({0.4, a, along * b}), front = bar.stress({0.4, along * a, b});
    for (const std::size_t k : {1U, 3U, 4U}) largest.take_magnitude(top[k]);
    for (const std::size_t k : {2U, 4U, 5U}) largest.take_magnitude(front[k]);
  }
  return largest.value();
}

/// ∫ f(y, z) dA by the midpoint rule.
double over_section(const std::function<double(double, double)>& f) {
  constexpr int n = 200;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += f(a * (2 * i + 1 - n) / n, b * (2 * j + 1 - n) / n);
  return sum * 4 * a * b / (n * n);
}

}  // namespace

TEST_CASE("a twisted bar is in balance, obeys Hooke's law, and has no traction on its sides") {
  const Bar bar(bar_scene("solution='torsion', twist=0.5"));
  const Faults faults = faults_of(bar);
  CHECK(faults.balance < 1e-7);
  CHECK(faults.law < 1e-9);
  CHECK(largest_traction(bar) < 2e-4 * mu * 0.5 * a);  // of a series that falls as 1/n² there
}

TEST_CASE("a twisted bar bears the torque and the largest shear of Timoshenko and Goodier's table") {
  // art. 109: T = k_1 G α (2a)³ 2b of the shorter side 2a, τ_max = k G α 2a; of sides 1 : 1.5
  const Bar bar(bar_scene("solution='torsion', twist=0.5"));
  const double torque = over_section([&](double y, double z) {
    const Stress6 sigma = bar.stress({0.4, y, z});
    return y * sigma[5] - z * sigma[3];
  });
  CHECK(torque == Approx(0.196 * mu * 0.5 * std::pow(2 * b, 3) * 2 * a).epsilon(0.003));
  CHECK(std::abs(bar.stress({0.4, 0, b})[3]) == Approx(0.848 * mu * 0.5 * 2 * b).epsilon(0.001));
  const Bar square(bar_scene("solution='torsion', twist=0.5", a, a));
  CHECK(square.stress({0.4, a, 0})[5] == Approx(0.675314 * mu * 0.5 * 2 * a).epsilon(1e-6));
  CHECK(-square.stress({0.4, 0, a})[3] == Approx(0.675314 * mu * 0.5 * 2 * a).epsilon(1e-6));
}

TEST_CASE("a cantilever with a force at its end is in balance, obeys Hooke's law, and has no traction on its sides") {
  const Bar bar(bar_scene("solution='flexure', length=1.2, load=-0.7"));
  const Faults faults = faults_of(bar);
  const double largest_stress = 0.7 * 1.2 * a / (4 * a * a * a * b / 3);
  CHECK(faults.balance < 1e-8 * largest_stress);
  CHECK(faults.law < 1e-9 * largest_stress);
  CHECK(largest_traction(bar) < 1e-4 * largest_stress);
}

TEST_CASE("a cantilever bears its load, and bends and shears as Timoshenko's beam with Cowper's coefficient") {
  constexpr double l = 1.2, W = -0.7;
  const Bar bar(bar_scene("solution='flexure', length=1.2, load=-0.7"));
  CHECK(over_section([&](double y, double z) { return bar.stress({0.4, y, z})[3]; }) == Approx(W).epsilon(1e-4));
  CHECK(over_section([&](double y, double z) {
          return y * bar.stress({0.4, y, z})[0];
        }) == Approx(-W * (l - 0.4)).epsilon(1e-4));
  const double scale = std::abs(over_section([&](double y, double z) { return y * bar.u({l, y, z})[0]; }));
  CHECK(std::abs(over_section([&](double y, double z) { return y * bar.u({0, y, z})[0]; })) < 1e-4 * scale);

  // [Cowper 1966]; W̄ is the mean deflection, to which ν (l − x)(y² − z²)/2 adds where the section is no square.
  const double I = 4 * a * a * a * b / 3, G = mu, A = 4 * a * b, k = 10 * (1 + poisson) / (12 + 11 * poisson);
  const auto mean = [&](double x) { return over_section([&](double y, double z) { return bar.u({x, y, z})[1]; }) / A; };
  CHECK(mean(l) - mean(0) == Approx(W * l * l * l / (3 * young * I) + W * l / (k * G * A)).epsilon(1e-4));
}

TEST_CASE("a bar of another section or length than its body is refused at its key") {
  const auto refusal = [](const std::string& set) { return scenes::refusal("flexure", {set}); };
  CHECK(refusal("exact.depth=2*a").empty());
  CHECK_THAT(refusal("exact.depth=a"), Catch::Contains("exact.depth") && Catch::Contains("from -0.1 to 0.1 along y"));
  CHECK_THAT(refusal("exact.z0=a"), Catch::Contains("exact.width") && Catch::Contains("the bar from 0 to 0.2"));
  CHECK_THAT(refusal("exact.length=1"), Catch::Contains("exact.length") && Catch::Contains("along x"));
}
