// K = ∂R/∂u of whole phases, against central differences of the internal force.
#include <stillpoint/stillpoint.hpp>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "random_values.hpp"
#include "scenes.hpp"
#include "statics.hpp"

using namespace stillpoint;

namespace {

/// (f(u + d du) − f(u − d du))/(2 d)
template <class Force>
std::vector<double> difference(const Force& f, const std::vector<double>& u, const std::vector<double>& du, double d) {
  std::vector<double> above = u, below = u;
  for (std::size_t i = 0; i < u.size(); ++i) above[i] += d * du[i], below[i] -= d * du[i];
  std::vector<double> change = f(above);
  const std::vector<double> subtracted = f(below);
  for (std::size_t i = 0; i < u.size(); ++i) change[i] = (change[i] - subtracted[i]) / (2 * d);
  return change;
}

std::vector<double> product(const SparseMatrix& A, const std::vector<double>& x) {
  const auto n = static_cast<Eigen::Index>(x.size());
  const Eigen::VectorXd y = A * Eigen::Map<const Eigen::VectorXd>(x.data(), n);
  return {y.begin(), y.end()};
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  return largest_difference(a, b) / largest_magnitude(b);
}

double asymmetry(const SparseMatrix& A) { return (A - SparseMatrix(A.transpose())).norm() / A.norm(); }

/// The column with a law and a state, in one cell after the other out of balance.
std::unique_ptr<LagrangianPhase> column(const std::string& material, const std::string& state, const std::string& basis,
                                        const std::string& dilatation = "points") {
  return make_phase(scenes::load(
      "column", {"material.soil=" + material, "body.state=" + state, "grid.basis=" + basis, "grid.cells=[2, 4]",
                 "phase.max_motion=none", "body.points_per_cell=9", "phase.dilatation=" + dilatation}));
}

/// Applied, assembled and as differences of R(u), with the stress and the plastic flow of a motion since a commit.
void check_tangent(const LagrangianPhase& phase, bool plastic, double size = 0.03) {
  const std::size_t n = phase.size();
  const double t = 0.03;
  const auto u = test::random_values(n, size, 2), du = test::random_values(n, 1, 3);
  const auto R = [&](ConstVec at) { return statics::internal_force(phase, at, t); };
  const auto differences = difference(R, u, du, 1e-8);
  const SparseMatrix K = phase.tangents().matrix(Tangent::consistent, t, u);
  std::vector<double> applied(n);
  phase.tangents().apply(Tangent::consistent, t, u, du, applied);
  CHECK(distance(applied, product(K, du)) < 1e-12);
  CHECK(distance(applied, differences) < 2e-6);  // rounding/d, and points that d takes over an edge
  CHECK((asymmetry(K) > 1e-3) == plastic);
  // Frequencies are of a symmetric K_e
  const SparseMatrix K_e = phase.tangents().matrix(Tangent::elastic, t, u);
  CHECK(asymmetry(K_e) < 1e-14);
  CHECK((distance(product(K_e, du), applied) > 0.05) == plastic);
  phase.tangents().apply(Tangent::elastic, t, u, du, applied);
  CHECK(distance(applied, product(K_e, du)) < 1e-12);
}

}  // namespace

TEST_CASE("the tangent of every law is the derivative of the internal force, applied and assembled, after a commit") {
  const std::string soil = "{law='drucker-prager', E=1e7, nu=0.3, rho=2000, phi=30, psi=10, c=1e4";
  const std::string elastic[] = {"linear-elastic", "neo-hookean", "hencky"};
  std::vector<std::string> materials;
  for (const auto& law : elastic) materials.push_back("{law='" + law + "', E=1e7, nu=0.3, rho=2000}");
  materials.push_back(soil + "}");
  materials.push_back(soil + ", tension=2e3, fluidity=1e-5}");
  materials.push_back(soil + ", phi_residual=20, c_residual=1e3, softening_strain=0.02}");
  const std::string pyramid = "{law='mohr-coulomb', E=1e7, nu=0.3, rho=2000, phi=30, psi=10, c=1e4";
  materials.push_back(pyramid + "}");
  materials.push_back(pyramid + ", tension=2e3, softening=[[0.02, 1e3, 20, 0], [0.05, 5e3, 25, 5]]}");
  for (const auto& material : materials) {
    for (const std::string state : {"plane-strain", "axisymmetric"}) {
      for (const std::string basis : {"linear", "quadratic"}) {
        for (const std::string dilatation : {"points", "cells", "splines"}) {
          CAPTURE(material, state, basis, dilatation);
          const auto phase = column(material, state, basis, dilatation);
          statics::commit(*phase, test::random_values(phase->size(), 0.02, 1), 0.01);
          check_tangent(*phase, material.find("phi") != std::string::npos);
        }
      }
    }
  }
}

TEST_CASE("the tangent is the derivative of the internal force where functions in slivers follow others") {
  for (const std::string basis : {"linear", "quadratic", "cubic"}) {
    for (const std::string dilatation : {"points", "cells", "splines"}) {
      CAPTURE(basis, dilatation);
      const auto phase = make_phase(scenes::load(
          "ladder/rotated_square", {"material.steel={law='neo-hookean', E=1, nu=0.3, rho=1}", "grid.cells=[10, 10]",
                                    "grid.basis=" + basis, "phase.dilatation=" + dilatation}));
      REQUIRE(phase->shape().discretisation().quadrature.joined > 0);
      check_tangent(*phase, /*plastic=*/false, /*size=*/1e-4);  // which they follow with up to 200 times that
    }
  }
}

TEST_CASE("yielding leaves omega_max and the critical step where they were") {
  const auto phase = column("{law='drucker-prager', E=1e7, nu=0.3, rho=2000, phi=30, c=1e4}", "plane-strain", "linear");
  const std::vector<double> at_rest(phase->size(), 0.0), u = test::random_values(phase->size(), 1e-3, 1);
  const auto yields =
      (phase->tangents().matrix(Tangent::consistent, 0, u) - phase->tangents().matrix(Tangent::elastic, 0, u)).norm();
  CHECK(yields > 0.1 * phase->tangents().matrix(Tangent::elastic, 0, u).norm());
  const double before = omega_max_by_power_iteration(*phase, 0, at_rest).omega;
  CHECK(omega_max_by_power_iteration(*phase, 0, u).omega == Approx(before).epsilon(0.01));  // the grid's motion, 1e-3
  CHECK(omega_max_by_arpack(*phase, 0, u).omega == Approx(before).epsilon(0.01));
  const double lowest = omega_1_by_lanczos(*phase, 0, at_rest).omega;
  CHECK(omega_1_by_lanczos(*phase, 0, u).omega == Approx(lowest).epsilon(0.01));
  CHECK(omega_1_by_arpack(*phase, 0, u).omega == Approx(lowest).epsilon(0.01));
}

TEST_CASE("the tangent of a pressure that follows the surface is the derivative of its force") {
  for (const std::string state : {"plane-strain", "axisymmetric"}) {
    const auto phase = make_phase(scenes::load("block", {"body.state=" + state,
                                                         "traction=[{face='top', pressure=0.3}, {face='right', "
                                                         "pressure=0.1}]"}));
    const auto u = test::random_values(phase->size(), 0.02, 1), du = test::random_values(phase->size(), 1, 2);
    const auto F = [&](ConstVec at) {
      std::vector<double> force(phase->size(), 0.0);
      phase->external_force(0, at, force);
      return force;
    };
    const auto K = phase->tangents().of_loads(0, u);
    CAPTURE(state);
    CHECK(distance(product(K, du), difference(F, u, du, 1e-5)) <
          1e-9);  // of second degree in u: exact but for rounding
  }
}
