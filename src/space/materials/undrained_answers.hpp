// Saturated ground from which no water flows, with a law whose history is known as it runs for the effective stress.
#pragma once

#include <stillpoint/own_history_law.hpp>
#include <stillpoint/undrained.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace stillpoint {

/// As Undrained: the history of the law is followed by the pore pressure [Pa].
template <StressState S>
class UndrainedAnswers final : public HistoryAnswers {
  static constexpr std::size_t components = gradient_components(S);

 public:
  /// stiffness: K_w/n [Pa].
  UndrainedAnswers(std::shared_ptr<const HistoryAnswers> skeleton, double stiffness)
      : HistoryAnswers(with_water(skeleton->traits())), skeleton_(std::move(skeleton)), stiffness_(stiffness) {}

  void first_piola(const PointsWithHistory& at) const noexcept override {
    skeleton_->first_piola(at);
    const std::size_t row = at.history_stride * skeleton_->history();
    for (std::size_t q = 0; q < at.points; ++q) {
      Gradient<S> H, dH;
      for (std::size_t c = 0; c < components; ++c) {
        H[c] = at.H[at.stride * c + q];
        dH[c] = at.dH[at.stride * c + q];
      }
      const auto water = water_after<S, double>(H, dH, at.committed[row + q], stiffness_);
      for (std::size_t c = 0; c < components; ++c) at.P[at.stride * c + q] += water.P[c];
      at.next[row + q] = water.pressure;
    }
  }
  void moduli(const double* H, const double* dH, double dt, const double* committed,
              double* A) const noexcept override {
    skeleton_->moduli(H, dH, dt, committed, A);
    const auto water = water_after<S, Dual<components>>(variables(gradient(H)), variables(gradient(dH)),
                                                        committed[skeleton_->history()], stiffness_);
    for (std::size_t a = 0; a < components; ++a) {
      for (std::size_t b = 0; b < components; ++b) A[components * a + b] += water.P[a].derivative[b];
    }
  }
  void elastic_moduli(const double* H, const double* committed, double* A) const noexcept override {
    skeleton_->elastic_moduli(H, committed, A);
    Stress<S> of_water{};
    for (std::size_t a = 0; a < 3; ++a) of_water[a] = -committed[skeleton_->history()];
    const Moduli<S> more = ElasticRate<S>(gradient(H), of_water, stiffness_, 0).moduli();
    for (std::size_t k = 0; k < more.size(); ++k) A[k] += more[k];
  }
  /// The total stress.
  void cauchy(const double* committed, double* sigma) const noexcept override {
    skeleton_->cauchy(committed, sigma);
    for (std::size_t a = 0; a < 3; ++a) sigma[a] -= committed[skeleton_->history()];
  }
  /// For ground under this effective stress.
  void initial_history(const double* sigma, double* first) const noexcept override {
    skeleton_->initial_history(sigma, first);
    first[skeleton_->history()] = 0;
  }
  std::optional<YieldState> yield_state(const double* committed) const noexcept override {
    return skeleton_->yield_state(committed);
  }
  void place(const std::array<double, 3>& position, int number, double cell, double* history) const override {
    skeleton_->place(position, number, cell, history);
  }
  void try_out(const double* history) const override { skeleton_->try_out(history); }
  void throw_what_failed() const override { skeleton_->throw_what_failed(); }
  std::vector<std::string> notes() const override { return skeleton_->notes(); }

 private:
  static HistoryTraits with_water(HistoryTraits traits) {
    traits.names.emplace_back("pore_pressure");
    return traits;
  }
  static Gradient<S> gradient(const double* H) {
    Gradient<S> of_point;
    std::copy_n(H, components, of_point.begin());
    return of_point;
  }

  std::shared_ptr<const HistoryAnswers> skeleton_;
  double stiffness_;
};

}  // namespace stillpoint
