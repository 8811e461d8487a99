// What a phase in space must hold exactly whatever the places of its points: uniform strain and rigid motion, loads and
// supports on any of its faces.
#include <stillpoint/hencky.hpp>
#include <stillpoint/linear_elastic.hpp>
#include <stillpoint/neo_hookean.hpp>

#include <array>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "largest.hpp"
#include "statics.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using Catch::Matchers::WithinAbs;
using stillpoint::test::TemporaryFolder;

namespace {

using Tensor = Eigen::Matrix3d;
const std::vector<std::string> elastic_laws = {"linear-elastic", "neo-hookean", "hencky"};
struct Filling {
  const char *basis, *points, *placed, *dilatation;
};
// With as many points as integrate the gradients of the basis exactly.
const Filling fillings[] = {{"linear", "8", "body.placement=uniform", "points"},
                            {"linear", "8", "body.placement=gauss", "points"},
                            {"linear", "8", "body.jitter=0.3", "points"},
                            {"linear", "8", "body.placement=uniform", "cells"},
                            {"linear", "8", "body.jitter=0.3", "cells"},
                            {"quadratic", "27", "body.placement=uniform", "points"},
                            {"quadratic", "8", "body.placement=gauss", "points"},
                            {"quadratic", "27", "body.placement=gauss", "cells"},
                            {"quadratic", "27", "body.placement=gauss", "splines"},
                            {"cubic", "64", "body.placement=gauss", "points"},
                            {"cubic", "64", "body.placement=gauss", "splines"}};
constexpr std::array faces = {Face::left, Face::right, Face::bottom, Face::top, Face::back, Face::front};

/// A box of 3 × 2 × 4 cells with sides of 0.5, 0.6 and 0.2, in a grid that ends with it; nothing holds or loads it.
Scene free_box(const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  return load_scene(folder.write("box.toml", R"(
dim = 3
[grid]
min = [0, 0, 0]
max = [1.5, 1.2, 0.8]
cells = [3, 2, 4]
[body]
material = "stuff"
points_per_cell = 8
[material.stuff]
law = "neo-hookean"
E = 1
nu = 0.3
rho = 1
)"),
                    overrides);
}

/// u = A x as the scene's initial displacement.
void deform(Scene& scene, const Tensor& A) {
  scene.initial_u.clear();
  for (int i = 0; i < 3; ++i)
    scene.initial_u.emplace_back(fmt::format("{:.17g}*x + {:.17g}*y + {:.17g}*z", A(i, 0), A(i, 1), A(i, 2)),
                                 Constants{}, "xyz");
}

const Tensor stretched_box = (Tensor() << 0.2, 0.15, -0.1, -0.05, -0.1, 0.12, 0.08, -0.07, 0.1).finished();

/// P of a law in space (E = 1, ν = 0.3).
Tensor uniform_stress(const std::string& law, const Tensor& A) {
  constexpr auto in_space = StressState::space;
  Gradient<in_space> H;
  for (int c = 0; c < 9; ++c) H[static_cast<std::size_t>(c)] = A(c / 3, c % 3);
  const LameParameters m = LameParameters::from(1, 0.3);
  const auto P = law == "neo-hookean" ? NeoHookean<in_space>(m).first_piola(H)
                 : law == "hencky"    ? Hencky<in_space>(m).first_piola(H)
                                      : LinearElastic<in_space>(m).first_piola(H);
  Tensor out;
  for (int c = 0; c < 9; ++c) out(c / 3, c % 3) = P[static_cast<std::size_t>(c)];
  return out;
}

/// Loads every face with P N as a dead traction.
void pull_all_faces(Scene& scene, const Tensor& P) {
  for (const Face face : faces) {
    const Eigen::Vector3d t = P.col(axis_of(face)) * (is_upper(face) ? 1 : -1);
    scene.tractions.push_back(
        {.face = face, .value = {Expression(t[0]), Expression(t[1]), Expression(t[2])}, .pressure = {}});
  }
}

}  // namespace

TEST_CASE("a uniform strain in space is in balance with its tractions at every node, boundary included (patch test)") {
  for (const std::string& law : elastic_laws) {
    for (const auto& [basis, points, placed, dilatation] : fillings) {
      CAPTURE(law, basis, points, placed, dilatation);
      Scene scene =
          free_box({"material.stuff.law=" + law, placed, std::string("grid.basis=") + basis,
                    std::string("body.points_per_cell=") + points, std::string("phase.dilatation=") + dilatation});
      deform(scene, stretched_box);
      const Tensor P = uniform_stress(law, stretched_box);
      pull_all_faces(scene, P);
      const auto phase = make_phase(scene);
      const auto u = phase->initial_displacement(0);
      const auto stress = statics::point_stress(*phase, u);
      for (std::size_t k = 0; k < stress.size(); ++k) CHECK_THAT(stress[k], WithinAbs(stress[k % 6], 1e-11));
      CHECK(largest_magnitude(statics::out_of_balance(*phase, u)) < 1e-12 * P.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("a free body in space that is moved and turned as a whole, by any angle, feels no force") {
  for (const std::string law : {"neo-hookean", "hencky", "drucker-prager"}) {
    for (const double angle : {1e-3, 1.0, 3.0}) {
      CAPTURE(law, angle);
      const bool yields = law == "drucker-prager";
      Scene scene = free_box({yields ? "material.stuff={law='drucker-prager', E=1, nu=0.3, rho=1, phi=30, c=0.1}"
                                     : "material.stuff.law=" + law,
                              "phase.max_motion=none"});
      const Tensor R = Eigen::AngleAxisd(angle, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
      deform(scene, R - Tensor::Identity());
      scene.initial_u[2] = Expression(scene.initial_u[2].text() + " + 0.7", Constants{}, "xyz");
      const auto phase = make_phase(scene);
      CHECK(largest_magnitude(statics::internal_force(*phase, phase->initial_displacement(0))) < 1e-12);  // of E = 1
    }
  }
}

TEST_CASE("supports that move the faces of a box by a linear field strain it uniformly") {
  for (const std::string& law : elastic_laws) {
    CAPTURE(law);
    const Tensor A = stretched_box / 4;
    Scene scene = free_box({"material.stuff.law=" + law, "damping.strategy=auto", "stop.residual=1e-11"});
    for (const Face face : faces) {
      for (int i = 0; i < 3; ++i) {
        const std::string u = fmt::format("{:.17g}*x + {:.17g}*y + {:.17g}*z", A(i, 0), A(i, 1), A(i, 2));
        scene.supports.push_back(
            {.face = face, .roller = true, .component = i, .motion = Expression(u, Constants{}, "xyzt")});
      }
    }
    Simulation simulation(scene, {.records = false});
    simulation.run();
    REQUIRE(simulation.status() == RunStatus::equilibrium);
    const ConstVec H = simulation.field("strain");
    for (std::size_t k = 0; k < H.size(); ++k)
      CHECK_THAT(H[k], WithinAbs(A(static_cast<int>(k % 9) / 3, static_cast<int>(k % 9) % 3), 1e-10));
  }
}

TEST_CASE("a part of a face bears its share of a load, whatever cells its edges cut") {
  // Of 1.5 × 0.8 from 0.2 to 0.95 along x and from 0.1 to 0.5 along z: 0.75 · 0.4 of pressure 2, its moments those of
  // its centroid.
  Scene scene = free_box();
  scene.tractions.push_back({.face = Face::top,
                             .from = {0.2, 0.1},
                             .to = {0.95, 0.5},
                             .value = {Expression(0.0), Expression(-2.0), Expression(0.0)},
                             .pressure = {}});
  const auto phase = make_phase(scene);
  std::vector<double> F(phase->size());
  phase->external_force(0, std::vector<double>(F.size()), F);
  const NodalLayout nodes = phase->shape().layout();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < F.size(); ++k) {
    sum[nodes.component[k]] += F[k];
    if (nodes.component[k] != 1) continue;
    const double* x = nodes.positions.data() + 3 * nodes.node[k];
    moment[0] += x[0] * F[k];
    moment[2] += x[2] * F[k];
  }
  CHECK_THAT(sum[1], WithinAbs(-0.6, 1e-13));
  CHECK(std::max(std::abs(sum[0]), std::abs(sum[2])) < 1e-13);
  CHECK_THAT(moment[0] / sum[1], WithinAbs(0.575, 1e-13));
  CHECK_THAT(moment[2] / sum[1], WithinAbs(0.3, 1e-13));
}

TEST_CASE("K in space is the derivative of R, for every law and with a pressure that follows the faces") {
  for (const std::string law : {"linear-elastic", "neo-hookean", "hencky"}) {
    for (const std::string dilatation : {"points", "cells"}) {
      CAPTURE(law, dilatation);
      Scene scene = free_box({"material.stuff.law=" + law, "phase.dilatation=" + dilatation});
      deform(scene, stretched_box);
      scene.tractions.push_back({.face = Face::front, .value = {}, .pressure = Expression(0.1)});
      const auto phase = make_phase(scene);
      std::vector<double> u = phase->initial_displacement(0), du(u.size());
      for (std::size_t k = 0; k < u.size(); ++k) {
        u[k] += 0.01 * std::sin(static_cast<double>(k * k));
        du[k] = std::cos(static_cast<double>(3 * k));
      }
      const auto Q = [&](double share) {
        std::vector<double> moved = u;
        for (std::size_t k = 0; k < u.size(); ++k) moved[k] += share * du[k];
        return statics::out_of_balance(*phase, moved);
      };
      constexpr double step = 1e-5;
      const std::vector<double> forwards = Q(step), back = Q(-step);
      const SparseMatrix K = phase->tangents().matrix(Tangent::consistent, 0, u) - phase->tangents().of_loads(0, u);
      const auto n = static_cast<Eigen::Index>(u.size());
      const Eigen::VectorXd K_du = K * Eigen::Map<const Eigen::VectorXd>(du.data(), n);
      const Eigen::VectorXd difference =
          (Eigen::Map<const Eigen::VectorXd>(back.data(), n) - Eigen::Map<const Eigen::VectorXd>(forwards.data(), n)) /
          (2 * step);
      CHECK((K_du - difference).norm() < 1e-8 * difference.norm());  // of central differences
    }
  }
}
