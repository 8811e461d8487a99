// User-defined laws with a history, which scenes name like the built-in ones: plasticity, damage, whatever depends on
// more than the deformation of now.
//
//   template <stillpoint::StressState S>
//   struct MySoil {  // a HistoryLaw (material.hpp)
//     static constexpr stillpoint::StressState state = S;
//     explicit MySoil(const stillpoint::LawParameters& p) : … p.at("c") … {}
//     …
//   };
//   add_law<MySoil, StressState::plane_strain, StressState::space>({.name = "my-soil", .parameters = {{.name = "c"},
//   …}});
#pragma once

#include <stillpoint/own_law.hpp>
#include <stillpoint/unroll.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace stillpoint {

/// What is known of a law with a history before it is asked.
struct HistoryTraits {
  /// The names of the numbers that the law remembers at a point, for output; "" is not shown.
  std::vector<std::string> names{};
  bool stress_stays = false;   // a zero increment returns the committed stress, to rounding
  bool viscous = false;        // the stress may exceed the strength for a while: yield_state() is written
  bool one_at_a_time = false;  // it may not be called by two threads at once
};

/// Points in plain arrays: component c of point q is at [stride c + q] of H, dH and P, its number h of the history at
/// [history_stride h + q] of committed and next. H = ∂u/∂x since the phase began, dH the part of it since the history
/// was committed, dt the time since then [s], ≥ 0. The arrays do not overlap.
struct PointsWithHistory {
  std::size_t points, stride;
  const double *H, *dH;
  double* P;  // det(f) σ f⁻ᵀ after the increment [Pa]
  double dt;
  std::size_t history_stride;
  const double* committed;
  double* next;
};

/// The stresses, moduli and histories of a law in plain arrays, for one stress state and one set of parameters, whose
/// history has a size that is known as it runs. The arrays of a single point are contiguous. Several threads call it at
/// once, unless it is one_at_a_time, and nothing may be thrown by what is noexcept: a trial that cannot be evaluated
/// gives NaN, and the solver takes a smaller step.
class HistoryAnswers {
 public:
  explicit HistoryAnswers(HistoryTraits traits) : traits_(std::move(traits)) {}
  virtual ~HistoryAnswers() = default;
  HistoryAnswers(const HistoryAnswers&) = delete;
  HistoryAnswers& operator=(const HistoryAnswers&) = delete;
  const HistoryTraits& traits() const { return traits_; }
  /// The number of numbers that it remembers at a point.
  std::size_t history() const { return traits_.names.size(); }

  virtual void first_piola(const PointsWithHistory& points) const noexcept = 0;
  /// ∂P/∂H [Pa] of first_piola() at one point, row by row, if H and dH change alike.
  virtual void moduli(const double* H, const double* dH, double dt, const double* committed,
                      double* A) const noexcept = 0;
  /// That of an elastic trial, which is symmetric and at least as stiff.
  virtual void elastic_moduli(const double* H, const double* committed, double* A) const noexcept = 0;
  /// The committed σ [Pa], (stress components).
  virtual void cauchy(const double* committed, double* sigma) const noexcept = 0;
  /// The history of a point under this stress, before anything has moved.
  virtual void initial_history(const double* sigma, double* first) const noexcept = 0;
  /// The relation of the committed stress to the strength; empty: not known.
  virtual std::optional<YieldState> yield_state(const double* /*committed*/) const noexcept { return std::nullopt; }

  /// Tells where a point is: its position before the motion [m], its number, the side of a cell there [m]. The law may
  /// write it into the point's history.
  virtual void place(const std::array<double, 3>& /*position*/, int /*number*/, double /*cell*/,
                     double* /*history*/) const {}
  /// Looks at one of the points with which the run begins. Throws std::domain_error, whose text goes to the user, if
  /// the law cannot answer there.
  virtual void try_out(const double* /*history*/) const {}
  /// Whether an increment's answer depends on the time that it takes.
  virtual bool depends_on_time() const { return traits_.viscous; }
  /// Throws what was met since the last call that is no matter of a smaller step; the run ends with it.
  virtual void throw_what_failed() const {}
  /// What users should know of the law as it is found: sentences.
  virtual std::vector<std::string> notes() const { return {}; }

 private:
  HistoryTraits traits_;
};

/// The answers of a law that is a value type: its loop over the points is compiled in the program that names this
/// class, with that program's flags.
template <HistoryLaw Law>
class AnswersWithHistory final : public HistoryAnswers {
  static constexpr std::size_t components = gradient_components(Law::state);
  using Tensor = Gradient<Law::state>;
  using History = typename Law::History;

 public:
  explicit AnswersWithHistory(const Law& law)
      : HistoryAnswers({.names = {Law::history_names.begin(), Law::history_names.end()},
                        .stress_stays = law.stress_stays(),
                        .viscous = law.is_viscous()}),
        law_(law) {}

  [[gnu::flatten]] void first_piola(const PointsWithHistory& at) const noexcept override {
    const Law law = law_;
    const std::size_t stride = at.stride, history_stride = at.history_stride;
    const double* __restrict H = at.H, * __restrict dH = at.dH, * __restrict committed = at.committed;
    double* __restrict P = at.P, * __restrict next = at.next;
    const double dt = at.dt;
    // In whole groups, as AnswersOf has them.
    constexpr std::size_t group = 8;
    std::size_t begin = 0, end = at.points < group ? at.points : at.points / group * group;
    for (;; begin = at.points - group, end = at.points) {
#if defined(__clang__)
#pragma clang loop vectorize(assume_safety)
#elif defined(__GNUC__)
#pragma GCC ivdep
#endif
      for (std::size_t q = begin; q < end; ++q) {
        Tensor of_H, of_dH;
        History of_point;
        unroll<components>([&](auto c) __attribute__((always_inline)) {
          of_H[c] = H[stride * c + q];
          of_dH[c] = dH[stride * c + q];
        });
        unroll<Law::history>([&](auto h)
                                 __attribute__((always_inline)) { of_point[h] = committed[history_stride * h + q]; });
        const Tensor answer = law.first_piola(of_H, of_dH, dt, of_point);
        unroll<components>([&](auto c) __attribute__((always_inline)) { P[stride * c + q] = answer[c]; });
        unroll<Law::history>([&](auto h)
                                 __attribute__((always_inline)) { next[history_stride * h + q] = of_point[h]; });
      }
      if (end == at.points) return;
    }
  }
  void moduli(const double* H, const double* dH, double dt, const double* committed,
              double* A) const noexcept override {
    std::ranges::copy(law_.moduli(tensor(H), tensor(dH), dt, history_at(committed)), A);
  }
  void elastic_moduli(const double* H, const double* committed, double* A) const noexcept override {
    std::ranges::copy(law_.elastic_moduli(tensor(H), history_at(committed)), A);
  }
  void cauchy(const double* committed, double* sigma) const noexcept override {
    std::ranges::copy(law_.cauchy(history_at(committed)), sigma);
  }
  void initial_history(const double* sigma, double* first) const noexcept override {
    Stress<Law::state> of_point;
    std::copy_n(sigma, of_point.size(), of_point.begin());
    std::ranges::copy(law_.initial_history(of_point), first);
  }
  std::optional<YieldState> yield_state(const double* committed) const noexcept override {
    return law_.yield_state(history_at(committed));
  }

 private:
  static Tensor tensor(const double* H) {
    Tensor of_point;
    std::copy_n(H, components, of_point.begin());
    return of_point;
  }
  static History history_at(const double* numbers) {
    History of_point;
    std::copy_n(numbers, Law::history, of_point.begin());
    return of_point;
  }
  Law law_;
};

/// Makes a law from its parameters. Throws std::invalid_argument if they are incompatible.
using MakeHistoryLaw = std::function<std::unique_ptr<HistoryAnswers>(const LawParameters&)>;

/// Registers a law with a history, otherwise as add_law(). fields: the names in its traits, which probes may name.
void add_history_law(const OwnLaw& about, const std::vector<std::string>& fields,
                     const std::map<StressState, MakeHistoryLaw>& of_states);

/// Registers a template of laws with a history for each of these states, each constructed from LawParameters.
template <template <StressState> class Law, StressState... states>
requires(HistoryLaw<Law<states>>&&...) void add_law(const OwnLaw& about) {
  static_assert((std::is_constructible_v<Law<states>, const LawParameters&> && ...));
  std::vector<std::string> fields;
  (fields.insert(fields.end(), Law<states>::history_names.begin(), Law<states>::history_names.end()), ...);
  add_history_law(about, fields, {{states, [](const LawParameters& parameters) -> std::unique_ptr<HistoryAnswers> {
                                     return std::make_unique<AnswersWithHistory<Law<states>>>(Law<states>(parameters));
                                   }}...});
}

}  // namespace stillpoint
