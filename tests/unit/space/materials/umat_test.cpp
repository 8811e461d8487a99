// UMATs of ours at a point, beside the built-in laws.
#include "space/materials/umat.hpp"

#include <stillpoint/cam_clay.hpp>
#include <stillpoint/drucker_prager.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "compiled_umat.hpp"
#include "largest.hpp"
#include "law_checks.hpp"
#include "space/materials/umat_utilities.hpp"

using namespace stillpoint;
using stillpoint::test::compiled_umat;

namespace {

constexpr double clay_E = 1e4, clay_nu = 0.3, clay_strength = 20;

MaterialSpec umat_material(const std::filesystem::path& library, std::vector<double> props,
                           std::vector<std::string> statev = {}) {
  MaterialSpec spec;
  spec.name = "clay";
  spec.law = "umat";
  spec.library = library;
  spec.props = std::move(props);
  spec.statev = std::move(statev);
  return spec;
}

// A point on a path, of a law whose history is known as it runs.
template <StressState S>
struct AnsweredPath {
  const HistoryAnswers& law;
  std::vector<double> now = std::vector<double>(law.history());

  explicit AnsweredPath(const HistoryAnswers& of, const Stress<S>& stress = {}) : law(of) {
    law.initial_history(stress.data(), now.data());
  }
  Gradient<S> trial(const Gradient<S>& H, const Gradient<S>& dH, std::vector<double>& next) const {
    Gradient<S> P;
    law.first_piola({.points = 1,
                     .stride = 1,
                     .H = H.data(),
                     .dH = dH.data(),
                     .P = P.data(),
                     .dt = 0.1,
                     .history_stride = 1,
                     .committed = now.data(),
                     .next = next.data()});
    return P;
  }
  Gradient<S> step(const Gradient<S>& H, const Gradient<S>& dH) {
    std::vector<double> next(now.size());
    const Gradient<S> P = trial(H, dH, next);
    now.swap(next);
    return P;
  }
};

// Random increments that turn and strain the point by up to a third, some of them too large for the strength.
template <StressState S>
struct RandomWalk {
  std::mt19937 random{7};
  Gradient<S> H{}, dH{};
  void go(double size) {
    std::uniform_real_distribution<double> any(-size, size);
    for (std::size_t c = 0; c < H.size(); ++c) {
      dH[c] = any(random);
      H[c] += dH[c];
    }
  }
};

// The largest difference of P along a walk, relative to the largest entry.
template <StressState S, class Law>
double distance_along_a_walk(const HistoryAnswers& umat, const Law& law, double step = 0.02) {
  Stress<S> start{};
  start[0] = -5, start[1] = -9, start[2] = -6, start[3] = 2;
  AnsweredPath<S> path(umat, start);
  auto now = law.initial_history(start, {});
  RandomWalk<S> walk;
  Largest apart, size;
  for (int k = 0; k < 200; ++k) {
    walk.go(step);
    const Gradient<S> P = law.first_piola(walk.H, walk.dH, 0.1, now), Q = path.step(walk.H, walk.dH);
    for (std::size_t c = 0; c < P.size(); ++c) {
      apart.take_magnitude(P[c] - Q[c]);
      size.take_magnitude(P[c]);
    }
  }
  return apart.value() / size.value();
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a UMAT in Fortran or C answers as the built-in law of its formula along 200 large increments",
                       "", ((StressState S), S), StressState::plane_strain, StressState::axisymmetric,
                       StressState::space) {
  const test::TemporaryFolder folder;
  const DruckerPrager<S> elastic({.E = clay_E, .nu = clay_nu, .c = 1e12}),
      mises({.E = clay_E, .nu = clay_nu, .c = clay_strength});
  constexpr double rounding = 1e-10;  // of 200 increments
  CHECK(distance_along_a_walk<S>(
            *make_umat<S>(umat_material(compiled_umat(folder, "elastic.f", "elastic"), {clay_E, clay_nu})), elastic) <
        rounding);
  for (const char* source : {"von_mises.f", "von_mises.c"}) {
    INFO(source);
    const auto library = compiled_umat(folder, source, source);
    CHECK(distance_along_a_walk<S>(
              *make_umat<S>(umat_material(library, {clay_E, clay_nu, clay_strength}, {"plastic_strain"})), mises) <
          rounding);
    CHECK(distance_along_a_walk<S>(*make_umat<S>(umat_material(library, {clay_E, clay_nu, 2 * clay_strength}, {""})),
                                   mises) > 1e-3);
  }
}

TEMPLATE_TEST_CASE_SIG("a UMAT of Cam clay answers as the built-in law along 200 increments, wet, dry and in between",
                       "", ((StressState S), S), StressState::plane_strain, StressState::axisymmetric,
                       StressState::space) {
  const test::TemporaryFolder folder;
  const auto library = compiled_umat(folder, "cam_clay.f", "cam_clay");
  for (const double OCR : {1.0, 1.5, 8.0}) {
    CAPTURE(OCR);
    const CamClayParameters clay{.M = 1.2, .lambda = 0.2, .kappa = 0.04, .nu = 0.3, .e0 = 1, .OCR = OCR};
    const auto umat = make_umat<S>(umat_material(library, {clay.M, clay.lambda, clay.kappa, clay.nu, clay.e0, OCR},
                                                 {"pc", "void_ratio", "strain"}));
    constexpr double rounding = 1e-10, step = 2e-3;  // of 200 increments, which are in reach of the flow
    CHECK(distance_along_a_walk<S>(*umat, CamClay<S>(clay), step) < rounding);
    CamClayParameters other = clay;
    other.kappa *= 1.01;
    CHECK(distance_along_a_walk<S>(*umat, CamClay<S>(other), step) > 1e-4);
  }
}

TEMPLATE_TEST_CASE_SIG("the moduli of a UMAT are the derivative of its answer, elastic and plastic, however it turns",
                       "", ((StressState S), S), StressState::plane_strain, StressState::axisymmetric,
                       StressState::space) {
  constexpr std::size_t n = gradient_components(S);
  const test::TemporaryFolder folder;
  const auto library = compiled_umat(folder, "von_mises.f", "von_mises");
  for (const double k : {clay_strength, 1e12}) {
    const auto law = make_umat<S>(umat_material(library, {clay_E, clay_nu, k}, {"plastic_strain"}));
    AnsweredPath<S> path(*law);
    RandomWalk<S> walk;
    for (int step = 0; step < 10; ++step) {
      walk.go(0.05);
      const auto trial = [&](const Gradient<S>& to) {
        Gradient<S> change = walk.dH;
        for (std::size_t a = 0; a < n; ++a) change[a] += to[a] - walk.H[a];
        std::vector<double> next(path.now.size());
        return path.trial(to, change, next);
      };
      Moduli<S> A;
      law->moduli(walk.H.data(), walk.dH.data(), 0.1, path.now.data(), A.data());
      CHECK(checks::relative_distance(A, checks::differences<S>(trial, walk.H)) < 1e-6);
      path.step(walk.H, walk.dH);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("the elastic moduli of a UMAT are those of the built-in law under the same stress", "",
                       ((StressState S), S), StressState::plane_strain, StressState::axisymmetric, StressState::space) {
  const test::TemporaryFolder folder;
  const auto umat = make_umat<S>(umat_material(compiled_umat(folder, "elastic.f", "elastic"), {clay_E, clay_nu}));
  const DruckerPrager<S> law({.E = clay_E, .nu = clay_nu, .c = 1e12});
  Stress<S> stress{};
  stress[0] = -500, stress[1] = -900, stress[2] = -600, stress[3] = 200;
  AnsweredPath<S> path(*umat, stress);
  for (const auto& H : checks::deformations<S>()) {
    Moduli<S> A;
    umat->elastic_moduli(H.data(), path.now.data(), A.data());
    CHECK(checks::relative_distance(A, law.elastic_moduli(H, law.initial_history(stress))) < 1e-12);  // rounding
  }
}

TEST_CASE("a rigid rotation turns the stress and the strain of a UMAT, and tells it the whole rotation") {
  constexpr StressState S = StressState::space;
  const test::TemporaryFolder folder;
  const auto law = make_umat<S>(umat_material(compiled_umat(folder, "elastic.f", "elastic"), {clay_E, clay_nu}));
  const Stress<S> start{1, 2, 3, 4, 5, 6};
  AnsweredPath<S> path(*law, start);
  // By 90 degrees about z, in ten increments: x to y, y to −x.
  Gradient<S> H{};
  for (int k = 1; k <= 10; ++k) {
    const double angle = k * std::acos(-1.0) / 20, c = std::cos(angle), s = std::sin(angle);
    const Gradient<S> to{c - 1, -s, 0, s, c - 1, 0, 0, 0, 0};
    Gradient<S> dH;
    for (std::size_t a = 0; a < dH.size(); ++a) dH[a] = to[a] - H[a];
    H = to;
    path.step(H, dH);
  }
  Stress<S> found;
  law->cauchy(path.now.data(), found.data());
  CHECK(largest_difference(found, Stress<S>{2, 1, 3, -4, 6, -5}) < 1e-12);
}

TEST_CASE("Abaqus' utility routines turn tensors, and find invariants and principal values and directions") {
  const int stress = 1, strain = 2, normals = 3, one = 1, shears = 3;
  const double c = std::cos(0.3), s = std::sin(0.3);
  const std::array<double, 9> R{c, s, 0, -s, c, 0, 0, 0, 1};  // by columns
  const std::array<double, 6> S{3, 1, 2, 0.5, 0.2, -0.4};
  std::array<double, 6> turned{};
  rotsig_(S.data(), R.data(), turned.data(), &stress, &normals, &shears);
  CHECK(turned[0] == Approx(3 * c * c + 1 * s * s - 2 * 0.5 * s * c));
  CHECK(turned[3] == Approx((3 - 1) * s * c + 0.5 * (c * c - s * s)));
  CHECK(turned[4] == Approx(0.2 * c + 0.4 * s));
  CHECK(turned[5] == Approx(0.2 * s - 0.4 * c));
  std::array<double, 4> in_plane{3, 1, 2, 0.5}, turned_strain{};
  rotsig_(in_plane.data(), R.data(), turned_strain.data(), &strain, &normals, &one);
  CHECK(turned_strain[3] == Approx(2 * ((3 - 1) * s * c + 0.25 * (c * c - s * s))));

  double mean = 0, mises = 0;
  sinv_(S.data(), &mean, &mises, &normals, &shears);
  CHECK(mean == Approx(2));
  CHECK(mises == Approx(std::sqrt(0.5 * (4 + 1 + 1) + 3 * (0.25 + 0.04 + 0.16))));

  std::array<double, 3> values{};
  std::array<double, 9> directions{};
  sprind_(S.data(), values.data(), directions.data(), &stress, &normals, &shears);
  const auto at = [&](int i, int j) {
    const int shear = i + j + 2;  // 12, 13, 23 are at 3, 4, 5
    return i == j ? S[static_cast<std::size_t>(i)] : S[static_cast<std::size_t>(shear)];
  };
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) {
      double product = 0;
      for (int j = 0; j < 3; ++j) product += at(i, j) * directions[static_cast<std::size_t>(k + 3 * j)];
      CHECK(product == Approx(values[static_cast<std::size_t>(k)] * directions[static_cast<std::size_t>(k + 3 * i)]));
    }
  }
  std::array<double, 3> alone{};
  sprinc_(S.data(), alone.data(), &stress, &normals, &shears);
  CHECK(largest_difference(alone, values) < 1e-14);
}

TEST_CASE("a UMAT that asks for a smaller step, or that leaves, gives no number, and leaving is told once") {
  constexpr StressState S = StressState::plane_strain;
  const test::TemporaryFolder folder;
  const Gradient<S> small{1e-4, 0, 0, 0}, large{0.05, 0, 0, 0};
  for (const char* fault : {"SHORTENS", "LEAVES"}) {
    INFO(fault);
    const auto law = make_umat<S>(umat_material(
        compiled_umat(folder, "faulty.c", fault, std::string("-D") + fault + " -Wl,--unresolved-symbols=ignore-all"),
        {}));
    AnsweredPath<S> path(*law);
    std::vector<double> next(path.now.size());
    CHECK(std::isfinite(path.trial(small, small, next)[0]));
    CHECK(std::isnan(path.trial(large, large, next)[0]));
    CHECK(std::isfinite(path.trial(small, small, next)[0]));
    if (std::string(fault) == "LEAVES") {
      CHECK_THROWS_AS(law->throw_what_failed(), std::runtime_error);
    }
    CHECK_NOTHROW(law->throw_what_failed());
  }
}

TEST_CASE("what a UMAT keeps between calls is found: its calls take turns, or it is refused") {
  constexpr StressState S = StressState::plane_strain;
  const test::TemporaryFolder folder;
  const auto fault_of = [&](const std::string& name, const std::string& options) -> std::string {
    const auto law = make_umat<S>(
        umat_material(compiled_umat(folder, "faulty.c", name, options + " -Wl,--unresolved-symbols=ignore-all"), {1}));
    try {
      law->try_out(AnsweredPath<S>(*law).now.data());
    } catch (const std::domain_error& fault) {
      return fault.what();
    }
    std::string notes;
    for (const std::string& note : law->notes()) notes += note;
    return notes;
  };
  const auto says = [](const std::string& text, const char* what) { return text.find(what) != std::string::npos; };
  CHECK(fault_of("faultless", "").empty());
  CHECK(says(fault_of("counts", "-DCOUNTS"), "its calls take turns"));
  CHECK(says(fault_of("tires", "-DTIRES"), "keeps a state of its own between calls"));
  CHECK(says(fault_of("unstable", "-DUNSTABLE"), "DDSDDE that is not positive definite (least eigenvalue -1e+04)"));
  CHECK(says(fault_of("no_number", "-DNO_NUMBER"), "returns STRESS = [nan"));
  CHECK(says(fault_of("leaves", "-DLEAVES_AT_ONCE"), "calls XIT in its first call"));
  CHECK(says(fault_of("writes", "-DWRITES_PROPS"), "writes to PROPS"));
  CHECK(says(fault_of("viscous", "-DVISCOUS"), "answers to the rate of strain"));
}

TEST_CASE("a library without a UMAT is told apart from one that is missing, is none, or lacks something") {
  const test::TemporaryFolder folder;
  const auto fault_of = [&](const std::filesystem::path& library) -> std::string {
    const auto fault = fault_of_umat(umat_material(library, {}));
    return fault ? std::string(fault->key) + ": " + fault->message : "";
  };
  const auto says = [](const std::string& text, const std::string& what) {
    INFO(text);
    return text.starts_with("library: ") && text.find(what) != std::string::npos;
  };
  CHECK(says(fault_of(folder.path() / "nothing.so"), "there is no file"));
  CHECK(says(fault_of(folder.path()), "cannot be loaded"));
  CHECK(says(fault_of(folder.write("text.so", "no library\n")), "cannot be loaded"));
  CHECK(says(fault_of(compiled_umat(folder, "faulty.c", "nobody", "-DCALLS_NOBODY")), "undefined symbol: is_nowhere_"));
  CHECK(says(fault_of(compiled_umat(folder, "faulty.c", "other", "-DNAME=umat2_")), "has no subroutine UMAT"));
  CHECK(fault_of(compiled_umat(folder, "faulty.c", "in_c", "-DNAME=umat")).empty());
}

TEMPLATE_TEST_CASE_SIG("a UMAT is given the deformation, the rotation, the strain, the time and the place of its point",
                       "", ((StressState S), S), StressState::plane_strain, StressState::axisymmetric,
                       StressState::space) {
  const test::TemporaryFolder folder;
  const auto law = make_umat<S>(
      umat_material(compiled_umat(folder, "recorder.c", "recorder"), {7, 8}, std::vector<std::string>(56, "")));
  constexpr std::size_t tensor = stress_components(S);
  AnsweredPath<S> path(*law);
  law->place({1.5, 2.5, S == StressState::space ? 3.5 : 0}, 41, 0.25, path.now.data());
  // Two increments of simple shear of a point that is stretched along x as well, in a phase of their own each.
  Gradient<S> H{}, shear{};
  H[0] = 0.1;
  shear[1] = 0.2;
  path.step(H, H);
  path.step(shear, shear);
  const double* const states = path.now.data() + 2 * tensor;
  // F = (I + 0.2 e_x ⊗ e_y) (I + 0.1 e_x ⊗ e_x), column by column
  std::array<double, 9> F{1.1, 0, 0, 0.2, 1, 0, 0, 0, 1}, before{1.1, 0, 0, 0, 1, 0, 0, 0, 1}, R{}, DFGRD1{}, DFGRD0{};
  std::copy_n(states, 9, DFGRD1.begin());
  std::copy_n(states + 9, 9, DFGRD0.begin());
  CHECK(largest_difference(DFGRD1, F) < 1e-15);
  CHECK(largest_difference(DFGRD0, before) < 1e-15);
  // l = dH (I + dH/2)⁻¹ = dH, as dH dH = 0: w_xy = 0.1, and R turns by −2 arctan(0.1/2) about z
  const double angle = -2 * std::atan(0.05), c = std::cos(angle), s = std::sin(angle);
  std::copy_n(states + 18, 9, R.begin());
  CHECK(largest_difference(R, std::array<double, 9>{c, s, 0, -s, c, 0, 0, 0, 1}) < 1e-15);
  // STRAN: 0.1/1.05 along x, turned, and the strain 0.2 of the shear, turned by half
  const double e = 0.1 / 1.05, sin_half = std::sin(angle / 2), cos_half = std::cos(angle / 2);
  std::array<double, 6> strain{}, expected{};
  expected[0] = e * c * c - 0.2 * sin_half * cos_half;
  expected[1] = e * s * s + 0.2 * sin_half * cos_half;
  expected[3] = 2 * e * s * c + 0.2 * (cos_half * cos_half - sin_half * sin_half);
  std::copy_n(states + 27, 6, strain.begin());
  CHECK(largest_difference(strain, expected) < 1e-15);
  const std::vector<double> told(states + 33, states + 56);
  const double in_space = S == StressState::space;
  CHECK(told == std::vector<double>{1.5,
                                    2.5,
                                    3.5 * in_space,
                                    0.1,
                                    0.1,
                                    0.1,
                                    2,
                                    0.25,
                                    42,
                                    3,
                                    1 + 2 * in_space,
                                    4 + 2 * in_space,
                                    56,
                                    2,
                                    'C',
                                    ' ',
                                    80,
                                    1,
                                    1,
                                    1,
                                    1,
                                    0,
                                    7});
}

TEST_CASE("in space a UMAT is given the shears 12, 13 and 23 in this order, and its stresses are taken so") {
  constexpr StressState S = StressState::space;
  const test::TemporaryFolder folder;
  const auto law = make_umat<S>(
      umat_material(compiled_umat(folder, "recorder.c", "recorder"), {7, 8}, std::vector<std::string>(56, "")));
  constexpr std::array<std::size_t, 3> of_gradient{1, 2, 5}, of_stress{3, 5, 4};  // xy, xz, yz
  for (std::size_t shear = 0; shear < 3; ++shear) {
    CAPTURE(shear);
    AnsweredPath<S> path(*law);
    Gradient<S> H{};
    H[of_gradient[shear]] = 1e-6;
    path.step(H, H);
    Stress<S> stress;
    law->cauchy(path.now.data(), stress.data());
    for (std::size_t k = 0; k < 3; ++k) {
      const double strain = path.now[2 * stress.size() + 27 + 3 + k];
      CHECK(strain == Approx(k == shear ? 1e-6 : 0).margin(1e-11));  // of second order
      CHECK(stress[of_stress[k]] == Approx(k == shear ? 0.5e4 * 1e-6 : 0).margin(1e-7));
    }
  }
}
