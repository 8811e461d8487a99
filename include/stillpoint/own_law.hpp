// An elastic law of a program's own, which scenes then name like any other.
//
//   template <stillpoint::StressState S>
//   struct Yeoh {  // an ElasticLaw
//     static constexpr stillpoint::StressState state = S;
//     static constexpr bool finite_strain = true;
//     explicit Yeoh(const stillpoint::LawParameters& p) : … p.at("C10") … {}
//     stillpoint::Gradient<S> first_piola(const stillpoint::Gradient<S>& H) const …
//   };
//   add_law<Yeoh, StressState::plane_strain, StressState::space>(
//       {.name = "yeoh", .parameters = {{.name = "C10"}, …}});
#pragma once

#include <stillpoint/material.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace stillpoint {

/// A key of [material.<name>] that a law takes, a number with lower < value < upper.
struct OwnParameter {
  std::string name, unit = "1", meaning{};
  double lower = 0, upper = std::numeric_limits<double>::infinity();
  std::optional<double> fallback{};  // empty: it has to be given
};

struct OwnLaw {
  std::string name;  // of material.<name>.law: lower-case letters, digits and hyphens
  std::string equation{}, source{};
  std::vector<OwnParameter> parameters{};  // beside the density rho, which every law has
};

/// Their values by name, all of them.
using LawParameters = std::map<std::string, double>;

/// What a law answers to deformations, in plain arrays: of one stress state and one set of parameters. Several threads
/// ask at once, and nothing may be thrown: a trial that cannot be evaluated gets NaN.
class LawAnswers {
 public:
  virtual ~LawAnswers() = default;
  /// P [Pa] of some points at once; component c of point q at [stride c + q] of H and P, which do not overlap.
  virtual void first_piola(std::size_t points, std::size_t stride, const double* H, double* P) const noexcept = 0;
  /// σ [Pa], (stress components), and ∂P/∂H [Pa], row by row, of one point.
  virtual void cauchy(const double* H, double* sigma) const noexcept = 0;
  virtual void moduli(const double* H, double* A) const noexcept = 0;
};

/// Those of a value type: its loop over the points is compiled where this is named, with that program's flags.
template <ElasticLaw Law>
class AnswersOf final : public LawAnswers {
  static constexpr std::size_t components = gradient_components(Law::state);
  using Tensor = Gradient<Law::state>;

 public:
  explicit AnswersOf(const Law& law) : law_(law) {}

  [[gnu::flatten]] void first_piola(std::size_t points, std::size_t stride, const double* __restrict H,
                                    double* __restrict P) const noexcept override {
    const Law law = law_;
    // Whole groups fill the processor's registers. What is left is one that begins early enough: a point that it meets
    // again answers the same again, which costs less than a rest of single points.
    constexpr std::size_t group = 8;
    std::size_t begin = 0, end = points < group ? points : points / group * group;
    for (;; begin = points - group, end = points) {
// That rows of P do not overlap either, a compiler cannot see.
#if defined(__clang__)
#pragma clang loop vectorize(assume_safety)
#elif defined(__GNUC__)
#pragma GCC ivdep
#endif
      for (std::size_t q = begin; q < end; ++q) {
        Tensor of_point;
        for_components([&](auto c) __attribute__((always_inline)) { of_point[c] = H[stride * c + q]; });
        const Tensor answer = law.first_piola(of_point);  // called here, as GCC inlines it nowhere deeper
        for_components([&](auto c) __attribute__((always_inline)) { P[stride * c + q] = answer[c]; });
      }
      if (end == points) return;
    }
  }
  void cauchy(const double* H, double* sigma) const noexcept override { std::ranges::copy(law_.cauchy(at(H)), sigma); }
  void moduli(const double* H, double* A) const noexcept override { std::ranges::copy(law_.moduli(at(H)), A); }

 private:
  // body(0), …, written out before the compiler looks for vectors
  template <class Body>
  [[gnu::always_inline]] static void for_components(const Body& body) {
    [&]<std::size_t... c>(std::index_sequence<c...>) __attribute__((always_inline)) {
      (body(std::integral_constant<std::size_t, c>()), ...);
    }
    (std::make_index_sequence<components>());
  }
  static Tensor at(const double* H) {
    Tensor tensor;
    std::copy_n(H, components, tensor.begin());
    return tensor;
  }
  Law law_;
};

/// Makes the answers of a law with these parameters. Throws std::invalid_argument for those that do not go together.
using MakeLaw = std::function<std::unique_ptr<LawAnswers>(const LawParameters&)>;

/// From now on a material may have law = name, in these stress states: of large strain, without a history. In the place
/// of one of that name that was added before; simulations that were set up keep theirs. Throws std::invalid_argument if
/// a name is no word, or one of this library's, or a parameter is called rho or law or by a name twice.
void add_law(const OwnLaw& about, const std::map<StressState, MakeLaw>& of_states);

/// The same of a template of laws, for each of these states, each made of LawParameters.
template <template <StressState> class Law, StressState... states>
void add_law(const OwnLaw& about) {
  static_assert((std::is_constructible_v<Law<states>, const LawParameters&> && ...));
  add_law(about, {{states, [](const LawParameters& parameters) -> std::unique_ptr<LawAnswers> {
                     return std::make_unique<AnswersOf<Law<states>>>(Law<states>(parameters));
                   }}...});
}

}  // namespace stillpoint
