#include <stillpoint/drucker_prager.hpp>
#include <stillpoint/hencky.hpp>
#include <stillpoint/linear_elastic.hpp>
#include <stillpoint/neo_hookean.hpp>

#include <algorithm>

#include <catch2/catch.hpp>

#include "law_checks.hpp"
#include "space/materials/material_laws.hpp"
#include "space/materials/wet_laws.hpp"

using namespace stillpoint;
using checks::lame, checks::poisson, checks::young;
using checks::WetHencky, checks::WetLinear, checks::WetNeoHookean;
using enum StressState;

namespace {

#define STATES_OF(Law) \
  Law<uniaxial_stress>, Law<uniaxial_strain>, Law<plane_strain>, Law<plane_stress>, Law<axisymmetric>, Law<space>
#define SOLID_STATES_OF(Law) Law<plane_strain>, Law<plane_stress>, Law<axisymmetric>, Law<space>

static_assert(ElasticLaw<LinearElastic<plane_stress>> && ElasticLaw<NeoHookean<axisymmetric>> &&
              ElasticLaw<Hencky<plane_strain>>);

}  // namespace

// --- linear elasticity ----------------------------------------------------------------------------

TEST_CASE("a linear elastic bar has Young's modulus, a confined one the oedometric modulus") {
  CHECK(LinearElastic<uniaxial_stress>(lame).first_piola({0.01})[0] == Approx(young * 0.01).epsilon(1e-14));
  const double confined = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
  CHECK(LinearElastic<uniaxial_strain>(lame).first_piola({0.01})[0] == Approx(confined * 0.01).epsilon(1e-14));
}

TEST_CASE("Hooke's law in the plane: its moduli, and what it does across the plane") {
  const double e = 0.01, M = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)),
               G = young / (2 * (1 + poisson));
  // plane strain ε_xx alone: the oedometric modulus, and the same side stress in y and z
  const auto strain = LinearElastic<plane_strain>(lame).cauchy({e, 0, 0, 0});
  CHECK(strain[0] == Approx(M * e).epsilon(1e-14));
  CHECK(strain[1] == Approx(poisson / (1 - poisson) * M * e).epsilon(1e-14));
  CHECK(strain[2] == Approx(strain[1]).epsilon(1e-14));
  // plane stress ε_yy = −ν ε_xx: a bar
  const auto sheet = LinearElastic<plane_stress>(lame).cauchy({e, 0, 0, -poisson * e});
  CHECK(sheet[0] == Approx(young * e).epsilon(1e-14));
  CHECK(sheet[1] == Approx(0).margin(1e-14 * young));
  CHECK(sheet[2] == 0);
  // axisymmetric ε_rr = ε_θθ = −ν ε_zz: a bar along the axis
  const auto rod = LinearElastic<axisymmetric>(lame).cauchy({-poisson * e, 0, 0, e, -poisson * e});
  CHECK(rod[1] == Approx(young * e).epsilon(1e-14));
  CHECK(rod[0] == Approx(0).margin(1e-14 * young));
  CHECK(rod[2] == Approx(0).margin(1e-14 * young));
  // shear, and no stress under a small rotation
  CHECK(LinearElastic<plane_strain>(lame).first_piola({0, e, 0, 0})[2] == Approx(G * e).epsilon(1e-14));
  CHECK(LinearElastic<plane_strain>(lame).first_piola({0, e, -e, 0})[1] == 0);
}

// --- every elastic law ----------------------------------------------------------------------------

TEMPLATE_TEST_CASE("moduli are the derivative of the stress, in every stress state", "", STATES_OF(LinearElastic),
                   STATES_OF(NeoHookean), STATES_OF(Hencky), WET_STATES_OF(WetLinear), WET_STATES_OF(WetNeoHookean),
                   WET_STATES_OF(WetHencky)) {
  const TestType law(lame);
  for (const auto& H : checks::deformations<TestType::state>()) {
    const auto exact = checks::differences<TestType::state>([&](const auto& at) { return law.first_piola(at); }, H);
    CHECK(checks::relative_distance(law.moduli(H), exact) < 1e-8);  // of the difference: d² = 1e-12, rounding/d = 1e-10
  }
}

TEMPLATE_TEST_CASE("an elastic stress derives from an energy: its moduli are symmetric", "", STATES_OF(LinearElastic),
                   STATES_OF(NeoHookean), STATES_OF(Hencky), WET_STATES_OF(WetLinear), WET_STATES_OF(WetNeoHookean),
                   WET_STATES_OF(WetHencky)) {
  constexpr int n = gradient_components(TestType::state);
  const TestType law(lame);
  for (const auto& H : checks::deformations<TestType::state>()) {
    const auto A = law.moduli(H);
    auto transposed = A;
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) transposed[n * a + b] = A[n * b + a];
    }
    CHECK(checks::relative_distance(A, transposed) < 1e-13);  // rounding
  }
}

TEMPLATE_TEST_CASE("elasticity at finite strain agrees with Hooke's law at small strain, to first order in it", "",
                   (std::pair<NeoHookean<plane_strain>, LinearElastic<plane_strain>>),
                   (std::pair<NeoHookean<plane_stress>, LinearElastic<plane_stress>>),
                   (std::pair<NeoHookean<axisymmetric>, LinearElastic<axisymmetric>>),
                   (std::pair<NeoHookean<space>, LinearElastic<space>>),
                   (std::pair<Hencky<space>, LinearElastic<space>>),
                   (std::pair<NeoHookean<uniaxial_stress>, LinearElastic<uniaxial_stress>>),
                   (std::pair<NeoHookean<uniaxial_strain>, LinearElastic<uniaxial_strain>>),
                   (std::pair<Hencky<plane_strain>, LinearElastic<plane_strain>>),
                   (std::pair<Hencky<plane_stress>, LinearElastic<plane_stress>>),
                   (std::pair<Hencky<axisymmetric>, LinearElastic<axisymmetric>>),
                   (std::pair<Hencky<uniaxial_stress>, LinearElastic<uniaxial_stress>>),
                   (std::pair<Hencky<uniaxial_strain>, LinearElastic<uniaxial_strain>>)) {
  using Law = typename TestType::first_type;
  const Law law(lame);
  const typename TestType::second_type hooke(lame);
  CHECK(checks::relative_distance(law.moduli({}), hooke.moduli({})) < 1e-14);
  for (const auto& shape : checks::deformations<Law::state>()) {
    auto H = shape;
    for (double& component : H) component *= 1e-5;
    const double bound = 100 * 1e-5;  // the second-order terms have no factor above 100
    CHECK(checks::relative_distance(law.first_piola(H), hooke.first_piola(H)) < bound);
    CHECK(checks::relative_distance(law.cauchy(H), hooke.cauchy(H)) < bound);
  }
}

TEMPLATE_TEST_CASE("a rotation after the deformation turns the stress with it", "", SOLID_STATES_OF(NeoHookean),
                   SOLID_STATES_OF(Hencky), WetNeoHookean<plane_strain>, WetHencky<axisymmetric>, WetHencky<space>) {
  constexpr StressState S = TestType::state;
  const TestType law(lame);
  using Tensor = TensorFor<S>;
  const auto Q = checks::rotation<Tensor>(0.7);
  for (const auto& H : checks::deformations<S>()) {
    const auto QF = gradient_part<S>(Q * deformation_gradient<S>(H) - identity<Tensor>);
    CHECK(checks::relative_distance(law.cauchy(QF), checks::turned<S>(Q, law.cauchy(H))) < 1e-12);  // rounding
  }
}

TEMPLATE_TEST_CASE("P is det(F) sigma F^-T, in the plane, around the axis and in space", "", NeoHookean<plane_strain>,
                   NeoHookean<axisymmetric>, NeoHookean<space>, Hencky<plane_strain>, Hencky<axisymmetric>,
                   Hencky<space>, WetNeoHookean<plane_strain>, WetHencky<axisymmetric>, WetHencky<space>) {
  constexpr StressState S = TestType::state;
  const TestType law(lame);
  for (const auto& H : checks::deformations<S>()) {
    const auto F = deformation_gradient<S>(H), sigma = stress_tensor<S>(law.cauchy(H));
    const auto P = gradient_part<S>(determinant(F) * sigma * transpose(inverse(F)));
    CHECK(checks::relative_distance(law.first_piola(H), P) < 1e-11);  // rounding over the smallest H
  }
}

TEMPLATE_TEST_CASE("a sheet in plane stress with free edges is a bar, and no stress crosses it", "",
                   NeoHookean<plane_stress>, Hencky<plane_stress>) {
  const TestType law(lame);
  for (const auto& H : checks::deformations<plane_stress>()) {
    CHECK(law.cauchy(H)[2] == Approx(0).margin(1e-13 * young));  // Newton's last step
  }
  for (const double F_xx : {0.5, 1.2, 2.5}) {
    double F_yy = 1;  // P_yy = 0, by Newton's method
    for (int i = 0; i < 50; ++i) {
      const Gradient<plane_stress> H = {F_xx - 1, 0, 0, F_yy - 1};
      F_yy -= law.first_piola(H)[3] / law.moduli(H)[15];
    }
    const Gradient<plane_stress> H = {F_xx - 1, 0, 0, F_yy - 1};
    using Bar = std::conditional_t<std::is_same_v<TestType, NeoHookean<plane_stress>>, NeoHookean<uniaxial_stress>,
                                   Hencky<uniaxial_stress>>;
    CHECK(law.first_piola(H)[0] == Approx(Bar(lame).first_piola({F_xx - 1})[0]).epsilon(1e-12));
    CHECK(law.cauchy(H)[0] == Approx(Bar(lame).cauchy({F_xx - 1})[0]).epsilon(1e-12));
  }
}

TEMPLATE_TEST_CASE("a material turned inside out is not a number, so that the trial is refused", "",
                   SOLID_STATES_OF(NeoHookean), SOLID_STATES_OF(Hencky)) {
  const TestType law(lame);
  Gradient<TestType::state> H{};
  H[0] = -1.1;
  CHECK(std::isnan(law.first_piola(H)[0]));
  CHECK(std::isnan(law.first_piola(H)[3]));
  if constexpr (TestType::state == axisymmetric) {
    CHECK(std::isnan(law.first_piola({0, 0, 0, 0, -1.1})[0]));
    CHECK(std::isnan(law.first_piola({-1.1, 0, 0, 0, -1.1})[0]));  // det F is positive again
  }
}

TEMPLATE_TEST_CASE("a bar turned inside out is not a number", "", NeoHookean<uniaxial_stress>,
                   NeoHookean<uniaxial_strain>, Hencky<uniaxial_stress>, Hencky<uniaxial_strain>) {
  CHECK(std::isnan(TestType(lame).first_piola({-1.1})[0]));
}

// --- the neo-Hookean law --------------------------------------------------------------------------

TEST_CASE("the side of a neo-Hookean bar is free of stress at any stretch") {
  // With σ_x from the law, the section's area ratio is w = P/σ; the side's Cauchy stress is
  // [μ (w − 1) + λ ln(F w)]/(F w).
  const NeoHookean<uniaxial_stress> law(lame);
  for (const double F : {0.05, 0.5, 0.99, 1.3, 3.0, 20.0}) {
    const double w = law.first_piola({F - 1})[0] / law.cauchy({F - 1})[0];
    CHECK(lame.mu * (w - 1) + lame.lambda * std::log(F * w) == Approx(0).margin(1e-11 * young));
  }
}

TEST_CASE("a neo-Hookean stress derives from its energy: no work over a closed cycle") {
  constexpr double d = 1e-6;
  const NeoHookean<uniaxial_strain> bar(lame);
  const auto energy = [](double F) {
    return lame.mu / 2 * (F * F - 1 - 2 * std::log(F)) + lame.lambda / 2 * std::log(F) * std::log(F);
  };
  for (const double F : {0.3, 0.9, 1.7}) {
    CHECK(bar.first_piola({F - 1})[0] == Approx((energy(F + d) - energy(F - d)) / (2 * d)).epsilon(1e-7));
  }

  const NeoHookean<axisymmetric> solid(lame);
  const auto W = [](const Gradient<axisymmetric>& H) {
    const PlaneTensor F = deformation_gradient<axisymmetric>(H);
    const double ln_J = std::log(determinant(F));
    return lame.mu / 2 * (trace(transpose(F) * F) - 3 - 2 * ln_J) + lame.lambda / 2 * ln_J * ln_J;
  };
  for (const auto& H : checks::deformations<axisymmetric>()) {
    Gradient<axisymmetric> P{};
    for (std::size_t a = 0; a < P.size(); ++a) {
      auto above = H, below = H;
      above[a] += d;
      below[a] -= d;
      P[a] = (W(above) - W(below)) / (2 * d);
    }
    CHECK(checks::relative_distance(P, solid.first_piola(H)) == Approx(0).margin(1e-8 * young));  // rounding/d at H = 0
  }
}

TEST_CASE("neo-Hookean simple shear: sigma_xy = mu gamma and sigma_xx = mu gamma^2 exactly") {
  const NeoHookean<plane_strain> law(lame);
  for (const double gamma : {0.01, 0.5, 3.0}) {
    const auto sigma = law.cauchy({0, gamma, 0, 0});
    CHECK(sigma[3] == Approx(lame.mu * gamma).epsilon(1e-14));
    CHECK(sigma[0] == Approx(lame.mu * gamma * gamma).epsilon(1e-12));  // b_xx − 1 rounds
    CHECK(sigma[1] == Approx(0).margin(1e-13 * young));
    CHECK(sigma[2] == Approx(0).margin(1e-13 * young));
  }
}

TEST_CASE("a uniform neo-Hookean expansion has sigma = [mu (s^2 - 1) + 3 lambda ln s]/s^3") {
  for (const double s : {0.6, 1.001, 2.0}) {
    const double exact = (lame.mu * (s * s - 1) + 3 * lame.lambda * std::log(s)) / (s * s * s);
    for (const int i : {0, 1, 2}) {
      CHECK(NeoHookean<axisymmetric>(lame).cauchy({s - 1, 0, 0, s - 1, s - 1})[i] == Approx(exact).epsilon(1e-12));
    }
  }
}

// --- what scenes may say --------------------------------------------------------------------------

TEST_CASE("every law's fallbacks are allowed, and refer only to what was said before") {
  for (const LawInfo& law : material_laws()) {
    INFO(law.name);
    CHECK(!law.states.empty());
    for (auto p = law.parameters.begin(); p != law.parameters.end(); ++p) {
      INFO(p->name);
      CHECK(p->lower < p->upper);
      if (p->required) continue;
      if (p->same_as.empty()) {
        if (std::isnan(p->fallback)) continue;  // there is none
        CHECK((p->lower_allowed ? p->fallback >= p->lower : p->fallback > p->lower));
        CHECK(p->fallback <= p->upper);
      } else {
        CHECK(std::any_of(law.parameters.begin(), p, [&](const auto& q) { return q.name == p->same_as; }));
      }
    }
    for (const ChoiceInfo& choice : law.choices) {
      CHECK(std::count(choice.values.begin(), choice.values.end(), choice.fallback) == 1);
    }
  }
}

TEST_CASE("Drucker-Prager takes exactly the parameters that are on offer") {
  const auto& laws = material_laws();
  const auto law = std::find_if(laws.begin(), laws.end(), [](const auto& one) { return one.name == "drucker-prager"; });
  REQUIRE(law != laws.end());
  CHECK(law->states == std::vector{plane_strain, axisymmetric, space});
  MaterialSpec spec;
  double value = 10;
  for (const ParameterInfo& p : law->parameters) spec.parameters[std::string(p.name)] = value++;
  for (const ChoiceInfo& c : law->choices) spec.choices[std::string(c.name)] = "mean";
  const auto m = DruckerPragerParameters::from(spec);
  CHECK(m.cone == Cone::mean);
  const double sum = m.E + m.nu + m.phi + m.psi + m.c + m.fluidity + m.tension + m.phi_residual + m.c_residual +
                     m.softening_strain + spec.parameters.at("rho");
  CHECK(sum == Approx((10 + value - 1) / 2 * static_cast<double>(law->parameters.size())));  // each of them once
  spec.choices["cone"] = "egg";
  CHECK_THROWS_AS(DruckerPragerParameters::from(spec), std::invalid_argument);
}
