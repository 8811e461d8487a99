// A material law applied to blocks of points: the loops that the compiler vectorises.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/unroll.hpp"
#include "space/materials/point_material.hpp"

namespace stillpoint {

/// What laws with and without history have in common.
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

 protected:
  static constexpr double real = sizeof(double);

  LawMaterialBase(const Law& law, std::size_t begin, std::size_t count, const PointMaterialInfo& info)
      : PointMaterial<K>(info), law_(law), begin_(begin), count_(count) {}

  /// Σ point(q), q = 0 … count − 1, in groups that fill the processor's registers. The last group begins early enough
  /// to be whole: a point that it meets again answers the same again, which costs less than a rest of single points.
  template <class Point>
  [[gnu::always_inline]] static double sum_in_groups(std::size_t count, const Point& point) {
    constexpr std::size_t group = 8;
    double sum = 0;
    if (count < group) {
      for (std::size_t q = 0; q < count; ++q) sum += point(q);
      return sum;
    }
    for (std::size_t begin = 0; begin < count; begin += group) {
      const std::size_t from = std::min(begin, count - group);
#pragma omp simd reduction(+ : sum)
      for (std::size_t q = 0; q < group; ++q) sum += point(from + q);  // all locals are point's own, or GCC gives up
    }
    return sum;
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

  // Of rows of values, (rows × points), those of points from[begin] … from[begin + count − 1].
  void take_values(std::vector<double>& values, const std::vector<int>& from, std::size_t begin,
                   std::size_t count) const {
    const std::size_t rows = values.size() / count_;
    std::vector<double> taken(rows * count);
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t k = 0; k < count; ++k)
        taken[count * row + k] = values[count_ * row + static_cast<std::size_t>(from[begin + k]) - begin_];
    }
    values.swap(taken);
  }

  Law law_;
  std::size_t begin_, count_;
};

/// A law without history. Once the body has moved on it keeps the deformation gradient F_0 with which the phase began:
///   F = f F_0,   P = P_0(F) F_0ᵀ/det F_0   per volume when the phase began.
template <ElasticLaw Law>
class ElasticMaterial final : public LawMaterialBase<Law> {
  using Base = LawMaterialBase<Law>;
  using Base::components, Base::law_, Base::begin_, Base::count_, Base::K;
  using typename Base::Block, typename Base::ModuliMatrix, typename Base::Tensor, typename Base::Stresses;

 public:
  ElasticMaterial(const Law& law, std::size_t begin, std::size_t count, bool updated_lagrangian)
      : Base(law, begin, count, {.finite_strain = Law::finite_strain, .wave_modulus = law.moduli({})[0]}) {
    if (!updated_lagrangian || !Law::finite_strain) return;
    const Tensor I = plus_identity<K>({});
    F0_.resize(components * count);
    for (std::size_t c = 0; c < components; ++c)
      std::fill_n(F0_.begin() + static_cast<std::ptrdiff_t>(count * c), count, I[c]);
  }

  [[gnu::flatten]] double stress(Block& block, const double* V, double /*dt*/, double* /*trial*/) const override {
    const Law law = law_;
    if (!moved()) {
      return loop(
          block, V, [law](const Tensor& H, std::size_t) __attribute__((always_inline)) { return law.first_piola(H); });
    }
    const double* of_block = F0_.data() + block.first - begin_;
    const std::size_t n = count_;
    return loop(
        block, V, [ law, of_block, n ](const Tensor& H, std::size_t q) __attribute__((always_inline)) {
          Tensor F_0;
          unroll<components>([&](auto c) __attribute__((always_inline)) { F_0[c] = of_block[n * c + q]; });
          return push(F_0, law.first_piola(total(F_0, H)));
        });
  }
  double committed_stress(Block&, const double*) const override {
    throw std::logic_error("an elastic law has no stress of its own");
  }
  void commit(std::vector<double>&) override {}

  ModuliMatrix moduli(Tangent, const Tensor& H, const Tensor& /*dH*/, double /*dt*/, std::size_t p) const override {
    if (!moved()) return law_.moduli(H);
    // Column b: the answer to a unit dH_b, dF = dH F_0
    const Tensor F_0 = F0(p);
    const ModuliMatrix A = law_.moduli(total(F_0, H));
    ModuliMatrix pushed{};
    for (int b = 0; b < components; ++b) {
      Tensor dH{};
      dH[b] = 1;
      const Tensor dP = push(F_0, Base::contract(A, product<K>(dH, F_0)));
      for (int a = 0; a < components; ++a) pushed[components * a + b] = dP[a];
    }
    return pushed;
  }
  Stresses cauchy(const Tensor& H, std::size_t p) const override { return law_.cauchy(moved() ? total(F0(p), H) : H); }

  void end_phase(const Block& block) override {
    for (std::size_t q = 0; q < block.count; ++q) {
      const std::size_t p = block.first + q;
      const Tensor F = product<K>(plus_identity<K>(block.H_at(q)), F0(p));
      for (std::size_t c = 0; c < components; ++c) F0_[count_ * c + p - begin_] = F[c];
    }
  }
  Vec memory() override { return F0_; }
  void reorder(const Reordering& order, std::vector<double>&) override {
    std::vector<double> work;
    order.apply(F0_, work, begin_, count_);
  }
  void take(const std::vector<int>& from, std::size_t begin, std::size_t count) override {
    Base::take_values(F0_, from, begin, count);
    begin_ = begin;
    count_ = count;
  }
  void set_stress(const std::vector<Stresses>&) override {
    throw std::logic_error("an elastic law has no stress of its own");
  }

  std::vector<PointArray> arrays() const override {
    if (!moved()) return {};
    return {{"deformation gradient", components * Base::real}};
  }
  std::vector<std::pair<std::string, ConstVec>> shown_history() const override { return {}; }

 private:
  bool moved() const { return !F0_.empty(); }
  Tensor F0(std::size_t p) const {
    Tensor F;
    for (std::size_t c = 0; c < components; ++c) F[c] = F0_[count_ * c + p - begin_];
    return F;
  }
  // H of f F_0
  static Tensor total(const Tensor& F_0, const Tensor& H) {
    Tensor F = product<K>(plus_identity<K>(H), F_0);
    const Tensor I = plus_identity<K>({});
    for (int c = 0; c < components; ++c) F[c] -= I[c];
    return F;
  }
  static Tensor push(const Tensor& F_0, const Tensor& P) {
    Tensor pushed = product<K>(P, transposed<K>(F_0));
    const double J = determinant<K>(F_0);
    for (double& component : pushed) component /= J;
    return pushed;
  }
  template <class StressAt>
  double loop(Block& block, const double* V, const StressAt& stress_at) const {
    const double* volume = V + block.first;
    const std::size_t count = block.count;
    const auto point = [&](std::size_t q) __attribute__((always_inline)) {
      return block.store_stress(q, volume[q], stress_at(block.H_at(q), q));
    };
    return Base::sum_in_groups(count, point);
  }

  std::vector<double> F0_;  // (components × points); empty in a body that never moves on
};

/// A law with history. A trial leaves what was committed alone, and to commit is to swap them.
template <HistoryLaw Law>
class HistoryMaterial final : public LawMaterialBase<Law> {
  using Base = LawMaterialBase<Law>;
  using Base::components, Base::law_, Base::begin_, Base::count_, Base::K;
  using typename Base::Block, typename Base::ModuliMatrix, typename Base::Tensor, typename Base::Stresses;
  using History = typename Law::History;

 public:
  HistoryMaterial(const Law& law, std::size_t begin, std::size_t count)
      : Base(law, begin, count,
             {.history_dependent = true,
              .finite_strain = true,
              .stress_stays = law.stress_stays(),
              .history_size = Law::history * count,
              .wave_modulus = law.elastic_moduli({}, law.initial_history({}))[0]}) {
    set_stress(std::vector<Stresses>(count, Stresses{}));
  }

  [[gnu::flatten]] double stress(Block& block, const double* V, double dt, double* trial) const override {
    const double* from = committed_.data() + block.first - begin_;
    double* to = trial + block.first - begin_;
    const double* volume = V + block.first;
    const Law law = law_;
    const std::size_t count = block.count, n = count_;
    const auto point = [&](std::size_t q) __attribute__((always_inline)) {
      History next;
      unroll<Law::history>([&](auto h) __attribute__((always_inline)) { next[h] = from[n * h + q]; });
      const Tensor P = law.first_piola(block.H_at(q), block.dH_at(q), dt, next);
      unroll<Law::history>([&](auto h) __attribute__((always_inline)) { to[n * h + q] = next[h]; });
      return block.store_stress(q, volume[q], P);
    };
    return Base::sum_in_groups(count, point);
  }
  [[gnu::flatten]] double committed_stress(Block& block, const double* V) const override {
    const double* from = committed_.data() + block.first - begin_;
    const double* volume = V + block.first;
    const Law law = law_;
    const std::size_t n = count_;
    const auto point = [&](std::size_t q) __attribute__((always_inline)) {
      History now;
      unroll<Law::history>([&](auto h) __attribute__((always_inline)) { now[h] = from[n * h + q]; });
      return block.store_stress(q, volume[q], tensor_of<K>(law.cauchy(now)));
    };
    return Base::sum_in_groups(block.count, point);
  }
  void commit(std::vector<double>& trial) override { committed_.swap(trial); }

  ModuliMatrix moduli(Tangent kind, const Tensor& H, const Tensor& dH, double dt, std::size_t p) const override {
    return kind == Tangent::elastic ? law_.elastic_moduli(H, history(p)) : law_.moduli(H, dH, dt, history(p));
  }
  Stresses cauchy(const Tensor&, std::size_t p) const override { return law_.cauchy(history(p)); }

  void end_phase(const Block&) override {}
  Vec memory() override { return committed_; }
  void reorder(const Reordering& order, std::vector<double>& work) override {
    order.apply(committed_, work, begin_, count_);
  }
  void take(const std::vector<int>& from, std::size_t begin, std::size_t count) override {
    Base::take_values(committed_, from, begin, count);
    begin_ = begin;
    count_ = count;
    this->set_history_size(Law::history * count);
  }
  void set_stress(const std::vector<Stresses>& stress) override {
    committed_.resize(Law::history * count_);
    for (std::size_t k = 0; k < count_; ++k) {
      const History of_point = law_.initial_history(stress[k]);
      for (std::size_t h = 0; h < Law::history; ++h) committed_[count_ * h + k] = of_point[h];
    }
  }

  std::vector<PointArray> arrays() const override {
    return {{"history, committed", Law::history * Base::real}, {"history, trial", Law::history * Base::real}};
  }
  std::vector<std::pair<std::string, ConstVec>> shown_history() const override {
    std::vector<std::pair<std::string, ConstVec>> shown;
    for (std::size_t h = 0; h < Law::history; ++h) {
      if (Law::history_names[h].empty()) continue;
      shown.emplace_back(Law::history_names[h], ConstVec(committed_).subspan(count_ * h, count_));
    }
    return shown;
  }

 private:
  History history(std::size_t p) const {
    History of_point;
    for (std::size_t h = 0; h < Law::history; ++h) of_point[h] = committed_[count_ * h + p - begin_];
    return of_point;
  }

  std::vector<double> committed_;  // (history × points)
};

}  // namespace stillpoint
