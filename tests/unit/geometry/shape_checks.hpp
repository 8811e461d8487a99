// What every signed distance has to satisfy, whatever its shape, checked at positions by chance.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/rigid_shape.hpp"
#include "largest.hpp"
#include "random_values.hpp"

namespace stillpoint::test {

/// Positions about a centre, in the cube of this half side.
template <int N>
std::vector<Eigen::Vector<double, N>> positions_by_chance(
    std::size_t count, double half_side, unsigned seed = 1,
    const Eigen::Vector<double, N>& centre = Eigen::Vector<double, N>::Zero()) {
  const std::vector<double> values = random_values(count * N, half_side, seed);
  std::vector<Eigen::Vector<double, N>> positions;
  for (std::size_t k = 0; k < count; ++k) positions.push_back(centre + Eigen::Vector<double, N>(values.data() + k * N));
  return positions;
}

/// φ is the signed distance of the set that contains(x) tells: the sign is right, no position of the other side is
/// nearer than |φ|, and at x − φ n are positions of both sides. At all but a few of the positions ∇φ and ∇∇φ agree with
/// central differences; the few are those where the nearest position of the surface jumps within the stencil. |∇φ| = 1.
template <int N, class Contains>
void check_signed_distance(const RigidShape<N>& shape, double half_side, const Contains& contains) {
  constexpr std::size_t count = 300;
  constexpr double close = 1e-7;
  int wrong_side = 0, nearer = 0, off_surface = 0;
  for (const auto& x : positions_by_chance<N>(count, half_side)) {
    const Nearest<N> here = shape.nearest(x);
    const bool inside = contains(x);
    wrong_side += inside != (here.distance < 0);
    for (const auto& p : positions_by_chance<N>(60, std::abs(here.distance), 2, x))
      nearer += contains(p) != inside && (p - x).norm() < std::abs(here.distance) - close;
    int of_inside = 0;
    constexpr std::size_t many = 300;
    for (const auto& p : positions_by_chance<N>(many, close, 3, x - here.distance * here.normal))
      of_inside += contains(p);
    off_surface += of_inside == 0 || of_inside == many;
  }
  CHECK(wrong_side == 0);
  CHECK(nearer == 0);
  CHECK(off_surface == 0);
}

template <int N>
void check_derivatives(const RigidShape<N>& shape, double half_side) {
  constexpr double h = 1e-5;
  constexpr std::size_t count = 400;
  std::size_t smooth = 0;
  Largest length, gradient_off, hessian_off;
  for (const auto& x : positions_by_chance<N>(count, half_side)) {
    const Nearest<N> here = shape.nearest(x);
    length.take_magnitude(here.normal.norm() - 1);
    Eigen::Vector<double, N> gradient;
    Eigen::Matrix<double, N, N> hessian;
    double change = 0;  // of ∇∇φ within the stencil
    for (Eigen::Index d = 0; d < N; ++d) {
      const Eigen::Vector<double, N> step = h * Eigen::Vector<double, N>::Unit(d);
      const Nearest<N> after = shape.nearest(x + step), before = shape.nearest(x - step);
      gradient[d] = (after.distance - before.distance) / (2 * h);
      hessian.col(d) = (after.normal - before.normal) / (2 * h);
      change = std::max(change, (after.hessian - before.hessian).norm());
    }
    const double scale = 1 + here.hessian.norm();
    if (change > 0.01 * scale || (gradient - here.normal).norm() > 0.01) continue;
    ++smooth;
    gradient_off.take_magnitude((gradient - here.normal).norm());
    hessian_off.take_magnitude((hessian - here.hessian).norm() / (scale * scale));
  }
  CHECK(length.value() < 1e-13);
  CHECK(gradient_off.value() < 1e-7);
  CHECK(hessian_off.value() < 1e-6);
  CHECK(smooth > count * 19 / 20);
}

/// φ is not a number at a position of which one coordinate is none.
template <int N>
void check_nan(const RigidShape<N>& shape) {
  for (Eigen::Index d = 0; d < N; ++d) {
    Eigen::Vector<double, N> x = Eigen::Vector<double, N>::Zero();
    x[d] = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(shape.nearest(x).distance));
  }
}

/// All of these.
template <int N, class Contains>
void check_shape(const RigidShape<N>& shape, double half_side, const Contains& contains) {
  check_signed_distance(shape, half_side, contains);
  check_derivatives(shape, half_side);
  check_nan(shape);
}

}  // namespace stillpoint::test
