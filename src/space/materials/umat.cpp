#include "space/materials/umat.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "base/text.hpp"
#include "space/materials/turned_increment.hpp"
#include "space/materials/umat_calls.hpp"
#include "space/materials/umat_library.hpp"

namespace stillpoint {
namespace {

/// What a UMAT answers to a probe, twice the same only if it keeps nothing.
struct ProbedAnswer {
  std::array<double, 6> stress;
  std::array<double, 36> ddsdde;
  std::vector<double> statev;
  double pnewdt;

  /// The first argument in which two answers differ; empty: they have the same bits.
  static std::string_view difference(const ProbedAnswer& a, const ProbedAnswer& b) {
    const auto same = [](const auto& x, const auto& y) {
      return std::ranges::equal(x, y, [](double p, double q) {  // what is no number is so in many ways
        return std::bit_cast<std::uint64_t>(p) == std::bit_cast<std::uint64_t>(q) || (std::isnan(p) && std::isnan(q));
      });
    };
    if (!same(a.stress, b.stress)) return "STRESS";
    if (!same(a.statev, b.statev)) return "STATEV";
    if (!same(a.ddsdde, b.ddsdde)) return "DDSDDE";
    return a.pnewdt == b.pnewdt ? "" : "PNEWDT";
  }
};

template <StressState S>
class Umat final : public HistoryAnswers, private UmatCalls<S> {
  using Calls = UmatCalls<S>;
  using Calls::components, Calls::tensor, Calls::dim, Calls::nan, Calls::block, Calls::library_, Calls::props_,
      Calls::states_, Calls::has_left_, Calls::umat_row, Calls::call_for, Calls::gradient, Calls::ours;
  using typename Calls::Work;

 public:
  Umat(const MaterialSpec& material, std::shared_ptr<UmatLibrary> library)
      : HistoryAnswers({.names = Calls::names_of(material)}),
        Calls(material, std::move(library)),
        material_(material.name) {
    constexpr int watched_blocks = 32;
    library_->watch(watched_blocks);
  }

  void first_piola(const PointsWithHistory& all) const noexcept override {
    const auto turn = library_->turn();
    for (std::size_t begin = 0; begin < all.points; begin += block) {
      PointsWithHistory at = all;
      at.points = std::min(block, all.points - begin);
      for (const double** values : {&at.H, &at.dH, &at.committed}) *values += begin;
      for (double** values : {&at.P, &at.next}) *values += begin;
      Calls::answer_block(at);
    }
    if (library_->is_watched()) {
      library_->look_for_state();
      library_->count_watched();
    }
  }

  void moduli(const double* H, const double* dH, double dt, const double* committed,
              double* A) const noexcept override {
    Work& work = Calls::work();
    if (!call_for(H, dH, dt, committed, work)) return static_cast<void>(std::fill_n(A, components * components, nan));
    const auto by = turned_increment<S, Dual<components>>(variables(gradient(H)), variables(gradient(dH)));
    std::ranges::copy(moduli_of_increment<S>(gradient(H), by, ours(work.call.stress), Calls::moduli_of(work.call)), A);
  }

  // With the symmetric part of DDSDDE without strain.
  void elastic_moduli(const double* H, const double* committed, double* A) const noexcept override {
    Work& work = Calls::work();
    if (!call_for(H, nothing_.data(), 0, committed, work))
      return static_cast<void>(std::fill_n(A, components * components, nan));
    const StrainModuli<S> D = Calls::moduli_of(work.call);
    StrainModuli<S> C = D;
    for (std::size_t a = 0; a < tensor; ++a) {
      for (std::size_t b = 0; b < tensor; ++b) C[a][b] = (D[a][b] + D[b][a]) / 2;
    }
    Stress<S> sigma;
    std::copy_n(committed, tensor, sigma.begin());
    std::ranges::copy(elastic_moduli_of<S>(gradient(H), sigma, C), A);
  }
  void cauchy(const double* committed, double* sigma) const noexcept override { std::copy_n(committed, tensor, sigma); }
  void initial_history(const double* sigma, double* first) const noexcept override {
    std::fill_n(first, history(), 0.0);
    std::copy_n(sigma, tensor, first);
  }
  void place(const std::array<double, 3>& position, int number, double cell, double* history) const override {
    std::copy_n(position.begin(), dim, history + Calls::row_of_position());
    history[Calls::row_of_number()] = number;
    history[Calls::row_of_cell()] = cell;
  }

  void try_out(const double* history) const override {
    check_answer_at_rest(history);
    // All points of a body are alike, or nearly so: of n points the first, the second, the fourth …
    if (const std::size_t point = tried_++; (point & (point - 1)) == 0) look_for_state(history);
  }
  bool depends_on_time() const override { return depends_on_time_; }
  void throw_what_failed() const override {
    if (has_left_.exchange(false))
      throw std::runtime_error(fmt::format("the UMAT of material.{} cannot go on: it called XIT", material_));
  }
  std::vector<std::string> notes() const override {
    library_->look_for_state();
    std::vector<std::string> notes;
    if (library_->keeps_state())
      notes.push_back(
          fmt::format("the UMAT of material.{} writes to variables of its own (SAVE, COMMON, static): its calls take "
                      "turns, and more threads make them no quicker",
                      material_));
    if (depends_on_time_)
      notes.push_back(
          fmt::format("the UMAT of material.{} answers to the rate of strain: whether the body creeps on at the end is "
                      "not known",
                      material_));
    return notes;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw std::domain_error("the UMAT " + what); }
  static std::string told(const double* values, std::size_t count) {
    return fmt::format("[{:.12g}]", fmt::join(values, values + count, ", "));
  }
  std::string first_call(const double* history) const {
    Stress<S> stress;
    for (std::size_t a = 0; a < tensor; ++a) stress[umat_row(a)] = history[a];
    return fmt::format("in its first call, without strain and under STRESS = {}", told(stress.data(), tensor));
  }

  void check_answer_at_rest(const double* history) const {
    has_left_ = false;  // what it did without any stress does not count
    Work& work = Calls::work();
    const UmatArguments& call = work.call;
    if (!call_for(nothing_.data(), nothing_.data(), 0, history, work)) {
      has_left_ = false;
      refuse("calls XIT " + first_call(history));
    }
    const auto finite = [](const double* values, std::size_t count) {
      return std::all_of(values, values + count, [](double x) { return std::isfinite(x); });
    };
    if (!finite(call.stress.data(), tensor))
      refuse(fmt::format("returns STRESS = {} {}; expected numbers", told(call.stress.data(), tensor),
                         first_call(history)));
    if (!finite(call.statev.data(), states_))
      refuse(fmt::format("returns STATEV = {} {}; expected numbers", told(call.statev.data(), states_),
                         first_call(history)));
    if (!finite(call.ddsdde.data(), tensor * tensor))
      refuse(fmt::format("returns a DDSDDE with what is no number {}; expected moduli", first_call(history)));
    if (call.pnewdt < 1)
      refuse(fmt::format("asks for a smaller step (PNEWDT = {:.6g}) {}", call.pnewdt, first_call(history)));
    using Matrix = Eigen::Matrix<double, static_cast<int>(tensor), static_cast<int>(tensor)>;
    const Eigen::Map<const Matrix> C(call.ddsdde.data());
    const Matrix symmetric = (C + C.transpose()) / 2;
    if (symmetric.llt().info() == Eigen::Success) return;
    const double least = Eigen::SelfAdjointEigenSolver<Matrix>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()(0);
    refuse(
        fmt::format("returns a DDSDDE that is not positive definite (least eigenvalue {:.3g}) {}; expected the elastic "
                    "moduli [Pa]",
                    least, first_call(history)));
  }

  ProbedAnswer probe(const double* history, std::size_t component, double strain, double dt) const {
    Work& work = Calls::work();
    UmatArguments& call = work.call;
    Gradient<S> dH{};
    dH[component] = strain;
    if (!call_for(dH.data(), dH.data(), dt, history, work)) {
      has_left_ = false;
      call.stress.fill(nan);
    }
    if (!std::equal(props_.begin(), props_.end(), call.props.begin()))
      refuse("writes to PROPS, which are the same for all points; expected them to be read alone");
    return {call.stress,
            call.ddsdde,
            {call.statev.begin(), call.statev.begin() + static_cast<std::ptrdiff_t>(states_)},
            call.pnewdt};
  }
  /// Asks the same things forwards and backwards, elastic ones and ones at which most materials yield.
  void look_for_state(const double* history) const {
    library_->look_for_state();
    std::vector<std::pair<std::size_t, double>> questions;
    for (const double strain : {1e-6, 1e-4, 1e-2}) {
      for (std::size_t k = 0; k < components; ++k) {
        questions.emplace_back(k, strain);
        questions.emplace_back(k, -strain);
      }
    }
    std::vector<ProbedAnswer> answers;
    for (const auto& [component, strain] : questions) answers.push_back(probe(history, component, strain, 1));
    library_->look_for_state();
    for (std::size_t k = questions.size(); k-- > 0;) {
      const auto& [component, strain] = questions[k];
      const std::string_view other = ProbedAnswer::difference(probe(history, component, strain, 1), answers[k]);
      if (!other.empty())
        refuse(
            fmt::format("answers a call that is repeated with another {}: it keeps a state of its own between calls; "
                        "expected an answer that depends on the arguments alone, with the state in STATEV",
                        other));
    }
    library_->look_for_state();
    for (std::size_t k = 0; k < questions.size(); ++k) {
      const ProbedAnswer slow = probe(history, questions[k].first, questions[k].second, 1e3);
      constexpr double rounding = 1e-9;
      double size = 0, apart = 0;
      for (std::size_t a = 0; a < tensor; ++a) {
        size = std::max(size, std::abs(slow.stress[a]));
        apart = std::max(apart, std::abs(slow.stress[a] - answers[k].stress[a]));
      }
      if (apart > rounding * size) depends_on_time_ = true;
    }
  }

  static constexpr Gradient<S> nothing_{};
  std::string material_;
  mutable std::atomic<std::size_t> tried_ = 0;
  mutable std::atomic<bool> depends_on_time_ = false;
};

}  // namespace

template <StressState S>
std::shared_ptr<const HistoryAnswers> make_umat(const MaterialSpec& material) {
  return std::make_shared<Umat<S>>(material, UmatLibrary::open(material.library));
}

template std::shared_ptr<const HistoryAnswers> make_umat<StressState::plane_strain>(const MaterialSpec&);
template std::shared_ptr<const HistoryAnswers> make_umat<StressState::axisymmetric>(const MaterialSpec&);
template std::shared_ptr<const HistoryAnswers> make_umat<StressState::space>(const MaterialSpec&);

std::optional<LawFault> fault_of_umat(const MaterialSpec& material) {
  try {
    UmatLibrary::open(material.library);
    return std::nullopt;
  } catch (const std::domain_error& fault) {
    return LawFault{"library", fault.what()};
  }
}

}  // namespace stillpoint
