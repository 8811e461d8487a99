#include "simulation/mechanism.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "output/point_fields.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/load_schedule.hpp"
#include "solvers/spectrum/driven_mode.hpp"

namespace stillpoint {
namespace {

constexpr double negligible = 1e-6;  // of the largest, beside a rounding
constexpr double alike = 1e-3;  // the same motion, but for what a factor of a nearly singular matrix leaves of others

/// A motion x at the points.
struct PointMotion {
  std::size_t dim;
  std::vector<double> position;      // that its law goes by, (P × dim) [m]
  std::vector<double> displacement;  // likewise, the longest of length 1
  double largest = 0;                // of x itself
  std::size_t furthest = 0;          // the point that moves so far

  double length(std::size_t p) const {
    double square = 0;
    for (std::size_t i = 0; i < dim; ++i) square += displacement[dim * p + i] * displacement[dim * p + i];
    return std::sqrt(square);
  }
};

PointMotion motion_of(const LagrangianPhase& phase, double t, ConstVec u, ConstVec x) {
  PointMotion motion{.dim = static_cast<std::size_t>(phase.dim()),
                     .position = phase.info().nonlinear ? current_positions(phase, t, u) : phase.positions(),
                     .displacement = change_of(phase, PointQuantity::displacement, t, x)};
  for (std::size_t p = 1; p < phase.points(); ++p) {
    if (motion.length(p) > motion.length(motion.furthest)) motion.furthest = p;
  }
  motion.largest = motion.length(motion.furthest);
  if (motion.largest > 0) {
    for (double& d : motion.displacement) d /= motion.largest;
  }
  return motion;
}

double extent_of(const PointMotion& motion) {
  double extent = 0;
  for (std::size_t i = 0; i < motion.position.size(); ++i)
    extent = std::max(extent, std::abs(motion.position[i] - motion.position[i % motion.dim]));
  return extent;
}

// "turns about (0, 0)" or "moves along (0, 1)" if it is  a + ω (−y, x)  at all points, by least squares; else empty.
std::string rigid_motion(const PointMotion& motion) {
  const auto points = static_cast<Eigen::Index>(motion.position.size() / motion.dim);
  const auto dim = static_cast<Eigen::Index>(motion.dim);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(dim * points, dim == 1 ? 1 : 3);
  for (Eigen::Index p = 0; p < points; ++p) {
    A(dim * p, 0) = 1;
    if (dim == 1) continue;
    A(2 * p + 1, 1) = 1;
    A(2 * p, 2) = -motion.position[static_cast<std::size_t>(2 * p + 1)];
    A(2 * p + 1, 2) = motion.position[static_cast<std::size_t>(2 * p)];
  }
  const Eigen::Map<const Eigen::VectorXd> u(motion.displacement.data(), dim * points);
  const Eigen::VectorXd fit = A.colPivHouseholderQr().solve(u);
  if ((A * fit - u).cwiseAbs().maxCoeff() > alike) return "";
  if (dim == 1) return "moves along x";
  const double omega = fit[2], extent = extent_of(motion);
  const double x = -fit[1] / omega, y = fit[0] / omega;  // where a + ω (−y, x) = 0
  // A turn about a point far away is a translation.
  if (std::max(std::abs(fit[0]), std::abs(fit[1])) < std::abs(omega) * extent / alike) {
    const auto clean = [&](double value) { return std::abs(value) < alike * extent ? 0 : value; };
    return fmt::format("turns about ({:.3g}, {:.3g})", clean(x), clean(y));
  }
  return fmt::format("moves along ({:.3g}, {:.3g})", fit[0], fit[1]);
}

std::string furthest_point(const LagrangianPhase& phase, const PointMotion& motion) {
  std::size_t as_well = 0;
  for (std::size_t p = 0; p < phase.points(); ++p) as_well += p != motion.furthest && motion.length(p) >= 0.5;
  const auto first = motion.displacement.begin() + static_cast<std::ptrdiff_t>(motion.dim * motion.furthest);
  std::string said =
      fmt::format("{} moves furthest, along ({:.3g})", to_string(phase.diagnosis().of_point(motion.furthest)),
                  fmt::join(std::vector<double>(first, first + static_cast<std::ptrdiff_t>(motion.dim)), ", "));
  if (as_well > 0) said += fmt::format(", and {} others at least half as far", as_well);
  return said;
}

// Whether x changes no displacement gradient: then it strains nothing at any amplitude, whatever the law.
bool strains_nothing(const LagrangianPhase& phase, double t, ConstVec x, const PointMotion& motion) {
  const std::vector<double> gradient = change_of(phase, PointQuantity::strain, t, x);
  double largest = 0;
  for (const double component : gradient) largest = std::max(largest, std::abs(component));
  return largest * extent_of(motion) <= negligible * motion.largest;
}

}  // namespace

std::optional<Mechanism> find_mechanism(const LagrangianPhase& phase, double t, ConstVec u) {
  if (phase.size() == 0 || phase.info().updated_lagrangian || phase.contact()) return std::nullopt;
  if (phase.tangents().of_loads(t, u).nonZeros() > 0) return std::nullopt;
  std::vector<double> Q(phase.size()), R(phase.size());
  phase.external_force(t, u, Q);
  if (!phase.internal_force(t, u, R, *phase.make_trial())) return std::nullopt;
  for (std::size_t k = 0; k < Q.size(); ++k) Q[k] -= R[k];
  const DrivenMode mode = driven_mode(phase.tangents().matrix(Tangent::elastic, t, u), phase.mass(), Q);
  if (!mode.found || mode.share <= negligible) return std::nullopt;
  const PointMotion motion = motion_of(phase, t, u, mode.x);
  if (phase.info().nonlinear && !strains_nothing(phase, t, mode.x, motion)) return std::nullopt;
  const std::string rigid = motion.largest > 0 ? rigid_motion(motion) : "";
  const std::string furthest = furthest_point(phase, motion);
  if (!rigid.empty()) return Mechanism{true, fmt::format("the body {}: {}", rigid, furthest)};
  return Mechanism{false, "no material point is strained: " + furthest};
}

std::string to_string(const Mechanism& mechanism) {
  return fmt::format(
      "the body is not held: nothing resists a motion in which {}; its loads drive that motion, and it is never at "
      "rest; expected {}, loads that do not drive it",
      mechanism.description,
      mechanism.is_rigid ? "a support against it"
                         : "more material points per cell (there are too few material points for this basis), a basis "
                           "of lower degree, a support");
}

void refuse_mechanism(const Scene& scene, const LagrangianPhase& phase, ConstVec u) {
  const bool varies = loads_vary(scene);
  if (!scene.stop.wants_equilibrium() || (varies && !(scene.stop.time > 0))) return;
  const auto found = find_mechanism(phase, varies ? scene.stop.time : 0, u);
  if (!found) return;
  throw_scene_error(scene, found->is_rigid ? "support" : "body",
                    to_string(*found) + ", or stop.residual = 0 and stop.time");
}

}  // namespace stillpoint
