// A law of the program's own applied to blocks of points.
#pragma once

#include <memory>
#include <utility>

#include "space/materials/elastic_material.hpp"
#include "space/materials/material_laws.hpp"

namespace stillpoint {

/// Such a law at a single point.
template <StressState S>
class OwnLawAtPoint {
 public:
  static constexpr StressState state = S;
  static constexpr bool finite_strain = true;  // for all that is known

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

/// One virtual call serves a block, whose loop the program has compiled.
template <StressState S>
class OwnMaterial final : public ElasticMaterial<OwnLawAtPoint<S>> {
  using Base = ElasticMaterial<OwnLawAtPoint<S>>;
  using Base::components, Base::law_, Base::moved;
  using typename Base::Block, typename Base::Tensor;
  static constexpr std::size_t stride = Block::size + Block::slack;

 public:
  using Base::Base;

  double stress(Block& block, const double* V, double /*dt*/, double* /*trial*/) const override {
    const std::size_t first = block.first;
    if (!moved()) {
      law_.answers().first_piola(block.count, stride, block.H[0].data(), block.VP[0].data());
    } else {
      alignas(64) typename Block::Rows total;
      for (std::size_t q = 0; q < block.count; ++q) {
        const Tensor H = Base::total(Base::F0(first + q), block.H_at(q));
        for (std::size_t c = 0; c < components; ++c) total[c][q] = H[c];
      }
      law_.answers().first_piola(block.count, stride, total[0].data(), block.VP[0].data());
    }
    double bad = 0;
    for (std::size_t q = 0; q < block.count; ++q) {
      Tensor P;
      for (std::size_t c = 0; c < components; ++c) P[c] = block.VP[c][q];
      bad += block.store_stress(q, V[first + q], moved() ? Base::push(Base::F0(first + q), P) : P);
    }
    return bad;
  }
};

}  // namespace stillpoint
