// User-defined laws applied to blocks of points.
#pragma once

#include <stillpoint/unroll.hpp>

#include <memory>
#include <utility>

#include "space/materials/elastic_material.hpp"
#include "space/materials/material_laws.hpp"

namespace stillpoint {

/// A user-defined law at a single point.
template <StressState S>
class OwnLawAtPoint {
 public:
  static constexpr StressState state = S;
  static constexpr bool finite_strain = true;  // assumed, as nothing is known of the law

  explicit OwnLawAtPoint(std::shared_ptr<const LawAnswers> answers) : answers_(std::move(answers)) {}

  Gradient<S> first_piola(const Gradient<S>& H) const {
    Gradient<S> P;
    answers_->first_piola(1, 1, H.data(), P.data());
    return P;
  }
  Stress<S> cauchy(const Gradient<S>& H) const {
    Stress<S> sigma;
    answers_->cauchy(H.data(), sigma.data());
    return sigma;
  }
  Moduli<S> moduli(const Gradient<S>& H) const {
    Moduli<S> A;
    answers_->moduli(H.data(), A.data());
    return A;
  }
  const LawAnswers& answers() const { return *answers_; }

 private:
  std::shared_ptr<const LawAnswers> answers_;
};

/// The material of a user-defined law. One virtual call serves a block, whose loop the program has compiled.
template <StressState S>
class OwnMaterial final : public ElasticMaterial<OwnLawAtPoint<S>> {
  using Base = ElasticMaterial<OwnLawAtPoint<S>>;
  using Base::components, Base::law_, Base::moved;
  using typename Base::Block, typename Base::Tensor;
  static constexpr std::size_t stride = Block::size + Block::slack;

 public:
  using Base::Base;

  [[gnu::flatten]] double stress(Block& block, const double* V, double /*dt*/, double* /*trial*/) const override {
    const double* volume = V + block.first;
    const std::size_t first = block.first;
    alignas(64) Rows P;
    if (!moved()) {
      law_.answers().first_piola(block.count, stride, block.H[0].data(), P[0].data());
      return Base::sum_in_groups(
          block.count, [&](std::size_t q)
                           __attribute__((always_inline)) { return block.store_stress(q, volume[q], row(P, q)); });
    }
    alignas(64) Rows total;  // H of f F_0
    Base::sum_in_groups(
        block.count, [&](std::size_t q) __attribute__((always_inline)) {
          const Tensor H = Base::total(Base::H0(first + q), block.H_at(q));
          unroll<components>([&](auto c) __attribute__((always_inline)) { total[c][q] = H[c]; });
          return 0.0;
        });
    law_.answers().first_piola(block.count, stride, total[0].data(), P[0].data());
    return Base::sum_in_groups(
        block.count, [&](std::size_t q) __attribute__((always_inline)) {
          return block.store_stress(q, volume[q], Base::push(plus_identity<Base::K>(Base::H0(first + q)), row(P, q)));
        });
  }

 private:
  using Rows = typename Block::Rows;

  [[gnu::always_inline]] static Tensor row(const Rows& rows, std::size_t q) {
    Tensor tensor;
    unroll<components>([&](auto c) __attribute__((always_inline)) { tensor[c] = rows[c][q]; });
    return tensor;
  }
};

}  // namespace stillpoint
