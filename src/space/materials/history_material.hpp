// Material laws with history, applied to blocks of points.
#pragma once

#include <stillpoint/unroll.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "space/materials/law_material.hpp"

namespace stillpoint {

/// A law with history. A trial does not change the committed history; committing swaps the two.
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
              .viscous = law.is_viscous(),
              .stress_stays = law.stress_stays(),
              .needs_pressure = Law::needs_pressure,
              .history_size = Law::history * count,
              .wave_modulus = law.elastic_moduli({}, law.initial_history({}))[0]}) {
    set_stress(std::vector<Stresses>(count, Stresses{}), {});
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
    const Law law = law_;
    return loop(
        block, V, [law](std::size_t, const History& now) __attribute__((always_inline)) {
          return tensor_of<K>(law.cauchy(now));
        });
  }
  [[gnu::flatten]] void tangent(Tangent kind, Block& block, const double* V, double dt) const override {
    if (kind == Tangent::consistent) return Base::tangent(kind, block, V, dt);
    const Law law = law_;
    loop(
        block, V, [ law, &block ](std::size_t q, const History& now) __attribute__((always_inline)) {
          return law.elastic_rate(block.H_at(q), block.direction_at(q), now);
        });
  }
  void commit(std::vector<double>& trial) override { committed_.swap(trial); }

  ModuliMatrix moduli(Tangent kind, const Tensor& H, const Tensor& dH, double dt, std::size_t p) const override {
    return kind == Tangent::elastic ? law_.elastic_moduli(H, history(p)) : law_.moduli(H, dH, dt, history(p));
  }
  Stresses cauchy(const Tensor&, std::size_t p) const override { return law_.cauchy(history(p)); }
  std::optional<YieldState> yield_state(std::size_t p) const override { return law_.yield_state(history(p)); }

  double wave_modulus() const override {
    if constexpr (Law::needs_pressure) {
      double largest = 0;
      for (std::size_t k = 0; k < count_; ++k) {
        const IsotropicModuli at = law_.moduli_at(history(begin_ + k));
        largest = std::max(largest, at.bulk + 4 * at.shear / 3);
      }
      return largest;
    }
    return Base::wave_modulus();
  }

  Vec strength_shares() override {
    if constexpr (Law::share_row != no_share_row) return Vec(committed_).subspan(count_ * Law::share_row, count_);
    return {};
  }

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
  void set_stress(const std::vector<Stresses>& stress, const InitialGround& ground) override {
    committed_.resize(Law::history * count_);
    for (std::size_t k = 0; k < count_; ++k) {
      const double factor = ground.factors.empty() ? 1 : ground.factors[k];
      const History of_point = law_.initial_history(stress[k], {.at_rest = ground.at_rest, .factor = factor});
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
  // Stores answer(q, committed history of point q) as the block's V P.
  template <class Answer>
  [[gnu::always_inline]] double loop(Block& block, const double* V, const Answer& answer) const {
    const double* from = committed_.data() + block.first - begin_;
    const double* volume = V + block.first;
    const std::size_t n = count_;
    const auto point = [&](std::size_t q) __attribute__((always_inline)) {
      History now;
      unroll<Law::history>([&](auto h) __attribute__((always_inline)) { now[h] = from[n * h + q]; });
      return block.store_stress(q, volume[q], answer(q, now));
    };
    return Base::sum_in_groups(block.count, point);
  }
  History history(std::size_t p) const {
    History of_point;
    for (std::size_t h = 0; h < Law::history; ++h) of_point[h] = committed_[count_ * h + p - begin_];
    return of_point;
  }

  std::vector<double> committed_;  // (history × points)
};

}  // namespace stillpoint
