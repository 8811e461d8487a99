// Laws with a history that is known as they run, applied to blocks of points: a program's own, and those of shared
// libraries.
#pragma once

#include <stillpoint/own_history_law.hpp>
#include <stillpoint/unroll.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene/throw_scene_error.hpp"
#include "space/materials/history_base.hpp"

namespace stillpoint {

/// What answers for a material in a stress state.
template <StressState S>
struct OwnHistoryLaw {
  static constexpr StressState state = S;
  std::shared_ptr<const HistoryAnswers> answers;
};

/// The material of such a law. One virtual call serves a block, whose loop is compiled where the law is.
template <StressState S>
class OwnHistoryMaterial final : public HistoryBase<OwnHistoryLaw<S>> {
  using Base = HistoryBase<OwnHistoryLaw<S>>;
  using Base::components, Base::count_, Base::K;
  using typename Base::Block, typename Base::ModuliMatrix, typename Base::Tensor, typename Base::Stresses;
  static constexpr std::size_t stride = Block::size + Block::slack;

 public:
  /// key: of the scene, to which a law's faults belong.
  OwnHistoryMaterial(std::shared_ptr<const HistoryAnswers> answers, std::string key, std::size_t begin,
                     std::size_t count)
      : Base({answers}, begin, count,
             {.viscous = answers->traits().viscous, .stress_stays = answers->traits().stress_stays},
             answers->history()),
        key_(std::move(key)) {
    Base::set_stress(std::vector<Stresses>(count, Stresses{}), {});
    this->set_wave_modulus(modulus_of(0));
  }

  double stress(Block& block, const double* V, double dt, double* trial) const override {
    alignas(64) typename Block::Rows P;
    {
      const auto turn = take_turn();
      law().first_piola({.points = block.count,
                         .stride = stride,
                         .H = block.H[0].data(),
                         .dH = block.dH[0].data(),
                         .P = P[0].data(),
                         .dt = dt,
                         .history_stride = count_,
                         .committed = Base::committed_at(block.first),
                         .next = Base::trial_at(trial, block.first)});
    }
    return store(block, V, P);
  }
  double committed_stress(Block& block, const double* V) const override {
    alignas(64) typename Block::Rows P;
    for (std::size_t q = 0; q < block.count; ++q) {
      const Tensor sigma = tensor_of<K>(cauchy({}, block.first + q));
      for (int c = 0; c < components; ++c) P[c][q] = sigma[c];
    }
    return store(block, V, P);
  }
  ModuliMatrix moduli(Tangent kind, const Tensor& H, const Tensor& dH, double dt, std::size_t p) const override {
    ModuliMatrix A;
    with_history(p, [&](const double* committed) {
      const auto turn = take_turn();
      if (kind == Tangent::elastic) {
        law().elastic_moduli(H.data(), committed, A.data());
      } else {
        law().moduli(H.data(), dH.data(), dt, committed, A.data());
      }
    });
    return A;
  }
  Stresses cauchy(const Tensor&, std::size_t p) const override {
    Stresses sigma;
    with_history(p, [&](const double* committed) { law().cauchy(committed, sigma.data()); });
    return sigma;
  }
  std::optional<YieldState> yield_state(std::size_t p) const override {
    std::optional<YieldState> found;
    with_history(p, [&](const double* committed) { found = law().yield_state(committed); });
    return found;
  }

  void begin(const PointPlaces& places) override {
    const double without_stress = this->info().wave_modulus;
    double largest = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const PlaceOfPoint at = places(k);
      with_history(Base::begin_ + k, [&](double* history) {
        law().place(at.position, at.number, at.cell, history);
        for (std::size_t h = 0; h < Base::rows(); ++h) Base::row(h)[k] = history[h];
        try {
          const auto turn = take_turn();
          law().try_out(history);
        } catch (const std::domain_error& fault) {
          throw_scene_error(key_, fault.what());
        }
      });
      largest = std::max(largest, modulus_of(k));
    }
    this->set_viscous(law().depends_on_time());
    // Where stiffness does not depend on stress, rounding is no reason for another one.
    constexpr double rounding = 1e-9;
    if (!(std::abs(largest - without_stress) <= rounding * largest)) this->set_wave_modulus(largest);
  }
  void throw_what_failed() const override { law().throw_what_failed(); }
  std::vector<std::string> notes() const override { return law().notes(); }

 private:
  const HistoryAnswers& law() const { return *this->law_.answers; }
  std::unique_lock<std::mutex> take_turn() const {
    return law().traits().one_at_a_time ? std::unique_lock(one_at_a_time_) : std::unique_lock<std::mutex>();
  }
  void write_initial(const Stresses& stress, const InitialPoint& point, double* history) const override {
    law().initial_history(stress.data(), history);
    if (Base::rows() > 0 && name_of(Base::rows() - 1) == "pore_pressure")
      history[Base::rows() - 1] = point.pore_pressure;
  }
  std::string_view name_of(std::size_t row) const override { return law().traits().names[row]; }
  // ∂P_xx/∂H_xx under the committed stress, without its own part −σ_xx.
  double modulus_of(std::size_t k) const {
    if (count_ == 0) return 0;
    const std::size_t p = Base::begin_ + k;
    return moduli(Tangent::elastic, {}, {}, 0, p)[0] + cauchy({}, p)[0];
  }

  double store(Block& block, const double* V, const typename Block::Rows& P) const {
    const double* volume = V + block.first;
    return Base::sum_in_groups(
        block.count, [&](std::size_t q) __attribute__((always_inline)) {
          Tensor of_point;
          unroll<components>([&](auto c) __attribute__((always_inline)) { of_point[c] = P[c][q]; });
          return block.store_stress(q, volume[q], of_point);
        });
  }
  // Calls use() with a copy of the committed history of a point.
  template <class Use>
  void with_history(std::size_t p, const Use& use) const {
    static thread_local std::vector<double> history;
    history.resize(std::max(history.size(), Base::rows()));
    Base::read(p, history.data());
    use(history.data());
  }

  std::string key_;
  mutable std::mutex one_at_a_time_;
};

}  // namespace stillpoint
