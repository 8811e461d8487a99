// User-defined elastic laws, which scenes name like the built-in ones.
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
#include <stillpoint/unroll.hpp>

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
  std::optional<double> fallback{};  // empty: the scene has to give a value
};

struct OwnLaw {
  std::string name;  // value of material.<name>.law: lower-case letters, digits and hyphens
  std::string equation{}, source{};
  std::vector<OwnParameter> parameters{};  // beside the density rho, which every law has
};

/// The values of all parameters of a law, by name.
using LawParameters = std::map<std::string, double>;

/// The stresses and moduli of a law in plain arrays, for one stress state and one set of parameters. Several threads
/// call it at once, and nothing may be thrown: a trial that cannot be evaluated gives NaN.
class LawAnswers {
 public:
  virtual ~LawAnswers() = default;
  /// P [Pa] of several points; component c of point q is at [stride c + q] of H and P, which do not overlap.
  virtual void first_piola(std::size_t points, std::size_t stride, const double* H, double* P) const noexcept = 0;
  /// σ [Pa], (stress components), and ∂P/∂H [Pa], row by row, of one point.
  virtual void cauchy(const double* H, double* sigma) const noexcept = 0;
  virtual void moduli(const double* H, double* A) const noexcept = 0;
};

/// The answers of a law that is a value type: its loop over the points is compiled in the program that names this
/// class, with that program's flags.
template <ElasticLaw Law>
class AnswersOf final : public LawAnswers {
  static constexpr std::size_t components = gradient_components(Law::state);
  using Tensor = Gradient<Law::state>;

 public:
  explicit AnswersOf(const Law& law) : law_(law) {}

  [[gnu::flatten]] void first_piola(std::size_t points, std::size_t stride, const double* __restrict H,
                                    double* __restrict P) const noexcept override {
    const Law law = law_;
    // Whole groups fill the processor's registers. The remainder is a whole group too, which begins early enough to end
    // at the last point: a point evaluated twice gives the same answer, which costs less than single points.
    constexpr std::size_t group = 8;
    std::size_t begin = 0, end = points < group ? points : points / group * group;
    for (;; begin = points - group, end = points) {
// A compiler cannot see that the rows of P do not overlap either.
#if defined(__clang__)
#pragma clang loop vectorize(assume_safety)
#elif defined(__GNUC__)
#pragma GCC ivdep
#endif
      for (std::size_t q = begin; q < end; ++q) {
        Tensor of_point;
        unroll<components>([&](auto c) __attribute__((always_inline)) { of_point[c] = H[stride * c + q]; });
        const Tensor answer = law.first_piola(of_point);  // called here, as GCC inlines it nowhere deeper
        unroll<components>([&](auto c) __attribute__((always_inline)) { P[stride * c + q] = answer[c]; });
      }
      if (end == points) return;
    }
  }
  void cauchy(const double* H, double* sigma) const noexcept override { std::ranges::copy(law_.cauchy(at(H)), sigma); }
  void moduli(const double* H, double* A) const noexcept override { std::ranges::copy(law_.moduli(at(H)), A); }

 private:
  static Tensor at(const double* H) {
    Tensor tensor;
    std::copy_n(H, components, tensor.begin());
    return tensor;
  }
  Law law_;
};

/// Makes a law from its parameters. Throws std::invalid_argument if they are incompatible.
using MakeLaw = std::function<std::unique_ptr<LawAnswers>(const LawParameters&)>;

/// Registers a law: a material may have law = name, in these stress states, from now on; it is one of large strain,
/// without a history. It replaces a law of that name added before; simulations set up earlier keep theirs. Throws
/// std::invalid_argument if a name is malformed, or one of this library's, or if a parameter is called rho or law, or
/// two have one name.
void add_law(const OwnLaw& about, const std::map<StressState, MakeLaw>& of_states);

/// Registers a template of laws for each of these states, each constructed from LawParameters.
template <template <StressState> class Law, StressState... states>
void add_law(const OwnLaw& about) {
  static_assert((std::is_constructible_v<Law<states>, const LawParameters&> && ...));
  add_law(about, {{states, [](const LawParameters& parameters) -> std::unique_ptr<LawAnswers> {
                     return std::make_unique<AnswersOf<Law<states>>>(Law<states>(parameters));
                   }}...});
}

}  // namespace stillpoint
