// Material laws without history, applied to blocks of points.
#pragma once

#include <stillpoint/unroll.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/inlining.hpp"
#include "space/materials/law_material.hpp"

namespace stillpoint {

/// A law without history. In a body that moves on it stores the deformation F_0 = I + H_0 with which the phase began:
///   F = f F_0,   P = P_0(F) F_0ᵀ/det F_0   per volume when the phase began,
/// in the form of H_0, and H = f F_0 − I = H + H_0 + H H_0, so that small strains lose no digits beside 1. For a law of
/// small strain H_0 is added to H, and P is the stress as it is. Where Young's modulus varies from place to place, the
/// stress is a factor times that of the law, which is proportional to it.
template <ElasticLaw Law>
class ElasticMaterial : public LawMaterialBase<Law> {
  using Base = LawMaterialBase<Law>;

 protected:
  using Base::components, Base::law_, Base::begin_, Base::count_, Base::K;
  using typename Base::Block, typename Base::ModuliMatrix, typename Base::Tensor, typename Base::Stresses;
  static constexpr bool has_water = requires(const Law& law, const Tensor& H) { law.pore_pressure(H); };

 public:
  ElasticMaterial(const Law& law, std::size_t begin, std::size_t count, bool updated_lagrangian,
                  bool E_by_place = false)
      : Base(law, begin, count,
             {.finite_strain = Law::finite_strain,
              .stress_stays = true,
              .pressure_by_deformation = has_water,
              .wave_modulus = law.moduli({})[0]}),
        moved_(updated_lagrangian),
        E_by_place_(E_by_place) {
    memory_.assign((moved_ ? components : 0) * count, 0.0);
    if (E_by_place_) memory_.insert(memory_.end(), count, 1.0);
  }

  [[gnu::flatten]] double stress(Block& block, const double* V, double /*dt*/, double* /*trial*/) const override {
    const Law law = law_;
    if (!moved()) {
      return loop_by_strain(
          block, V, [&block](std::size_t q) __attribute__((always_inline)) { return block.H_at(q); },
          [law](std::size_t, const Tensor& H) __attribute__((always_inline)) { return law.first_piola(H); },
          [law](std::size_t, const Tensor& H) __attribute__((always_inline)) { return of_small(law, H); });
    }
    const double* of_block = memory_.data() + block.first - begin_;
    const std::size_t n = count_;
    return loop_by_strain(
        block, V, [&block, of_block, n ](std::size_t q) __attribute__((always_inline)) {
          return total(H0_in(of_block, n, q), block.H_at(q));
        },
        [ law, of_block, n ](std::size_t q, const Tensor& H) __attribute__((always_inline)) {
          return push(plus_identity<K>(H0_in(of_block, n, q)), law.first_piola(H));
        },
        [ law, of_block, n ](std::size_t q, const Tensor& H)
            __attribute__((always_inline)) { return push(plus_identity<K>(H0_in(of_block, n, q)), of_small(law, H)); });
  }
  // For a law with P linear in H, δP = P(δH). A law with a rate is quicker by that than by its moduli.
  STILLPOINT_FLATTEN void tangent(Tangent kind, Block& block, const double* V, double dt) const override {
    const Law law = law_;
    if constexpr (!Law::finite_strain) {
      loop(
          block, V, [ law, &block ](std::size_t q) __attribute__((always_inline)) {
            return law.first_piola(block.direction_at(q));
          });
    } else if constexpr (requires(Tensor H) { law.rate(H, H); }) {
      if (!moved()) {
        loop_by_strain(
            block, V, [&block](std::size_t q) __attribute__((always_inline)) { return block.H_at(q); },
            [ law, &block ](std::size_t q, const Tensor& H)
                __attribute__((always_inline)) { return law.rate(H, block.direction_at(q)); },
            [ law, &block ](std::size_t q, const Tensor& H)
                __attribute__((always_inline)) { return rate_of_small(law, H, block.direction_at(q)); });
        return;
      }
      const double* of_block = memory_.data() + block.first - begin_;
      const std::size_t n = count_;
      loop_by_strain(
          block, V, [&block, of_block, n ](std::size_t q) __attribute__((always_inline)) {
            return total(H0_in(of_block, n, q), block.H_at(q));
          },
          [ law, &block, of_block, n ](std::size_t q, const Tensor& H) __attribute__((always_inline)) {
            const Tensor F_0 = plus_identity<K>(H0_in(of_block, n, q));
            return push(F_0, law.rate(H, product<K>(block.direction_at(q), F_0)));
          },
          [ law, &block, of_block, n ](std::size_t q, const Tensor& H) __attribute__((always_inline)) {
            const Tensor F_0 = plus_identity<K>(H0_in(of_block, n, q));
            return push(F_0, rate_of_small(law, H, product<K>(block.direction_at(q), F_0)));
          });
    } else {
      Base::tangent(kind, block, V, dt);
    }
  }
  double committed_stress(Block& block, const double* V) const override { return stress(block, V, 0, nullptr); }
  void commit(std::vector<double>&) override {}

  ModuliMatrix moduli(Tangent, const Tensor& H, const Tensor& /*dH*/, double /*dt*/, std::size_t p) const override {
    ModuliMatrix A = moduli_of_law(H, p);
    for (double& entry : A) entry *= E_over_law(p);
    return A;
  }
  Stresses cauchy(const Tensor& H, std::size_t p) const override {
    Stresses sigma = law_.cauchy(moved() ? total(H0(p), H) : H);
    for (double& component : sigma) component *= E_over_law(p);
    return sigma;
  }
  double pore_pressure(const Tensor& H, std::size_t p) const override {
    if constexpr (has_water) return E_over_law(p) * law_.pore_pressure(moved() ? total(H0(p), H) : H);
    return Base::pore_pressure(H, p);
  }
  double wave_modulus() const override {
    const double of_law = Base::wave_modulus();
    return E_by_place_ && count_ > 0 ? of_law * std::ranges::max(E_row()) : of_law;
  }

  void end_phase(const Block& block) override {
    for (std::size_t q = 0; q < block.count; ++q) {
      const std::size_t p = block.first + q;
      const Tensor H = total(H0(p), block.H_at(q));
      for (std::size_t c = 0; c < components; ++c) memory_[count_ * c + p - begin_] = H[c];
    }
  }
  Vec memory() override { return memory_; }
  Vec by_place(std::string_view parameter) override {
    return E_by_place_ && parameter == "E" ? Vec(memory_).last(count_) : Vec();
  }
  void reorder(const Reordering& order, std::vector<double>&) override {
    std::vector<double> work;
    order.apply(memory_, work, begin_, count_);
  }
  std::size_t memory_rows() const override { return (moved_ ? components : 0) + (E_by_place_ ? 1 : 0); }
  void replace(std::vector<double> memory, std::size_t begin, std::size_t count) override {
    memory_ = std::move(memory);
    begin_ = begin;
    count_ = count;
  }
  void set_stress(const std::vector<Stresses>&, const InitialGround&) override {
    throw std::logic_error("an elastic law has no stress of its own");
  }

  std::vector<PointArray> arrays() const override {
    std::vector<PointArray> all;
    if (moved()) all.push_back({"deformation gradient", components * Base::real});
    if (E_by_place_) all.push_back({"Young's modulus", Base::real});
    return all;
  }
  std::vector<std::pair<std::string, ConstVec>> shown_history() const override { return {}; }

 protected:
  bool moved() const { return moved_; }
  Tensor H0(std::size_t p) const {
    Tensor H;
    for (std::size_t c = 0; c < components; ++c) H[c] = memory_[count_ * c + p - begin_];
    return H;
  }
  // The composition (I + H)(I + H_0) − I.
  static Tensor total(const Tensor& H_0, const Tensor& H) {
    Tensor all = product<K>(H, H_0);
    for (int c = 0; c < components; ++c) all[c] = (Law::finite_strain ? all[c] : 0) + H[c] + H_0[c];
    return all;
  }
  static Tensor push(const Tensor& F_0, const Tensor& P) {
    if constexpr (!Law::finite_strain) return P;
    Tensor pushed = product<K>(P, transposed<K>(F_0));
    const double J = determinant<K>(F_0);
    for (double& component : pushed) component /= J;
    return pushed;
  }

 private:
  ModuliMatrix moduli_of_law(const Tensor& H, std::size_t p) const {
    if (!moved() || !Law::finite_strain) return law_.moduli(H);
    // Column b is the response to a unit dH_b, dF = dH F_0
    const Tensor F_0 = plus_identity<K>(H0(p));
    const ModuliMatrix A = law_.moduli(total(H0(p), H));
    ModuliMatrix pushed{};
    for (int b = 0; b < components; ++b) {
      Tensor dH{};
      dH[b] = 1;
      const Tensor dP = push(F_0, Base::contract(A, product<K>(dH, F_0)));
      for (int a = 0; a < components; ++a) pushed[components * a + b] = dP[a];
    }
    return pushed;
  }

  ConstVec E_row() const { return ConstVec(memory_).last(count_); }
  double E_over_law(std::size_t p) const { return E_by_place_ ? E_row()[p - begin_] : 1; }

  // Whether the law has quicker answers where the strain is small.
  static constexpr bool eases_small_strain = requires(const Law& law, const Tensor& H) { law.is_small(H); };
  [[gnu::always_inline]] static Tensor of_small(const Law& law, const Tensor& H) {
    if constexpr (eases_small_strain) {
      return law.first_piola_of_small(H);
    } else {
      return law.first_piola(H);
    }
  }
  [[gnu::always_inline]] static Tensor rate_of_small(const Law& law, const Tensor& H, const Tensor& dH) {
    if constexpr (eases_small_strain) {
      return law.rate_of_small(H, dH);
    } else {
      return law.rate(H, dH);
    }
  }
  // H_0 of point q of a block whose first is at `of_block`.
  [[gnu::always_inline]] static Tensor H0_in(const double* of_block, std::size_t n, std::size_t q) {
    Tensor H_0;
    unroll<components>([&](auto c) __attribute__((always_inline)) { H_0[c] = of_block[n * c + q]; });
    return H_0;
  }

  using OfBlock = std::array<double, Block::size>;
  // The volumes of a block's points, times E over that of the law; room: for them where that is not 1.
  const double* volumes(const Block& block, const double* V, OfBlock& room) const {
    const double* volume = V + block.first;
    if (!E_by_place_) return volume;
    const double* E = E_row().data() + block.first - begin_;
    for (std::size_t q = 0; q < block.count; ++q) room[q] = volume[q] * E[q];
    return room.data();
  }
  // Stores answer(q), times E over that of the law, as the block's V P.
  template <class Answer>
  [[gnu::always_inline]] double loop(Block& block, const double* V, const Answer& answer) const {
    OfBlock room;
    const double* volume = volumes(block, V, room);
    const auto point = [&](std::size_t q) __attribute__((always_inline)) {
      return block.store_stress(q, volume[q], answer(q));
    };
    return Base::sum_in_groups(block.count, point);
  }
  // The same with full(q, H), or the quicker near(q, H) where the strain of H = H_at(q) is small. What is stored of a
  // point depends on no other: in a block of small strain alone full is just not asked for.
  template <class StrainAt, class Full, class Near>
  [[gnu::always_inline]] double loop_by_strain(Block& block, const double* V, const StrainAt& H_at, const Full& full,
                                               const Near& near) const {
    if constexpr (!eases_small_strain) {
      return loop(
          block, V, [&](std::size_t q) __attribute__((always_inline)) { return full(q, H_at(q)); });
    } else {
      const Law law = law_;
      OfBlock room, is_large;
      const double* volume = volumes(block, V, room);
      const auto first = [&](std::size_t q) __attribute__((always_inline)) {
        const Tensor H = H_at(q);
        is_large[q] = law.is_small(H) ? 0 : 1;
        return block.store_stress(q, volume[q], near(q, H));
      };
      const double bad = Base::sum_in_groups(block.count, first);
      if (std::none_of(is_large.begin(), is_large.begin() + block.count, [](double large) { return large != 0; }))
        return bad;
      const auto then = [&](std::size_t q) __attribute__((always_inline)) {
        const Tensor P = full(q, H_at(q));
        double not_finite = 0;
        unroll<components>([&](auto c) __attribute__((always_inline)) {
          const double kept = block.VP[c][q];
          block.VP[c][q] = is_large[q] != 0 ? volume[q] * P[c] : kept;
          not_finite += 0 * block.VP[c][q];
        });
        return not_finite;
      };
      return Base::sum_in_groups(block.count, then);
    }
  }

  bool moved_, E_by_place_;
  // H_0, unless in a body of a single phase, and E over that of the law if it varies, (components + 1 × points).
  std::vector<double> memory_;
};

}  // namespace stillpoint
