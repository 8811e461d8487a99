#include <stillpoint/drucker_prager.hpp>

#include <random>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "law_checks.hpp"

using namespace stillpoint;
using enum StressState;

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double E = 1e7, nu = 0.2, G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));

static_assert(HistoryLaw<DruckerPrager<plane_strain>> && HistoryLaw<DruckerPrager<axisymmetric>>);

// A material point on its way: each step is a trial from the committed history, then committed.
template <StressState S>
struct Path {
  DruckerPrager<S> law;
  typename DruckerPrager<S>::History now{};
  Gradient<S> H{};

  explicit Path(const DruckerPragerParameters& m, const Stress<S>& stress = {}) : law(m) {
    now = law.initial_history(stress);
  }
  Gradient<S> step(const Gradient<S>& to, double dt = 0) {
    Gradient<S> dH;
    for (std::size_t a = 0; a < H.size(); ++a) dH[a] = to[a] - H[a];
    H = to;
    return law.first_piola(H, dH, dt, now);
  }
  // Straight to H in equal increments.
  void go(const Gradient<S>& to, int steps, double dt = 0) {
    const Gradient<S> from = H;
    for (int k = 1; k <= steps; ++k) {
      Gradient<S> next;
      for (std::size_t a = 0; a < H.size(); ++a) next[a] = from[a] + (to[a] - from[a]) * k / steps;
      step(next, dt);
    }
  }
  double gap() const { return now[4]; }
  double plastic_strain() const { return now[5]; }
};

double pressure(const Stress<plane_strain>& s) { return (s[0] + s[1] + s[2]) / 3; }  // p, tension positive
double root_J2(const Stress<plane_strain>& s) {
  const double p = pressure(s), x = s[0] - p, y = s[1] - p, z = s[2] - p;
  return std::sqrt((x * x + y * y + z * z) / 2 + s[3] * s[3]);
}
template <StressState S>
double p_of(const Path<S>& path) {
  return pressure(path.law.cauchy(path.now));
}
template <StressState S>
double root_J2_of(const Path<S>& path) {
  return root_J2(path.law.cauchy(path.now));
}

// What a specimen shows at the end of a strain along `axis` (component of H) under the lateral stress −1000 on the
// components `lateral`.
struct Mobilised {
  double friction;   // sin φ = |σ₁ − σ₃|/|σ₁ + σ₃|
  double dilatancy;  // sin ψ = (d₁ + d₃)/|d₁ − d₃| of the last increment
};
template <StressState S>
Mobilised mobilised(const DruckerPragerParameters& m, double strain, int axis, const std::vector<int>& lateral) {
  constexpr double confinement = 1000;
  constexpr int steps = 2000;
  Path<S> path(m, {-confinement, -confinement, -confinement, 0});
  Mobilised found{};
  for (int k = 1; k <= steps; ++k) {
    Gradient<S> to = path.H;
    to[axis] = strain * k / steps;
    // the lateral strain, by secants, at which σ_xx is the confinement
    const auto excess = [&](double side) {
      Path<S> trial = path;
      for (const int a : lateral) to[a] = side;
      trial.step(to);
      return trial.law.cauchy(trial.now)[0] + confinement;
    };
    double a = path.H[lateral[0]], b = a - strain / steps / 2, f_a = excess(a);
    for (int i = 0; i < 60 && std::abs(f_a) > 1e-9 * confinement && a != b; ++i) {
      const double f_b = excess(b), next = b - f_b * (b - a) / (f_b - f_a);
      a = b;
      f_a = f_b;
      b = next;
    }
    excess(a);
    const double d1 = (to[0] - path.H[0]) / (1 + to[0]), d3 = (to[axis] - path.H[axis]) / (1 + to[axis]);
    path.step(to);
    const auto s = path.law.cauchy(path.now);
    found = {std::abs((s[1] - s[0]) / (s[1] + s[0])), (d1 + d3) / std::abs(d1 - d3)};
  }
  return found;
}

}  // namespace

// --- the increment --------------------------------------------------------------------------------

TEST_CASE("elastic simple shear follows Jaumann's rate, tau = G sin gamma, with an error of second order") {
  // σ_xx = G (1 − cos γ) as well
  const double gamma = 1;
  const auto error = [&](int steps) {
    Path<plane_strain> path({.E = E, .nu = nu, .c = 1e3 * E});
    path.go({0, gamma, 0, 0}, steps);
    return std::hypot(path.now[3] - G * std::sin(gamma), path.now[0] - G * (1 - std::cos(gamma)));
  };
  CHECK(error(10) < 1e-3 * G);
  CHECK(error(10) / error(20) == Approx(4).epsilon(0.02));
  CHECK(error(20) / error(40) == Approx(4).epsilon(0.02));
}

TEMPLATE_TEST_CASE_SIG("a rotation by 90 degrees turns the stress exactly, in any number of increments", "",
                       ((StressState S), S), plane_strain, axisymmetric) {
  const Stress<S> before = {-3e3, 1e3, -2e3, 2e3};
  for (const int steps : {1, 10, 1000}) {
    Path<S> path({.E = E, .nu = nu, .phi = 30, .c = 1e6}, before);
    Gradient<S> P{};
    for (int k = 1; k <= steps; ++k)
      P = path.step(gradient_part<S>(checks::rotation(90 * degree * k / steps) - identity<PlaneTensor>));
    const PlaneTensor Q = checks::rotation(90 * degree);
    const Stress<S> exact = checks::turned<S>(Q, before);
    // H = Q − I rounds by 1e-16, which is 1e-16 K of stress an increment
    const double rounding = 1e-16 * K * std::sqrt(steps) + 1e-15 * steps * 3e3;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      CHECK(path.law.cauchy(path.now)[i] == Approx(exact[i]).margin(10 * rounding));
    }
    // P = σ cof Q = Q σ₀ Qᵀ Q
    const auto P_exact = gradient_part<S>(Q * stress_tensor<S>(before));
    for (std::size_t a = 0; a < P.size(); ++a) CHECK(P[a] == Approx(P_exact[a]).margin(10 * rounding));
  }
}

TEMPLATE_TEST_CASE_SIG("P is det(f) sigma f^-T after the increment", "", ((StressState S), S), plane_strain,
                       axisymmetric) {
  Path<S> path({.E = E, .nu = nu, .phi = 30, .psi = 5, .c = 1e4}, {-3e3, -1e3, -2e3, 2e3});
  for (const auto& H : checks::deformations<S>()) {
    const auto P = path.step(H);
    const PlaneTensor f = deformation_gradient<S>(H), sigma = stress_tensor<S>(path.law.cauchy(path.now));
    CHECK(checks::relative_distance(P, gradient_part<S>(determinant(f) * sigma * transpose(inverse(f)))) < 1e-13);
  }
}

TEMPLATE_TEST_CASE_SIG("elastic moduli are the derivative of an elastic trial but for sigma tr d, and symmetric", "",
                       ((StressState S), S), plane_strain, axisymmetric) {
  constexpr int n = gradient_components(S);
  const DruckerPrager<S> law({.E = E, .nu = nu, .c = 1e3 * E});
  const auto history = law.initial_history({-0.3 * E, 0.1 * E, -0.2 * E, 0.2 * E});
  for (const auto& H : checks::deformations<S>()) {
    const auto trial = [&](const Gradient<S>& to) {
      Gradient<S> dH;
      for (std::size_t a = 0; a < dH.size(); ++a) dH[a] = to[a] - H[a];
      auto next = history;
      return law.first_piola(to, dH, 0, next);
    };
    auto A = law.elastic_moduli(H, history);
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) CHECK(A[n * a + b] == Approx(A[n * b + a]).margin(1e-14 * E));  // rounding
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

TEMPLATE_TEST_CASE_SIG("moduli are the derivative of the return: elastic, on the cone, its edge and apex, in a gap", "",
                       ((StressState S), S), plane_strain, axisymmetric) {
  constexpr int n = gradient_components(S);
  using History = typename DruckerPrager<S>::History;
  enum Place { inside, cone, edge, apex, gap };
  struct State {
    Place place;
    DruckerPragerParameters m;
    History before;
    PlaneTensor increment;
  };
  const DruckerPragerParameters soil = {.E = E, .nu = nu, .phi = 30, .psi = 10, .c = 1e4};
  const auto soil_with = [&](const auto& change) {
    auto changed = soil;
    change(changed);
    return changed;
  };
  const History pressed = {-3e5, -2e5, -2.5e5, 5e4, 0, 0}, soft = {-3e5, -2e5, -2.5e5, 5e4, 0, 0.05};
  const PlaneTensor shear = {0.02, 0.15, -0.03, -0.03, 0.01}, apart = {0.04, 0.02, 0.01, 0.05, 0.03};
  const auto strong = soil_with([](auto& m) { m.c = 1e3 * E; });
  const auto associated = soil_with([](auto& m) { m.psi = 30, m.cone = Cone::mean; });
  const auto cut = soil_with([](auto& m) { m.tension = 4e3; });
  const auto viscous = soil_with([](auto& m) { m.fluidity = 1e-4; });  // 1/(β dt) = G/4
  const auto softening = soil_with([](auto& m) { m.phi_residual = 20, m.c_residual = 1e3, m.softening_strain = 0.1; });
  const auto residual = soil_with([](auto& m) { m.phi_residual = 20, m.c_residual = 1e3, m.softening_strain = 0.04; });
  const State states[] = {{inside, strong, pressed, shear},
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
  constexpr double dt = 0.01;
  for (std::size_t k = 0; k < std::size(states); ++k) {
    const auto& [place, m, before, increment] = states[k];
    const DruckerPrager<S> law(m);
    for (const double angle : {0.0, 0.8}) {
      CAPTURE(k, angle);
      const PlaneTensor start = checks::rotation(angle) * PlaneTensor{1.1, 0.1, 0, 0.9, 1.05} - identity<PlaneTensor>;
      const Gradient<S> H = gradient_part<S>(start + increment), dH = gradient_part<S>(increment);
      History next = before;
      const auto trial = [&, &before = before](const Gradient<S>& to) {
        Gradient<S> change = dH;
        for (std::size_t a = 0; a < change.size(); ++a) change[a] += to[a] - H[a];
        next = before;
        return law.first_piola(to, change, dt, next);
      };
      trial(H);
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
        CHECK(skew.value() > 1e-3 * E);
      }
    }
  }
}

TEST_CASE("a trial does not touch what it is made from: twice gives the same bits") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> component(-0.05, 0.05);
  const DruckerPrager<plane_strain> law({.E = E, .phi = 30, .psi = 10, .c = 100, .fluidity = 1e-6});
  const auto committed = law.initial_history({-3e3, -1e3, -2e3, 500});
  for (int i = 0; i < 100; ++i) {
    Gradient<plane_strain> H;
    for (double& component_of_H : H) component_of_H = component(random);
    auto first = committed, second = committed;
    const auto P = law.first_piola(H, H, 1e-3, first);
    CHECK(P == law.first_piola(H, H, 1e-3, second));
    CHECK(first == second);
  }
}

TEMPLATE_TEST_CASE_SIG("a point turned inside out is not a number, so that the trial is refused", "",
                       ((StressState S), S), plane_strain, axisymmetric) {
  const auto refused = [](const Gradient<S>& to) {
    const auto P = Path<S>({.E = E, .phi = 30}, {-1e3, -1e3, -1e3, 0}).step(to);
    return std::isnan(P[0]) && std::isnan(P[1]) && std::isnan(P[2]) && std::isnan(P[3]);
  };
  Gradient<S> H{};
  CHECK_FALSE(refused(H));
  H[0] = -1.1;
  CHECK(refused(H));
  if constexpr (S == axisymmetric) {
    CHECK(refused({0, 0, 0, 0, -1.1}));
    CHECK(refused({-1.1, 0, 0, 0, -1.1}));
  }
}

// --- simple shear at a constant rate --------------------------------------------------------------

TEST_CASE("rate-independent simple shear: tau = min(G gamma, c cos phi - p sin phi)") {
  for (const double phi : {0.0, 30.0}) {
    const double p = -500, c = 400, tau_y = c * std::cos(phi * degree) - p * std::sin(phi * degree);
    Path<plane_strain> path({.E = E, .nu = nu, .phi = phi, .c = c}, {p, p, p, 0});
    double gamma = 0;
    for (int k = 0; k < 400; ++k) {
      gamma += 1e-6;
      path.step({0, gamma, 0, 0});
      CHECK(path.now[3] == Approx(std::min(G * gamma, tau_y)).epsilon(1e-6));  // rotation: γ²/6, and of σ_xx: γ τ
    }
    CHECK(G * gamma > 2 * tau_y);
    CHECK(path.plastic_strain() == Approx(gamma - tau_y / G).epsilon(1e-3));  // γᵖ is the plastic part of γ
  }
}

TEST_CASE("viscoplastic simple shear: tau = tau_y + rate/beta (1 - exp(-G beta (t - t_y))), first order in dt") {
  const double tau_y = 400, beta = 1e-3, rate = 0.1;  // 1/(G β) = 0.24 ms, rate/β = 100 Pa
  const double t_y = tau_y / (G * rate), end = t_y + 2 / (G * beta);
  const double exact = tau_y + rate / beta * (1 - std::exp(-2.0));
  const auto error = [&](int steps) {
    Path<plane_strain> path({.E = E, .nu = nu, .c = tau_y, .fluidity = beta});
    path.go({0, rate * t_y, 0, 0}, 1, t_y);
    CHECK(path.plastic_strain() == Approx(0).margin(1e-15));
    path.go({0, rate * end, 0, 0}, steps, (end - t_y) / steps);
    return path.now[3] - exact;
  };
  CHECK(std::abs(error(40)) < 0.02 * (exact - tau_y));
  CHECK(error(40) / error(80) == Approx(2).epsilon(0.05));
  CHECK(error(80) / error(160) == Approx(2).epsilon(0.03));
}

TEST_CASE("a viscoplastic point does not flow in no time, and is rate-independent in much time") {
  const Gradient<plane_strain> H = {0.01, 0.03, 0.01, -0.02};
  const DruckerPragerParameters viscous = {.E = E, .nu = nu, .phi = 30, .psi = 10, .c = 100, .fluidity = 1e-6};
  auto plastic = viscous, elastic = viscous;
  plastic.fluidity = 0;
  elastic.c = 1e3 * E;
  const Stress<plane_strain> before = {-1e4, -2e4, -1e4, 100};
  Path<plane_strain> none(viscous, before), much(viscous, before), instant(plastic, before), never(elastic, before);
  CHECK(none.step(H, 0) == never.step(H));
  CHECK(none.plastic_strain() == 0);
  CHECK(checks::relative_distance(much.step(H, 1e6), instant.step(H)) < 1e-6);  // 1/(β dt) = 1e-7 G
  // the cut-off holds in no time, too
  Path<plane_strain> apart(viscous);
  apart.step({0.01, 0, 0, 0.01}, 0);
  CHECK(p_of(apart) == Approx(100 / std::tan(30 * degree)).epsilon(1e-12));
}

// --- the cone -------------------------------------------------------------------------------------

TEST_CASE("an elastic confined compression has K0 = nu/(1 - nu)") {
  Path<plane_strain> plane({.E = E, .nu = nu, .c = 1e3 * E});
  plane.go({0, 0, 0, -0.1}, 10);
  Path<axisymmetric> round({.E = E, .nu = nu, .c = 1e3 * E});
  round.go({0, 0, 0, -0.1, 0}, 10);
  for (const auto& s : {plane.law.cauchy(plane.now), round.law.cauchy(round.now)}) {
    CHECK(s[0] / s[1] == Approx(nu / (1 - nu)).epsilon(1e-12));  // rounding
    CHECK(s[2] == Approx(s[0]).epsilon(1e-12));
  }
}

TEST_CASE("a yielding confined compression has K0 = (1 - eta/sqrt 3)/(1 + 2 eta/sqrt 3)") {
  const double eta = std::sin(20 * degree), root = std::sqrt(3.0);
  const double K0 = (1 - eta / root) / (1 + 2 * eta / root);
  REQUIRE(K0 > nu / (1 - nu));  // so that it yields, from the first increment on
  Path<plane_strain> plane({.E = E, .nu = nu, .phi = 20});
  Path<axisymmetric> round({.E = E, .nu = nu, .phi = 20});
  for (const double e : {-1e-5, -1e-3, -0.1}) {
    plane.go({0, 0, 0, e}, 3);
    round.go({0, 0, 0, e, 0}, 3);
    for (const auto& s : {plane.law.cauchy(plane.now), round.law.cauchy(round.now)}) {
      CHECK(s[0] / s[1] == Approx(K0).epsilon(1e-11));  // rounding
      CHECK(s[2] == Approx(s[0]).epsilon(1e-11));
    }
  }
}

TEST_CASE("a biaxial test mobilises phi and psi with the cone matched to plane strain") {
  for (const double phi : {20.0, 35.0}) {
    for (const double psi : {0.0, 10.0, phi}) {
      const auto test = mobilised<plane_strain>({.E = E, .nu = nu, .phi = phi, .psi = psi}, -0.03, 3, {0});
      CHECK(test.friction == Approx(std::sin(phi * degree)).epsilon(1e-6));  // s_zz has settled as exp(−G γ/τ)
      CHECK(test.dilatancy == Approx(std::sin(psi * degree)).margin(1e-4));  // the increment, 3 %/2000
    }
  }
}

TEST_CASE("a triaxial test mobilises phi with the cone of its edge, compressed or extended") {
  const DruckerPragerParameters m = {.E = E, .nu = nu, .phi = 30, .psi = 5};
  auto outer = m, inner = m;
  outer.cone = Cone::compression;
  inner.cone = Cone::extension;
  CHECK(mobilised<axisymmetric>(outer, -0.03, 3, {0, 4}).friction == Approx(0.5).epsilon(1e-6));
  CHECK(mobilised<axisymmetric>(inner, 0.03, 3, {0, 4}).friction == Approx(0.5).epsilon(1e-6));
}

TEMPLATE_TEST_CASE_SIG("no path leaves the cone or passes the cut-off", "", ((StressState S), S), plane_strain,
                       axisymmetric) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1, 1);
  for (const DruckerPragerParameters& m :
       {DruckerPragerParameters{.E = E, .nu = nu, .phi = 35},
        DruckerPragerParameters{.E = E, .nu = nu, .phi = 35, .psi = 35, .c = 500},
        DruckerPragerParameters{.E = E, .nu = nu, .phi = 30, .psi = 10, .c = 500, .cone = Cone::mean, .tension = 200},
        DruckerPragerParameters{.E = E, .nu = nu, .c = 500, .tension = 100}}) {
    const auto cone = ConeCoefficients::from(m.cone, m.phi, m.psi);
    const double p_cut = m.phi > 0 ? std::min(m.tension, m.c / std::tan(m.phi * degree)) : m.tension;
    Path<S> path(m);
    Largest worst, highest;
    for (int k = 0; k < 2000; ++k) {
      const double size = std::pow(10.0, -5 + 3 * share(random));
      Gradient<S> to = path.H;
      for (double& component : to) component = 0.99 * component + size * share(random);
      path.step(to);
      worst.take(root_J2_of(path) + cone.eta * p_of(path) - cone.xi * m.c);
      highest.take(p_of(path) - p_cut);
      CHECK(path.gap() >= 0);
    }
    CHECK(worst.value() < 1e-14 * E);  // rounding of a trial of 0.01 E
    CHECK(highest.value() < 1e-14 * E);
  }
}

TEST_CASE("without friction there is no apex: any mean stress is elastic, tau is c") {
  Path<plane_strain> path({.E = E, .nu = nu, .c = 1000});
  path.step({0.05, 0, 0, 0.05});
  path.step({0.05, 0.05, 0, 0.05});
  CHECK(p_of(path) > 100 * 1000);
  CHECK(path.gap() == 0);
  CHECK(root_J2_of(path) == Approx(1000).epsilon(1e-12));
}

// --- tension, gap and dilatancy -------------------------------------------------------------------

TEST_CASE("cohesionless material stretched by 1 % and compressed by 1 % is free of stress, then elastic again") {
  Path<axisymmetric> path({.E = E, .nu = nu, .phi = 35});
  path.go({0.01, 0, 0, 0.01, 0.01}, 10);
  CHECK(path.gap() == Approx(3 * std::log(1.01)).epsilon(1e-6));  // midpoint: (increment)²/12
  path.go({0.004, 0, 0, 0.004, 0.004}, 6);
  CHECK(p_of(path) == 0);
  path.go({0, 0, 0, 0, 0}, 4);
  CHECK(path.gap() == Approx(0).margin(1e-16));
  CHECK(p_of(path) == Approx(0).margin(1e-16 * K));
  path.go({-0.001, 0, 0, -0.001, -0.001}, 10);
  CHECK(p_of(path) == Approx(3 * K * std::log(0.999)).epsilon(1e-6));
  CHECK(root_J2_of(path) == Approx(0).margin(1e-15 * K));
}

TEST_CASE("stretching along one axis, which shears as well, leaves nothing behind either") {
  Path<plane_strain> path({.E = E, .nu = nu, .phi = 35});
  path.go({0, 0, 0, 0.01}, 10);
  CHECK(root_J2_of(path) == Approx(0).margin(1e-15 * E));
  path.go({0, 0, 0, 0}, 10);
  for (const double s : path.law.cauchy(path.now)) CHECK(s == Approx(0).margin(1e-15 * E));
  path.go({0, 0, 0, -1e-3}, 10);  // confined: p is elastic, the shear at yield
  CHECK(p_of(path) == Approx(K * std::log(0.999)).epsilon(1e-6));
  CHECK(root_J2_of(path) == Approx(-std::sin(35 * degree) * p_of(path)).epsilon(1e-12));
}

TEST_CASE("a rotation leaves an open gap open") {
  Path<plane_strain> path({.E = E, .nu = nu, .phi = 35});
  path.step({0.01, 0, 0, 0.01});
  const double gap = path.gap();
  const PlaneTensor opened = {1.01, 0, 0, 1.01, 1};
  for (const double angle : {0.3, 1.2, 2.0})
    path.step(gradient_part<plane_strain>(checks::rotation(angle) * opened - identity<PlaneTensor>));
  CHECK(path.gap() == Approx(gap).epsilon(1e-13));
}

TEST_CASE("the cut-off below the apex limits p, and the shear stress there is that of the cone") {
  const DruckerPragerParameters m = {.E = E, .nu = nu, .phi = 30, .c = 1000, .tension = 600};
  Path<plane_strain> path(m);
  path.go({0.01, 0.02, 0, 0}, 50);
  CHECK(p_of(path) == Approx(600).epsilon(1e-12));
  CHECK(root_J2_of(path) == Approx(1000 * std::cos(30 * degree) - 600 * 0.5).epsilon(1e-12));
  auto high = m;
  high.tension = 1e9;
  Path<plane_strain> to_apex(high);
  to_apex.go({0.01, 0.02, 0, 0}, 50);
  CHECK(p_of(to_apex) == Approx(1000 / std::tan(30 * degree)).epsilon(1e-12));
  CHECK(root_J2_of(to_apex) == Approx(0).margin(1e-15 * E));
}

TEST_CASE("no volume is invented: what is not elastic is gap or dilatancy, on any path") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(-1, 1);
  for (const double fluidity : {0.0, 1e-6}) {
    const DruckerPragerParameters m = {.E = E,
                                       .nu = nu,
                                       .phi = 30,
                                       .psi = 20,
                                       .c = 300,
                                       .fluidity = fluidity,
                                       .tension = 200,
                                       .phi_residual = 25,
                                       .c_residual = 0,
                                       .softening_strain = 0.2};
    const double eta_bar = ConeCoefficients::from(m.cone, m.phi, m.psi).eta_bar;
    Path<axisymmetric> path(m);
    double volume = 0;  // Σ tr d, on a path without shear
    int open = 0;
    for (int k = 0; k < 1000; ++k) {
      const double size = std::pow(10.0, -4 + 2 * share(random));
      Gradient<axisymmetric> to = path.H;
      for (const int a : {0, 3, 4}) {
        to[a] = 0.99 * to[a] + size * (share(random) + 0.25);  // dilatancy would soon have closed it for good
        volume += (to[a] - path.H[a]) / (1 + (to[a] + path.H[a]) / 2);
      }
      path.step(to, 1e-2);
      open += path.gap() > 0;
      CHECK(p_of(path) / K + path.gap() + eta_bar * path.plastic_strain() == Approx(volume).margin(1e-13));  // rounding
    }
    CAPTURE(open);
    CHECK((open > 100 && open < 900));
  }
}

TEST_CASE("dilatancy takes its room out of an open gap, and presses when that is closed") {
  const DruckerPragerParameters m = {.E = E, .nu = nu, .phi = 30, .psi = 10};
  const double eta_bar = ConeCoefficients::from(m.cone, m.phi, m.psi).eta_bar;
  Path<plane_strain> path(m);
  path.step({0, 0, 0, 1e-3});
  const double gap = path.gap(), closes = gap / eta_bar;
  path.go({0, 0.9 * closes, 0, 1e-3}, 100);
  CHECK(p_of(path) == 0);
  CHECK(path.gap() == Approx(0.1 * gap).margin(2e-3 * gap));  // the block is stretched: 2 d_xy = dγ/(1 + gap)
  path.go({0, 1.1 * closes, 0, 1e-3}, 100);
  CHECK(path.gap() == 0);
  CHECK(p_of(path) < -0.01 * K * gap);
}

// --- softening ------------------------------------------------------------------------------------

TEST_CASE("strength falls linearly with the plastic strain to its residual value, and stays there") {
  const double p = -1000, softening_strain = 0.01;
  const DruckerPragerParameters m = {.E = E,
                                     .nu = nu,
                                     .phi = 35,
                                     .c = 500,
                                     .phi_residual = 25,
                                     .c_residual = 100,
                                     .softening_strain = softening_strain};
  const auto strength = [&](double phi, double c) { return c * std::cos(phi * degree) - p * std::sin(phi * degree); };
  const double peak = strength(35, 500), residual = strength(25, 100);
  Path<plane_strain> path(m, {p, p, p, 0});
  for (int k = 1; k <= 1000; ++k) {
    const double before = path.plastic_strain();
    path.step({0, 2e-5 * k, 0, 0});
    if (path.plastic_strain() == 0) continue;
    const double share = std::min(1.0, before / softening_strain);
    CHECK(root_J2_of(path) == Approx(peak + share * (residual - peak)).epsilon(1e-10));  // rounding
  }
  CHECK(path.plastic_strain() > 1.5 * softening_strain);
  CHECK(path.now[3] == Approx(residual).epsilon(1e-3));  // rotation: τ/G and γ²
}

TEST_CASE("a residual that is not given is that of the peak") {
  const DruckerPragerParameters m = {.E = E, .nu = nu, .phi = 35, .c = 500, .softening_strain = 1e-3};
  Path<plane_strain> path(m, {-1e3, -1e3, -1e3, 0});
  path.go({0, 0.01, 0, 0}, 100);
  CHECK(root_J2_of(path) == Approx(500 * std::cos(35 * degree) + 1e3 * std::sin(35 * degree)).epsilon(1e-12));
}
