// The derivatives of a Drucker–Prager trial: elastic, on the cone, at the apex, viscous.
#include <stillpoint/drucker_prager.hpp>

#include <algorithm>
#include <cstddef>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "law_checks.hpp"
#include "space/materials/drucker_prager_path.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEMPLATE_TEST_CASE_SIG("elastic moduli are the derivative of an elastic trial but for sigma tr d, and symmetric", "",
                       ((StressState S), S), plane_strain, axisymmetric) {
  constexpr int n = gradient_components(S);
  const DruckerPrager<S> law({.E = ground_E, .nu = ground_nu, .c = 1e3 * ground_E});
  const auto history = law.initial_history({-0.3 * ground_E, 0.1 * ground_E, -0.2 * ground_E, 0.2 * ground_E});
  for (const auto& H : checks::deformations<S>()) {
    const auto trial = [&](const Gradient<S>& to) {
      Gradient<S> dH;
      for (std::size_t a = 0; a < dH.size(); ++a) dH[a] = to[a] - H[a];
      auto next = history;
      return law.first_piola(to, dH, 0, next);
    };
    auto A = law.elastic_moduli(H, history);
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) CHECK(A[n * a + b] == Approx(A[n * b + a]).margin(1e-14 * ground_E));  // rounding
    }
    // σ tr(d) cof f, tr(d) cof f_ij = (cof f ⊗ cof f)/det f
    const PlaneTensor f = deformation_gradient<S>(H), cof = determinant(f) * transpose(inverse(f));
    const auto P = gradient_part<S>(stress_tensor<S>(law.cauchy(history)) * cof);
    const auto volume = gradient_part<S>(1 / determinant(f) * cof);
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) A[n * a + b] += P[a] * volume[b];
    }
    CHECK(checks::relative_distance(A, checks::differences<S>(trial, H)) < 1e-8);  // d² and rounding/d
  }
}

namespace {

enum Place { inside, cone, edge, apex, gap };

/// A committed state, and an increment that ends at a place of the yield surface.
template <StressState S>
struct State {
  Place place;
  DruckerPragerParameters m;
  typename DruckerPrager<S>::History before;
  PlaneTensor increment;
};

template <bool varies, StressState S>
void check_moduli(const State<S>& state, double angle) {
  constexpr int n = gradient_components(S);
  constexpr double dt = 0.01;
  using Law = DruckerPrager<S, varies>;
  const Law law(state.m);
  typename Law::History before;
  before.fill(1);  // the factors of what varies
  std::ranges::copy(state.before, before.begin());
  const PlaneTensor start = checks::rotation(angle) * PlaneTensor{1.1, 0.1, 0, 0.9, 1.05} - identity<PlaneTensor>;
  const Gradient<S> H = gradient_part<S>(start + state.increment), dH = gradient_part<S>(state.increment);
  auto next = before;
  const auto trial = [&](const Gradient<S>& to) {
    Gradient<S> change = dH;
    for (std::size_t a = 0; a < change.size(); ++a) change[a] += to[a] - H[a];
    next = before;
    return law.first_piola(to, change, dt, next);
  };
  trial(H);
  const Place place = state.place;
  CHECK((next[5] > before[5]) == (place != inside));
  CHECK((next[4] > 0) == (place != inside && place != cone));
  CHECK((root_J2(law.cauchy(next)) > 1e3) == (place == inside || place == cone || place == edge));
  const auto A = law.moduli(H, dH, dt, before);
  CHECK(checks::relative_distance(A, checks::differences<S>(trial, H)) < 1e-7);  // d² and rounding/d
  if (place == cone) {
    Largest skew;
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) skew.take_magnitude(A[n * a + b] - A[n * b + a]);
    }
    CHECK(skew.value() > 1e-3 * ground_E);
  }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("moduli are the derivative of the return: elastic, on the cone, its edge and apex, in a gap", "",
                       ((StressState S), S), plane_strain, axisymmetric) {
  using History = typename DruckerPrager<S>::History;
  const DruckerPragerParameters soil = {.E = ground_E, .nu = ground_nu, .phi = 30, .psi = 10, .c = 1e4};
  const auto soil_with = [&](const auto& change) {
    auto changed = soil;
    change(changed);
    return changed;
  };
  const History pressed = {-3e5, -2e5, -2.5e5, 5e4, 0, 0}, soft = {-3e5, -2e5, -2.5e5, 5e4, 0, 0.05};
  const PlaneTensor shear = {0.02, 0.15, -0.03, -0.03, 0.01}, apart = {0.04, 0.02, 0.01, 0.05, 0.03};
  const auto strong = soil_with([](auto& m) { m.c = 1e3 * ground_E; });
  const auto associated = soil_with([](auto& m) { m.psi = 30, m.cone = Cone::mean; });
  const auto cut = soil_with([](auto& m) { m.tension = 4e3; });
  const auto viscous = soil_with([](auto& m) { m.fluidity = 1e-4; });  // 1/(β dt) = G/4
  const auto softening = soil_with([](auto& m) { m.phi_residual = 20, m.c_residual = 1e3, m.softening_strain = 0.1; });
  const auto residual = soil_with([](auto& m) { m.phi_residual = 20, m.c_residual = 1e3, m.softening_strain = 0.04; });
  const State<S> states[] = {
      {inside, strong, pressed, shear},
      {cone, soil, pressed, shear},
      {cone, associated, pressed, shear},
      {cone, viscous, pressed, shear},
      {cone, softening, soft, shear},
      {cone, residual, soft, shear},
      {cone, soil, {-1e4, -1e4, -1e4, 0, 0.05, 0.01}, {-0.05, 0.15, 0.01, -0.06, -0.04}},  // closes
      {edge, cut, pressed, apart},
      {edge, soil_with([](auto& m) { m.tension = 4e3, m.fluidity = 1e-4; }), pressed, apart},
      {apex, soil, pressed, 2.0 * apart},
      {gap, soil, {0, 0, 0, 0, 0.05, 0.01}, {-0.01, 0.02, 0.01, 0, -0.01}}};
  for (std::size_t k = 0; k < std::size(states); ++k) {
    for (const double angle : {0.0, 0.8}) {
      CAPTURE(k, angle);
      check_moduli<true>(states[k], angle);
      if (states[k].m.softening_strain == 0) check_moduli<false>(states[k], angle);
    }
  }
}
