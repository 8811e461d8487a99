// What a phase in the plane must hold exactly whatever the places of its points: uniform strain and rigid motion.
#include <stillpoint/hencky.hpp>
#include <stillpoint/linear_elastic.hpp>
#include <stillpoint/neo_hookean.hpp>

#include <array>
#include <numbers>

#include <fmt/format.h>

#include "largest.hpp"
#include "scenes.hpp"
#include "statics.hpp"

using namespace stillpoint;
using Catch::Matchers::WithinAbs;

namespace {

/// The block of problems/block.toml, held and loaded by nothing.
Scene patch_block(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.end(), {"support=[]", "traction=[]", "probe=[]", "damping.c=1.0"});
  return scenes::load("block", overrides);
}

struct Matrix {  // of a displacement gradient
  double xx, xy, yx, yy;
};

/// u = A x as the scene's initial displacement.
void deform(Scene& scene, const Matrix& A) {
  const auto row = [](double x, double y) { return fmt::format("{:.17g}*x + {:.17g}*y", x, y); };
  scene.initial_u = {Expression(row(A.xx, A.xy), {}, "xy"), Expression(row(A.yx, A.yy), {}, "xy")};
}

Matrix rotation(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle) - 1, -std::sin(angle), std::sin(angle), std::cos(angle) - 1};
}

/// Loads every face with P N as a dead traction.
void pull_all_faces(Scene& scene, const std::array<double, 4>& P) {
  for (const auto& [face, n_x, n_y] :
       {std::tuple{Face::left, -1, 0}, {Face::right, 1, 0}, {Face::bottom, 0, -1}, {Face::top, 0, 1}}) {
    scene.tractions.push_back({.face = face,
                               .value = {Expression(P[0] * n_x + P[1] * n_y), Expression(P[2] * n_x + P[3] * n_y)},
                               .pressure = {}});
  }
}

constexpr Matrix stretched_square{0.2, 0.15, -0.05, -0.1};

/// P of a law in plane strain (E = 1, ν = 0.3).
std::array<double, 4> uniform_stress(const std::string& law, const Matrix& A) {
  const Gradient<StressState::plane_strain> H = {A.xx, A.xy, A.yx, A.yy};
  const LameParameters m = LameParameters::from(1, 0.3);
  if (law == "neo-hookean") return NeoHookean<StressState::plane_strain>(m).first_piola(H);
  if (law == "hencky") return Hencky<StressState::plane_strain>(m).first_piola(H);
  return LinearElastic<StressState::plane_strain>(m).first_piola(H);
}

struct Placed {
  std::string basis, points;  // a cell
};
// As many points as each basis needs: for its mass to be definite, and for ∇N, of degree p, to be integrated.
const std::vector<Placed> placed_bases = {{"linear", "4"}, {"quadratic", "9"}, {"cubic", "16"}, {"hermite", "25"}};

/// Largest |F − R| over every function, of a block under the tractions that its uniform strain needs.
double patch_residual(const std::string& law, std::vector<std::string> overrides) {
  overrides.push_back("material.rubber.law=" + law);
  Scene scene = patch_block(overrides);
  deform(scene, stretched_square);
  const auto P = uniform_stress(law, stretched_square);
  pull_all_faces(scene, P);
  const auto phase = make_phase(scene);
  const auto u = phase->initial_displacement(0);
  const auto first = statics::point_stress(*phase, u);
  for (std::size_t k = 0; k < first.size(); ++k) CHECK_THAT(first[k], WithinAbs(first[k % 4], 1e-10));
  return largest_magnitude(statics::out_of_balance(*phase, u)) / largest_magnitude(P);
}

std::string with_kind(const std::string& basis) {
  return basis == "hermite" ? "mass.kind=consistent" : "mass.kind=lumped";
}

}  // namespace

TEST_CASE("a uniform strain is in balance with its tractions at every node, boundary included (patch test)") {
  for (const auto& [basis, points] : placed_bases) {
    for (const std::string law : {"linear-elastic", "neo-hookean", "hencky"}) {
      for (const std::string placement : {"gauss", "uniform"}) {
        for (const std::string dilatation : {"points", "cells"}) {
          CAPTURE(basis, law, placement, dilatation);
          CHECK(patch_residual(law,
                               {"grid.basis=" + basis, "body.points_per_cell=" + points, "body.placement=" + placement,
                                "phase.dilatation=" + dilatation, with_kind(basis)}) < 1e-12);
        }
      }
    }
  }
}

TEST_CASE("jittered points pass the patch test where their volumes are fitted to their places") {
  // The bilinear ∇N is of degree 1 in each coordinate: any four places in a cell that carry that degree will do. For
  // the smoother bases there must be more points than the (p + 1)² moments of ∇N, or a volume would have to be
  // negative.
  for (const auto& [basis, points] : {Placed{"linear", "4"}, {"linear", "9"}, {"quadratic", "36"}}) {
    CAPTURE(basis, points);
    const auto off = [&, basis = basis, points = points](const std::string& volumes) {
      return patch_residual("neo-hookean", {"grid.basis=" + basis, "body.points_per_cell=" + points, "body.jitter=0.3",
                                            "body.volumes=" + volumes});
    };
    CHECK(off("consistent") < 1e-12);
    CHECK(off("equal") > 1e-4);  // the claim is about the volumes: equal ones do not integrate ∇N at such places
  }
}

TEST_CASE("forces of bilinear cells are those of the assembled stiffness, for any number of points in a cell") {
  // R(u) = K u if the law is linear: R takes its points a few at a time and its cells a block at a time, K point by
  // point. A block holds 128 points, so that 169 do not fit.
  for (const std::string state : {"plane-strain", "axisymmetric"}) {
    for (const std::string points : {"1", "4", "9", "25", "169"}) {
      CAPTURE(state, points);
      const auto phase = make_phase(
          patch_block({"material.rubber.law=linear-elastic", "body.state=" + state, "grid.basis=linear",
                       "mass.kind=lumped", "body.jitter=0.3", "body.volumes=equal", "body.points_per_cell=" + points}));
      std::vector<double> u(phase->size());
      for (std::size_t i = 0; i < u.size(); ++i) u[i] = std::sin(static_cast<double>(i * i + 1));
      const std::vector<double> R = statics::internal_force(*phase, u);
      const auto n = static_cast<Eigen::Index>(u.size());
      const Eigen::VectorXd Ku =
          phase->tangents().matrix(Tangent::consistent, 0, u) * Eigen::Map<const Eigen::VectorXd>(u.data(), n);
      CHECK((Eigen::Map<const Eigen::VectorXd>(R.data(), n) - Ku).norm() < 1e-13 * Ku.norm());
    }
  }
}

TEST_CASE("a rotation by a long step predicts no stress, and with that the body turns on as freely as before it") {
  // Along u = ω × x the body is stretched to √(1 + ω²), which no small rotation does: the tangent at 0 predicts S = 0.
  constexpr double w = 0.5;
  constexpr Matrix by_step{0, -w, w, 0}, further{-w, -1, 1, -w};  // the latter W (I + H), with the spin W
  for (const std::string law : {"neo-hookean", "hencky"}) {
    for (const std::string state : {"plane-strain", "plane-stress"}) {
      for (const auto& [basis, points] : {Placed{"linear", "4"}, {"quadratic", "9"}}) {
        CAPTURE(law, state, basis);
        const auto field = [&, basis = basis, points = points](const Matrix& A) {
          Scene scene = patch_block({"material.rubber.law=" + law, "body.state=" + state, "grid.basis=" + basis,
                                     "body.points_per_cell=" + points});
          deform(scene, A);
          auto phase = make_phase(scene);
          auto u = phase->initial_displacement(0);
          return std::pair(std::move(phase), std::move(u));
        };
        const auto [phase, u] = field(by_step);
        const std::vector<double> spin = field(further).second, from(u.size(), 0.0);
        const auto n = static_cast<Eigen::Index>(u.size());
        const Eigen::Map<const Eigen::VectorXd> turned(spin.data(), n);
        const SparseMatrix K = phase->tangents().matrix(Tangent::consistent, 0, u),
                           ahead = phase->tangents().matrix_ahead(0, u, from);
        CHECK((ahead * turned).norm() < 1e-13 * ahead.norm() * turned.norm());
        CHECK((K * turned).norm() > 1e-3 * K.norm() * turned.norm());
        CHECK((phase->tangents().matrix_ahead(0, u, u) - K).norm() < 1e-14 * K.norm());
      }
    }
  }
}

TEST_CASE("a free body that is moved and turned as a whole, by any angle, feels no force") {
  for (const std::string law : {"neo-hookean", "hencky", "drucker-prager"}) {
    for (const std::string state : {"plane-strain", "plane-stress"}) {
      if (law == "drucker-prager" && state == "plane-stress") continue;
      for (const auto& [basis, points] : {Placed{"linear", "4"}, {"quadratic", "9"}, {"cubic", "16"}}) {
        for (const double angle : {30.0, 90.0}) {
          CAPTURE(law, state, basis, angle);
          std::vector<std::string> overrides = {"material.rubber.law=" + law, "body.state=" + state,
                                                "grid.basis=" + basis, "body.points_per_cell=" + points};
          if (law == "drucker-prager")
            overrides.insert(overrides.end(), {"material.rubber.phi=35", "phase.max_motion=none"});
          Scene scene = patch_block(overrides);
          deform(scene, rotation(angle));
          for (Expression& u : scene.initial_u) u = Expression(u.text() + " + 0.7", {}, "xy");
          const auto phase = make_phase(scene);
          const auto u = phase->initial_displacement(0);
          // E = 1 and lengths of 1: to rounding of the fitted u
          CHECK(largest_magnitude(statics::internal_force(*phase, u)) < 1e-12);
          CHECK(largest_magnitude(statics::point_stress(*phase, u)) < 1e-12);
        }
      }
    }
  }
  // Small strain takes a rotation for a strain: e = (cos 30° − 1) I.
  Scene small = patch_block({"material.rubber.law=linear-elastic"});
  deform(small, rotation(30));
  const auto phase = make_phase(small);
  CHECK(largest_magnitude(statics::internal_force(*phase, phase->initial_displacement(0))) > 0.01);
}

TEST_CASE("the nodal forces of stressed soil turn with the body, in one increment or in three") {
  // P = det f σ f⁻ᵀ with σ = Q σ₀ Qᵀ and f = Q: R(Q x − x) = Q R(0).
  Scene scene =
      patch_block({"material.rubber.law=drucker-prager", "material.rubber.phi=35", "material.rubber.c=0.1",
                   "phase.max_motion=none", "body_force.value=[0, -0.1]", "initial.geostatic={K0=0.5, surface=1}"});
  const auto R0 = [&] {
    const auto phase = make_phase(scene);
    return statics::internal_force(*phase, std::vector<double>(phase->size(), 0.0));
  }();
  const double scale = largest_magnitude(R0);
  REQUIRE(scale > 1e-3);
  for (const std::vector<double>& angles : {std::vector{90.0}, {30.0, 60.0, 90.0}, {-30.0}}) {
    std::vector<double> R;
    const auto phase = make_phase(scene);
    for (const double angle : angles) {
      deform(scene, rotation(angle));
      const auto u = make_phase(scene)->initial_displacement(0);
      R = statics::internal_force(*phase, u);
      statics::commit(*phase, u);
    }
    const Matrix A = rotation(angles.back());
    Largest off;
    for (std::size_t i = 0; i < R.size(); i += 2) {  // a free body's unknowns are (x, y) of each node
      off.take_magnitude(R[i] - (1 + A.xx) * R0[i] - A.xy * R0[i + 1]);
      off.take_magnitude(R[i + 1] - A.yx * R0[i] - (1 + A.yy) * R0[i + 1]);
    }
    CAPTURE(angles.size(), angles.back());
    CHECK(off.value() < 1e-12 * scale);
    scene.initial_u.clear();
  }
}

TEST_CASE("a pressure follows the face that it acts on, and a dead traction keeps its direction") {
  // On the right face, of length 1: −p N turned by 90° is (0, −p), and along a face that is stretched it grows with it.
  const auto total = [](bool follows, const Matrix& A) {
    Scene scene = patch_block();
    scene.tractions.push_back({.face = Face::right, .value = {}, .pressure = {}});
    if (follows) {
      scene.tractions[0].pressure = Expression(0.3);
    } else {
      scene.tractions[0].value = {Expression(-0.3), Expression(0.0)};
    }
    deform(scene, A);
    const auto phase = make_phase(scene);
    const auto u = phase->initial_displacement(0);
    std::vector<double> F(phase->size());
    phase->external_force(0, u, F);
    std::array<double, 2> sum{};
    for (std::size_t i = 0; i < F.size(); ++i) sum[i % 2] += F[i];
    return sum;
  };
  const auto is = [](const std::array<double, 2>& force, double x, double y) {
    CHECK_THAT(force[0], WithinAbs(x, 1e-13));
    CHECK_THAT(force[1], WithinAbs(y, 1e-13));
  };
  const Matrix none{0, 0, 0, 0}, stretch{0.5, 0, 0, 0.2}, quarter = rotation(90);
  is(total(true, none), -0.3, 0);
  is(total(false, none), -0.3, 0);
  is(total(true, quarter), 0, -0.3);
  is(total(false, quarter), -0.3, 0);
  is(total(true, rotation(-30)), -0.3 * std::cos(std::numbers::pi / 6), 0.3 * 0.5);
  is(total(true, stretch), -0.3 * 1.2, 0);  // per deformed area
  is(total(false, stretch), -0.3, 0);       // per undeformed area
}

TEST_CASE("a pressure round a whole body is in balance at any deformation that is uniform") {
  // Closed surface: Σ F = 0, and no work is done on a rigid rotation.
  Scene scene = patch_block();
  for (const Face face : {Face::left, Face::right, Face::bottom, Face::top})
    scene.tractions.push_back({.face = face, .value = {}, .pressure = Expression(0.3)});
  deform(scene, stretched_square);
  const auto phase = make_phase(scene);
  const auto u = phase->initial_displacement(0);
  std::vector<double> F(phase->size());
  phase->external_force(0, u, F);
  CHECK(largest_magnitude(F) > 0.01);
  std::array<double, 2> sum{};
  double moment = 0;
  const int nodes = 5;  // along a side, numbered row by row
  for (std::size_t i = 0; i < F.size() / 2; ++i) {
    const double x = 0.25 * static_cast<double>(i % nodes) + u[2 * i],
                 y = 0.25 * static_cast<double>(i / nodes) + u[2 * i + 1];
    sum[0] += F[2 * i];
    sum[1] += F[2 * i + 1];
    moment += x * F[2 * i + 1] - y * F[2 * i];
  }
  CHECK_THAT(sum[0], WithinAbs(0, 1e-13));
  CHECK_THAT(sum[1], WithinAbs(0, 1e-13));
  CHECK_THAT(moment, WithinAbs(0, 1e-13));
}
