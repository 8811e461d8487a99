// Material laws with history, applied to blocks of points.
#pragma once

#include <stillpoint/unroll.hpp>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "base/inlining.hpp"
#include "space/materials/history_base.hpp"

namespace stillpoint {

/// A law with history whose size is known when it is compiled.
template <HistoryLaw Law>
class HistoryMaterial final : public HistoryBase<Law> {
  using Base = HistoryBase<Law>;
  using Base::components, Base::law_, Base::begin_, Base::count_, Base::K, Base::group;
  using typename Base::Block, typename Base::ModuliMatrix, typename Base::Tensor, typename Base::Stresses;
  using History = typename Law::History;

 public:
  HistoryMaterial(const Law& law, std::size_t begin, std::size_t count)
      : Base(law, begin, count,
             {.viscous = law.is_viscous(),
              .stress_stays = law.stress_stays(),
              .needs_pressure = Law::needs_pressure,
              .wave_modulus = law.elastic_moduli({}, law.initial_history({}))[0]},
             Law::history) {
    Base::set_stress(std::vector<Stresses>(count, Stresses{}), {});
  }

  double stress(Block& block, const double* V, double dt, double* trial) const override {
    const double* from = Base::committed_at(block.first);
    double* to = Base::trial_at(trial, block.first);
    if (block.count >= group) return answer(block, block.count, V + block.first, dt, from, to, count_);
    return answer_few(block, V + block.first, dt, from, to);
  }
  [[gnu::flatten]] double committed_stress(Block& block, const double* V) const override {
    const Law law = law_;
    return loop(
        block, V, [law](std::size_t, const History& now) __attribute__((always_inline)) {
          return tensor_of<K>(law.cauchy(now));
        });
  }
  STILLPOINT_FLATTEN void tangent(Tangent kind, Block& block, const double* V, double dt) const override {
    if (kind == Tangent::consistent) return Base::tangent(kind, block, V, dt);
    const Law law = law_;
    loop(
        block, V, [ law, &block ](std::size_t q, const History& now) __attribute__((always_inline)) {
          return law.elastic_rate(block.H_at(q), block.direction_at(q), now);
        });
  }

  ModuliMatrix moduli(Tangent kind, const Tensor& H, const Tensor& dH, double dt, std::size_t p) const override {
    return kind == Tangent::elastic ? law_.elastic_moduli(H, history(p)) : law_.moduli(H, dH, dt, history(p));
  }
  Stresses cauchy(const Tensor&, std::size_t p) const override { return law_.cauchy(history(p)); }
  std::optional<YieldState> yield_state(std::size_t p) const override { return law_.yield_state(history(p)); }

  double wave_modulus() const override {
    if constexpr (Law::needs_pressure || !Law::place_rows.empty()) {
      double largest = 0;
      for (std::size_t k = 0; k < count_; ++k) {
        const IsotropicModuli at = law_.moduli_at(history(begin_ + k));
        largest = std::max(largest, at.bulk + 4 * at.shear / 3);
      }
      return largest;
    }
    return Base::wave_modulus();
  }

  Vec by_place(std::string_view parameter) override {
    for (const PlaceRow& place : Law::place_rows)
      if (place.parameter == parameter) return Base::row(place.row);
    return {};
  }

 private:
  // V P and the next history of the first `count` points in the block, a group or more. volume: theirs; from, to: their
  // histories, entry h of point q at [n h + q].
  [[gnu::noinline, gnu::flatten]] double answer(Block& block, std::size_t count, const double* volume, double dt,
                                                const double* from, double* to, std::size_t n) const {
    const Law law = law_;
    const auto point = [&](std::size_t q) __attribute__((always_inline)) {
      History next;
      unroll<Law::history>([&](auto h) __attribute__((always_inline)) { next[h] = from[n * h + q]; });
      const Tensor P = law.first_piola(block.H_at(q), block.dH_at(q), dt, next);
      unroll<Law::history>([&](auto h) __attribute__((always_inline)) { to[n * h + q] = next[h]; });
      return block.store_stress(q, volume[q], P);
    };
    return Base::sum_in_groups(count, point);
  }
  // The same of fewer points: copies of the last one complete the group, so that they go through the same loop and have
  // the bits that they have in any other block.
  double answer_few(Block& block, const double* volume, double dt, const double* from, double* to) const {
    std::array<double, group> volumes;
    std::array<double, group * Law::history> now, next;
    for (std::size_t q = 0; q < group; ++q) {
      const std::size_t p = std::min(q, block.count - 1);
      volumes[q] = volume[p];
      for (auto* rows : {&block.H, &block.dH})
        for (auto& row : *rows) row[q] = row[p];
      for (std::size_t h = 0; h < Law::history; ++h) now[group * h + q] = from[count_ * h + p];
    }
    const double bad = answer(block, group, volumes.data(), dt, now.data(), next.data(), group);
    for (std::size_t h = 0; h < Law::history; ++h)
      for (std::size_t q = 0; q < block.count; ++q) to[count_ * h + q] = next[group * h + q];
    return bad;
  }
  void write_initial(const Stresses& stress, const InitialPoint& point, double* to) const override {
    std::ranges::copy(law_.initial_history(stress, point), to);
  }
  std::string_view name_of(std::size_t row) const override { return Law::history_names[row]; }

  // Stores answer(q, committed history of point q) as the block's V P.
  template <class Answer>
  [[gnu::always_inline]] double loop(Block& block, const double* V, const Answer& answer) const {
    const double* from = Base::committed_at(block.first);
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
    Base::read(p, of_point.data());
    return of_point;
  }
};

}  // namespace stillpoint
