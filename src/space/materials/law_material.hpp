// The common part of laws with and without history in their application to blocks of points: the loops that the
// compiler vectorises.
#pragma once

#include <stillpoint/unroll.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "space/materials/point_material.hpp"

namespace stillpoint {

/// Base class of ElasticMaterial and HistoryMaterial.
template <class Law>
class LawMaterialBase : public PointMaterial<kinematics(Law::state)> {
 protected:
  static constexpr Kinematics K = kinematics(Law::state);
  static constexpr int components = gradient_components(K);
  using Block = PointBlock<K>;
  using Tensor = TensorOf<K>;
  using typename PointMaterial<K>::ModuliMatrix;

 public:
  void tangent(Tangent kind, Block& block, const double* V, double dt) const override {
    for (std::size_t q = 0; q < block.count; ++q) {
      const std::size_t p = block.first + q;
      const Tensor dP = contract(this->moduli(kind, block.H_at(q), block.dH_at(q), dt, p), block.direction_at(q));
      for (int c = 0; c < components; ++c) block.VP[c][q] = V[p] * dP[c];
    }
  }
  double stiffness_bound(const Block& block) const override {
    double largest = 0;
    for (std::size_t q = 0; q < block.count; ++q) {
      largest = std::max(largest, row_sum_bound(this->moduli(Tangent::elastic, block.H_at(q), {}, 0, block.first + q)));
    }
    return largest;
  }

  void take(const std::vector<int>& from, std::size_t begin, std::size_t count) override {
    const Vec values = this->memory();
    std::vector<double> taken(this->memory_rows() * count);
    for (std::size_t row = 0; row < this->memory_rows(); ++row) {
      for (std::size_t k = 0; k < count; ++k)
        taken[count * row + k] = values[count_ * row + static_cast<std::size_t>(from[begin + k]) - begin_];
    }
    this->replace(std::move(taken), begin, count);
  }

 protected:
  static constexpr double real = sizeof(double);

  LawMaterialBase(const Law& law, std::size_t begin, std::size_t count, const PointMaterialInfo& info)
      : PointMaterial<K>(info), law_(law), begin_(begin), count_(count) {}

  static constexpr std::size_t group = 8;  // fills the registers of present processors

  /// Σ point(q), q = 0 … count − 1, vectorised. The remainder of whole groups is a group too, which begins early
  /// enough: a point evaluated twice gives the same answer, which costs less than a remainder of single points. There
  /// is one loop over all groups, as the compiler makes a third more instructions if each is a loop of its own, and the
  /// last group goes through it as well: a loop of its own would round otherwise, and a point's answer would depend on
  /// where in a block it is.
  template <class Point>
  [[gnu::always_inline]] static double sum_in_groups(std::size_t count, const Point& point) {
    double sum = 0;
    if (count < group) {
      for (std::size_t q = 0; q < count; ++q) sum += point(q);
      return sum;
    }
    std::size_t first = 0, groups = count / group;
    while (true) {
      asm("" : "+r"(first), "+r"(groups));  // the compiler does not know which pass it is
      const std::size_t n = group * groups;
#pragma omp simd reduction(+ : sum)
      for (std::size_t q = 0; q < n; ++q)
        sum += point(first + q);  // all locals are point's own, or GCC does not vectorise
      if (first + n == count) return sum;
      first = count - group;
      groups = 1;
    }
  }

  static Tensor contract(const ModuliMatrix& A, const Tensor& dH) {
    Tensor dP{};
    for (int a = 0; a < components; ++a) {
      for (int b = 0; b < components; ++b) dP[a] += A[components * a + b] * dH[b];
    }
    return dP;
  }
  static double row_sum_bound(const ModuliMatrix& A) {
    double largest = 0;
    for (int a = 0; a < components; ++a) {
      double sum = 0;
      for (int b = 0; b < components; ++b) sum += std::abs(A[components * a + b]);
      largest = sum <= largest ? largest : sum;  // NaN stays
    }
    return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
  }

  Law law_;
  std::size_t begin_, count_;
};

}  // namespace stillpoint
