// A material point of Modified Cam clay in the tests of a laboratory. The numbers are those of an independent
// integration, closed forms in the stress ratio beside LSODA on the rate equations, which agree to 4e-10: M = 1.2,
// λ = 0.2, κ = 0.04, ν = 0.3, e_0 = 1, from p = 100 kPa. Logarithmic strains; pressures positive, in kPa.
#include <stillpoint/cam_clay.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "law_checks.hpp"
#include "space/materials/history_path.hpp"

namespace stillpoint {
namespace {

using enum StressState;
using checks::minus;
using test::cell_pressure;

template <StressState S>
using ClayPath = test::HistoryPath<CamClay<S>, CamClayParameters>;

CamClayParameters clay(double OCR, bool evolves = true) {
  return {.M = 1.2, .lambda = 0.2, .kappa = 0.04, .nu = 0.3, .e0 = 1, .OCR = OCR, .volume_evolves = evolves};
}

struct Expected {
  double axial_strain, p, q, pc, e;
};
const std::vector<Expected> undrained_1 = {
    {0.01, 83.53342283742947, 50.340373408628814, 104.60078183944705, 1},
    {0.02, 68.810247304985, 63.72715540955, 109.79605101530441, 1},
    {0.05, 58.50539829001681, 68.58573894260743, 114.34074430308075, 1},
    {0.1, 57.459736234815665, 68.9144477103524, 114.85742960752258, 1},
    {0.2, 57.43493147182778, 68.92189718322668, 114.86982863871624, 1},
};
const std::vector<Expected> undrained_5 = {
    {0.05, 152.16072874373967, 255.5411677800647, 450.1884612602399, 1},
    {0.1, 206.39272504745136, 250.2786726066399, 417.153995915823, 1},
    {0.2, 208.13732984552544, 249.76625381864034, 416.2770897048265, 1},
};
const std::vector<Expected> drained_1 = {
    {0.01, 109.14307030602113, 27.429210918063397, 113.93012036715048, 0.9756340084769579},
    {0.05, 126.85532423870224, 80.56597271610674, 162.38834405350022, 0.9129136425493514},
    {0.2, 154.07028620869085, 162.2108586260725, 272.66858648094785, 0.8222165469008322},
};
const std::vector<Expected> drained_1_fixed = {
    {0.01, 109.18672234826018, 27.560167044780545, 114.0176593024598, 0.9756446347522341},
    {0.05, 127.26949711436555, 81.8084913430966, 163.78776624925542, 0.9133437425543994},
    {0.2, 155.2841349448333, 165.8524048344999, 278.29797251766155, 0.8266134472463316},
};
const std::vector<Expected> drained_5 = {
    {0.05, 193.0659625838152, 279.19788775144565, 473.4517849906259, 0.982414814068709},
    {0.2, 172.74753715843437, 218.2426114753031, 364.2193031843979, 1.0288298681534775},
};
const std::vector<Expected> drained_5_fixed = {
    {0.05, 192.95278928551988, 278.85836785655965, 472.8211533278305, 0.9827265538105727},
    {0.2, 172.77035350589588, 218.31106051768765, 364.33694182367765, 1.0289808817929678},
};

double error_of(const ClayPath<axisymmetric>& path, const Expected& at) {
  const Stress<axisymmetric> s = path.stress();
  const double p = -(s[0] + s[1] + s[2]) / 3000, q = (s[0] - s[1]) / 1000;
  Largest error;
  error.take_magnitude(p / at.p - 1);
  error.take_magnitude(q / at.q - 1);
  error.take_magnitude(path.now[4] / (1000 * at.pc) - 1);
  error.take_magnitude(path.now[5] / at.e - 1);
  return error.value();
}

/// The largest relative error at the expected strains; advance(path, k) makes step k of `size`.
template <class Advance>
double largest_error(const CamClayParameters& m, double size, const std::vector<Expected>& expected,
                     const Advance& advance) {
  ClayPath<axisymmetric> path(m, {cell_pressure, cell_pressure, cell_pressure, 0});
  Largest error;
  int k = 0;
  for (const Expected& at : expected) {
    while (k < std::lround(at.axial_strain / size)) advance(path, ++k * size);
    error.take_magnitude(error_of(path, at));
  }
  return error.value();
}
double undrained_error(double OCR, double size, const std::vector<Expected>& expected) {
  return largest_error(clay(OCR), size, expected, [](ClayPath<axisymmetric>& path, double axial) {
    path.step({std::expm1(axial / 2), 0, 0, std::expm1(-axial), std::expm1(axial / 2)});
  });
}
// The axial strain is led, and the stress across it held at the end of each step.
double drained_error(double OCR, bool evolves, double size, const std::vector<Expected>& expected) {
  return largest_error(clay(OCR, evolves), size, expected, [](ClayPath<axisymmetric>& path, double axial) {
    const auto at = [&](double rr) { return Gradient<axisymmetric>{rr, 0, 0, std::expm1(-axial), rr}; };
    const auto off = [&](double rr) { return path.stress_after(at(rr))[0] - cell_pressure; };
    double x0 = path.H[0], x1 = x0 + 1e-5, f0 = off(x0), f1 = off(x1);
    for (int k = 0; k < 60 && f1 != f0; ++k) {
      const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
      x0 = x1, f0 = f1, x1 = x2, f1 = off(x2);
    }
    path.step(at(x1));
  });
}

}  // namespace

TEST_CASE("undrained triaxial compression of Cam clay is exact to 1e-4 by steps of 1 %, and to 1e-6 by small ones") {
  // An undrained path of strain is straight: the flow alone is integrated, but for the strain's second order
  CHECK(undrained_error(1, 0.01, undrained_1) < 1e-4);
  CHECK(undrained_error(5, 0.01, undrained_5) < 1e-4);
  CHECK(undrained_error(1, 0.001, undrained_1) < 1e-6);
  CHECK(undrained_error(5, 0.001, undrained_5) < 1e-6);
}

TEST_CASE("drained triaxial compression of Cam clay converges with the square of the step, to 1e-6") {
  // A step of a drained path of strain is straight, and the path is not: that is the error
  struct Case {
    double OCR;
    bool evolves;
    const std::vector<Expected>& expected;
  };
  const auto [OCR, evolves, expected] = GENERATE(Case{1, true, drained_1}, Case{1, false, drained_1_fixed},
                                                 Case{5, true, drained_5}, Case{5, false, drained_5_fixed});
  CAPTURE(OCR, evolves);
  const double coarse = drained_error(OCR, evolves, 0.001, expected),
               fine = drained_error(OCR, evolves, 5e-5, expected);
  CHECK(drained_error(OCR, evolves, 0.01, expected) < 0.015);
  CHECK(coarse < 1.5e-4);
  CHECK(fine < 1e-6);
  if (OCR == 1) CHECK(std::log(coarse / fine) / std::log(20) > 1.7);
}

TEST_CASE("isotropic loading and unloading follow the lines of lambda and kappa in any number of steps") {
  struct Case {
    bool evolves;
    double e_400, e_50;
  };
  const auto [evolves, e_400, e_50] =
      GENERATE(Case{true, 0.7227411277760218, 0.8059187894432153}, Case{false, 0.7411011265922482, 0.8150383106343217});
  for (const int steps : {3, 10}) {
    ClayPath<axisymmetric> path(clay(1, evolves), {cell_pressure, cell_pressure, cell_pressure, 0});
    const auto to = [&](double e) {
      const double h = std::cbrt((1 + e) / 2) - 1;
      path.go({h, 0, 0, h, h}, steps);
    };
    to(e_400);
    CHECK(path.stress()[1] == Approx(-400e3).epsilon(1e-12));
    CHECK(path.now[4] == Approx(400e3).epsilon(1e-12));
    // Δε_vᵖ = (λ − κ)/v Δln p_c: √(2/3) of it
    if (!evolves) CHECK(path.now[6] == Approx(std::sqrt(2.0 / 3) * 0.08 * std::log(4)).epsilon(1e-6));
    to(e_50);
    CHECK(path.stress()[1] == Approx(-50e3).epsilon(1e-12));
    CHECK(path.now[4] == Approx(400e3).epsilon(1e-12));
    CHECK(path.now[5] == Approx(e_50).epsilon(1e-14));
  }
}

TEST_CASE("an oedometer test of Cam clay from an isotropic stress is exact, and ends at K0") {
  struct Row {
    double strain, axial, radial, pc;
  };
  ClayPath<axisymmetric> path(clay(1, /*evolves=*/false), {cell_pressure, cell_pressure, cell_pressure, 0});
  int k = 0;
  for (const Row& row : {Row{0.01, 126.2554171495506, 94.93855834008441, 111.84068692770462},
                         Row{0.02, 142.26571515109902, 97.0367931832507, 124.784180059664},
                         Row{0.05, 193.02950228613582, 125.2918311107484, 169.41944646474985},
                         Row{0.2, 865.2380442539388, 560.3534406521327, 759.4946488823023}}) {
    while (k < std::lround(row.strain / 0.01)) path.step({0, 0, 0, std::expm1(-0.01 * ++k), 0});
    CHECK(path.stress()[1] == Approx(-1e3 * row.axial).epsilon(1e-4));
    CHECK(path.stress()[0] == Approx(-1e3 * row.radial).epsilon(1e-4));
    CHECK(path.now[4] == Approx(1e3 * row.pc).epsilon(1e-4));
  }
  CHECK(path.stress()[0] / path.stress()[1] == Approx(0.6476292208559854).epsilon(1e-4));
  CHECK(clay(1).eta_at_rest() == Approx(0.4605635331608116).epsilon(1e-12));
}

TEST_CASE("the overconsolidation ratio is one of vertical stresses at rest, and otherwise one of yield surfaces") {
  struct Row {
    double OCR, K0, pc;
  };
  for (const Row& row : {Row{1, 0.6476292208559854, 87.7786932671487}, Row{2, 0.8666870131405422, 175.5573865342974},
                         Row{4, 1.3048025977096558, 351.1147730685948}}) {
    const CamClay<plane_strain> law(clay(row.OCR));
    const Stress<plane_strain> sigma = {row.K0 * cell_pressure, cell_pressure, row.K0 * cell_pressure, 0};
    CHECK(law.initial_history(sigma, {.at_rest = true})[4] == Approx(1e3 * row.pc).epsilon(1e-12));
    const double p = (1 + 2 * row.K0) / 3 * 1e5, q = std::abs(1 - row.K0) * 1e5;
    CHECK(law.initial_history(sigma)[4] == Approx(row.OCR * (p + q * q / (1.44 * p))).epsilon(1e-12));
  }
  // Ground that no normal consolidation could bring there lies on its yield surface
  const CamClay<plane_strain> law(clay(1));
  const auto steep =
      law.initial_history({0.4 * cell_pressure, cell_pressure, 0.4 * cell_pressure, 0}, {.at_rest = true});
  CHECK(law.yield_state(steep).f == Approx(0).margin(1e-6));
  CHECK(law.initial_history({cell_pressure, cell_pressure, cell_pressure, 0},
                            {.at_rest = false, .consolidation = 3})[4] == Approx(3e5));
  // Outside of the yield surface f is positive, at its tip too, where there is no strength
  CamClayParameters weak = clay(1);
  weak.pc = 0.5e5;
  const CamClay<plane_strain> pressed(weak);
  CHECK(pressed.yield_state(pressed.initial_history({cell_pressure, cell_pressure, cell_pressure, 0})).f > 1e4);
  CHECK(pressed.yield_state(pressed.initial_history({cell_pressure, cell_pressure, cell_pressure, 0})).strength == 0);
}

TEMPLATE_TEST_CASE_SIG("moduli of Cam clay are the derivative of the stress, on the wet side, on the dry one, elastic",
                       "", ((StressState S), S), plane_strain, axisymmetric, space) {
  constexpr int n = gradient_components(S);
  Stress<S> sigma{};
  for (int a = 0; a < 3; ++a) sigma[a] = -1e5 - 2e4 * a;
  sigma[3] = 1e4;
  const bool evolves = GENERATE(true, false);
  for (const double OCR : {1.0, 1.3, 5.0}) {
    const CamClay<S> law(clay(OCR, evolves));
    const auto now = law.initial_history(sigma);
    for (const double size : {-1e-2, -3e-3, -1e-5, 1e-5, 3e-3, 1e-2, 3e-2}) {
      Gradient<S> H{};
      for (int a = 0; a < n; ++a) H[a] = size * (a % 3 == 0 ? 0.3 : a % 2 == 0 ? -0.2 : 0.25);
      const auto P = [&](const Gradient<S>& at) {
        auto next = now;
        return law.first_piola(at, at, 0, next);
      };
      CAPTURE(OCR, size, evolves);
      CHECK(checks::relative_distance(law.moduli(H, H, 0, now), checks::differences<S>(P, H)) < 1e-6);  // rounding/d
      const auto A = law.elastic_moduli(H, now);
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < a; ++b) CHECK(A[n * a + b] == Approx(A[n * b + a]).margin(1e-9 * A[0]));
    }
  }
}

TEST_CASE("the tangent of pure shear at the tip of the ellipse, where it begins, is finite and right") {
  const CamClay<axisymmetric> law(clay(1));
  const auto now = law.initial_history({cell_pressure, cell_pressure, cell_pressure, 0});
  for (const double size : {1e-9, 1e-6, 1e-3}) {
    const Gradient<axisymmetric> H = {size / 2, 0, 0, -size, size / 2};
    const auto A = law.moduli(H, H, 0, now);
    for (const double modulus : A) CHECK(std::isfinite(modulus));
  }
  const Gradient<axisymmetric> H = {5e-4, 0, 0, -1e-3, 5e-4};
  const auto P = [&](const Gradient<axisymmetric>& at) {
    auto next = now;
    return law.first_piola(at, at, 0, next);
  };
  CHECK(checks::relative_distance(law.moduli(H, H, 0, now), checks::differences<axisymmetric>(P, H)) < 1e-6);
}

TEST_CASE("Cam clay in the plane and around an axis is that in space, and turned axes see the turned stress") {
  const CamClay<axisymmetric> around(clay(1.5));
  const CamClay<plane_strain> flat(clay(1.5));
  const CamClay<space> law(clay(1.5));
  const SpaceTensor Q = checks::rotation<SpaceTensor>(0.8);
  const auto turned = [&](const Gradient<space>& H) {
    return gradient_part<space>(Q * displacement_gradient<space>(H) * transpose(Q));
  };
  const Stress<axisymmetric> first = {-8e4, -1.2e5, -1e5, 1e4};
  const Stress<space> in_space = {first[0], first[1], first[2], first[3], 0, 0};
  auto of_axis = around.initial_history(first), of_plane = flat.initial_history(first);
  auto raised = law.initial_history(in_space), raised_plane = raised,
       there = law.initial_history(checks::turned<space>(Q, in_space));
  Gradient<space> last{}, last_plane{};
  double yielded = 0;
  for (int k = 1; k <= 200; ++k) {
    // A loop of compression, shear and swelling
    const double a = 0.03 * k / 200, b = 0.04 * std::sin(0.05 * k), c = 0.02 * std::sin(0.02 * k);
    const Gradient<axisymmetric> H = {-a + c, b, -b / 2, -2 * a + c, -a / 2};
    const Gradient<space> H3 = {H[0], H[1], 0, H[2], H[3], 0, 0, 0, H[4]}, H2 = {H[0], H[1], 0, H[2], H[3], 0, 0, 0, 0};
    const Gradient<space> dH3 = minus<space>(H3, last), dH2 = minus<space>(H2, last_plane);
    const double pc = raised[6];
    around.first_piola(H, Gradient<axisymmetric>{dH3[0], dH3[1], dH3[3], dH3[4], dH3[8]}, 0, of_axis);
    flat.first_piola(Gradient<plane_strain>{H[0], H[1], H[2], H[3]},
                     Gradient<plane_strain>{dH2[0], dH2[1], dH2[3], dH2[4]}, 0, of_plane);
    const auto P = law.first_piola(H3, dH3, 0, raised);
    law.first_piola(H2, dH2, 0, raised_plane);
    const auto P_there = law.first_piola(turned(H3), turned(dH3), 0, there);
    CHECK(largest_difference(P_there, turned(P)) < 1e-12 * raised[6]);
    yielded += std::abs(raised[6] - pc);
    last = H3;
    last_plane = H2;
  }
  CHECK(yielded > 1e4);
  for (std::size_t a = 0; a < 4; ++a) {
    CHECK(raised[a] == Approx(of_axis[a]).margin(1e-12 * raised[6]));
    CHECK(raised_plane[a] == Approx(of_plane[a]).margin(1e-12 * raised[6]));
  }
  for (std::size_t a = 0; a < 2; ++a) {
    CHECK(raised[6 + a] == Approx(of_axis[4 + a]).epsilon(1e-12));
    CHECK(raised_plane[6 + a] == Approx(of_plane[4 + a]).epsilon(1e-12));
  }
}

TEST_CASE("an elastic cycle of strain brings Cam clay back to its stress, and so does no increment at all") {
  ClayPath<plane_strain> path(clay(5), {-1e5, -1.1e5, -0.9e5, 5e3});
  const auto first = path.now;
  path.step({});
  for (std::size_t h = 0; h < first.size(); ++h) CHECK(path.now[h] == first[h]);
  // There and back along a straight path, which is exact: the elastic law is no function of the strain on others
  path.go({-0.004, 0.001, 0.001, 0.002}, 7);
  CHECK(path.stress()[1] != Approx(first[1]).epsilon(1e-3));
  path.go({}, 3);
  for (std::size_t h = 0; h < first.size(); ++h)
    CHECK(path.now[h] == Approx(first[h]).epsilon(2e-6).margin(0.1));  // second order
  CHECK(path.now[4] == first[4]);
  CHECK(path.now[6] == 0);
}

TEST_CASE("all paths of shear end in the critical state, where nothing but the shape changes") {
  for (const double OCR : {1.0, 2.0, 5.0, 20.0}) {
    ClayPath<plane_strain> path(clay(OCR), {cell_pressure, cell_pressure, cell_pressure, 0});
    for (int k = 1; k <= 400; ++k) {  // at a constant volume
      const double a = 0.0025 * k;
      path.step({std::expm1(a), 0, 0, std::expm1(-a)});
    }
    const Stress<plane_strain> s = path.stress();
    const double p = -(s[0] + s[1] + s[2]) / 3, root_J2 = std::sqrt(second_invariant(deviator_of<plane_strain>(s, -p)));
    CHECK(std::sqrt(3) * root_J2 / p == Approx(1.2).epsilon(1e-6));
    const double before = path.now[6];  // there all strain is plastic
    path.step({std::expm1(1.0025), 0, 0, std::expm1(-1.0025)});
    CHECK(path.now[6] - before == Approx(2 * 0.0025).epsilon(1e-5));
    CHECK(path.now[4] / p == Approx(2).epsilon(1e-6));
    // κ ln p + (λ − κ) ln p_c does not change: p = ½ p_c = 100 (OCR/2)^((λ − κ)/λ) kPa
    CHECK(p == Approx(1e5 * std::pow(OCR / 2, 0.8)).epsilon(1e-6));
  }
}

TEST_CASE("an increment far beyond kappa, or beyond what the flow resolves, is not a number") {
  const auto is_refused = [](double OCR, const Gradient<plane_strain>& H) {
    ClayPath<plane_strain> path(clay(OCR), {cell_pressure, cell_pressure, cell_pressure, 0});
    const auto P = path.step(H);
    return std::isnan(P[0] + P[1] + P[2] + P[3]);
  };
  CHECK(is_refused(1e9, {-0.2, 0, 0, -0.2}));
  CHECK(is_refused(1e9, {0.2, 0, 0, 0.2}));
  CHECK(is_refused(1, {0, 0.5, 0, 0}));
  CHECK(is_refused(1, {-1.5, 0, 0, 0}));
  CHECK(!is_refused(1, {0, 0.05, 0, 0}));
  CHECK(!is_refused(1, {-0.03, 0, 0, -0.03}));
  CHECK(!is_refused(5, {0.03, 0, 0, 0.03}));
}

TEST_CASE("the stiffness of Cam clay is that of the present pressure and volume") {
  ClayPath<space> path(clay(1), {cell_pressure, cell_pressure, cell_pressure, 0, 0, 0});
  const double K = path.law.moduli_at(path.now).bulk;
  CHECK(K == Approx(2 * 1e5 / 0.04));
  CHECK(path.law.moduli_at(path.now).shear == Approx(1.5 * 0.4 / 1.3 * K));
  path.go({-0.03, 0, 0, 0, -0.03, 0, 0, 0, -0.03}, 10);
  const double v = 2 * std::pow(0.97, 3), p = -path.stress()[0];
  CHECK(p == Approx(1e5 * std::exp((2 - v) / 0.2)).epsilon(1e-10));
  CHECK(path.law.moduli_at(path.now).bulk == Approx(v * p / 0.04).epsilon(1e-12));
}

}  // namespace stillpoint
