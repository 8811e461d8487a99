#include "simulation/advice/mechanism.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "output/point_fields.hpp"
#include "scene/dimensions.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/loads/load_schedule.hpp"
#include "solvers/spectrum/driven_mode.hpp"

namespace stillpoint {
namespace {

constexpr double negligible = 1e-6;  // relative to the largest value, and above its rounding
constexpr double alike = 1e-3;       // difference of one motion from another that a nearly singular factor may leave

/// A motion x at the points.
struct PointMotion {
  std::size_t dim;
  std::vector<double> position;      // the positions that laws go by, (P × dim) [m]
  std::vector<double> displacement;  // the displacements, the longest of length 1, (P × dim)
  double largest = 0;                // the length of the longest one before that
  std::size_t furthest = 0;          // the point that has it
};

PointMotion motion_of(const LagrangianPhase& phase, double t, ConstVec u, ConstVec x) {
  PointMotion motion{.dim = static_cast<std::size_t>(phase.dim()),
                     .position = phase.info().nonlinear ? current_positions(phase, t, u) : phase.fields().positions(),
                     .displacement = change_of(phase, PointQuantity::displacement, t, x)};
  const std::vector<double> lengths = lengths_of(motion.displacement, motion.dim);
  motion.furthest = static_cast<std::size_t>(std::ranges::max_element(lengths) - lengths.begin());
  motion.largest = lengths[motion.furthest];
  if (motion.largest > 0) {
    for (double& d : motion.displacement) d /= motion.largest;
  }
  return motion;
}

std::span<const Turn> turns_of(const PointMotion& motion) { return dimension_info(static_cast<int>(motion.dim)).turns; }

double extent_of(const PointMotion& motion) {
  double extent = 0;
  for (std::size_t i = 0; i < motion.position.size(); ++i)
    extent = std::max(extent, std::abs(motion.position[i] - motion.position[i % motion.dim]));
  return extent;
}

// a + ω × x at all points; on a line and in the plane the components out of them are 0.
struct RigidMotion {
  Eigen::Vector3d a = Eigen::Vector3d::Zero(), omega = Eigen::Vector3d::Zero();
};

// The rigid motion by least squares; empty if the points move otherwise.
std::optional<RigidMotion> fit_rigid_motion(const PointMotion& motion) {
  const std::size_t dim = motion.dim, points = motion.position.size() / dim;
  const auto rows = static_cast<Eigen::Index>(dim * points), translations = static_cast<Eigen::Index>(dim);
  const std::span<const Turn> turns = turns_of(motion);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, translations + static_cast<Eigen::Index>(turns.size()));
  for (std::size_t p = 0; p < points; ++p) {
    const auto row = static_cast<Eigen::Index>(dim * p);
    for (Eigen::Index i = 0; i < translations; ++i) A(row + i, i) = 1;
    Eigen::Index column = translations;
    for (const auto& [about, i, j] : turns) {  // e_about × x
      A(row + static_cast<Eigen::Index>(j), column) = motion.position[dim * p + i];
      A(row + static_cast<Eigen::Index>(i), column) = -motion.position[dim * p + j];
      ++column;
    }
  }
  const Eigen::Map<const Eigen::VectorXd> u(motion.displacement.data(), rows);
  const Eigen::VectorXd fit = A.colPivHouseholderQr().solve(u);
  if (!((A * fit - u).cwiseAbs().maxCoeff() <= alike)) return std::nullopt;
  RigidMotion rigid;
  rigid.a.head(translations) = fit.head(translations);
  for (std::size_t k = 0; k < turns.size(); ++k)
    rigid.omega[static_cast<Eigen::Index>(turns[k].about)] = fit[translations + static_cast<Eigen::Index>(k)];
  return rigid;
}

// "turns about (0, 0)", "turns about the axis through (0, 0, 0) along (0, 1, 0)" or "moves along (0, 1)"; empty if the
// body does not stay as it is.
std::string rigid_motion(const PointMotion& motion) {
  const std::optional<RigidMotion> rigid = fit_rigid_motion(motion);
  if (!rigid) return "";
  const std::span<const Turn> turns = turns_of(motion);
  if (turns.empty()) return "moves along x";
  const auto told = [&](const Eigen::Vector3d& x) {
    return fmt::format("({:.3g})", fmt::join(x.data(), x.data() + motion.dim, ", "));
  };
  const auto& [a, omega] = *rigid;
  const double extent = extent_of(motion);
  // A turn about an axis far away is a translation.
  if (!(a.cwiseAbs().maxCoeff() < omega.norm() * extent / alike)) return "moves along " + told(a);
  const auto clean = [](Eigen::Vector3d x, double size) {
    for (double& value : x) value = std::abs(value) < alike * size ? 0 : value;
    return x;
  };
  const Eigen::Vector3d through = clean(omega.cross(a) / omega.squaredNorm(), extent);  // the nearest to the origin
  if (turns.size() == 1) return "turns about " + told(through);                         // the axis is known
  std::string text =
      fmt::format("turns about the axis through {} along {}", told(through), told(clean(omega.normalized(), 1)));
  if (std::abs(a.dot(omega)) > alike * extent * omega.squaredNorm()) text += " and moves along it";
  return text;
}

std::string furthest_point(const LagrangianPhase& phase, const PointMotion& motion) {
  const auto is_far = [](double length) { return length >= 0.5; };
  const auto as_well = std::ranges::count_if(lengths_of(motion.displacement, motion.dim), is_far) - 1;
  const auto first = motion.displacement.begin() + static_cast<std::ptrdiff_t>(motion.dim * motion.furthest);
  std::string said =
      fmt::format("{} moves furthest, along ({:.3g})", to_string(phase.diagnosis().of_point(motion.furthest)),
                  fmt::join(std::vector<double>(first, first + static_cast<std::ptrdiff_t>(motion.dim)), ", "));
  if (as_well > 0) said += fmt::format(", and {} others at least half as far", as_well);
  return said;
}

// True if x changes no displacement gradient: then it strains nothing at any amplitude, whatever the law.
bool strains_nothing(const LagrangianPhase& phase, double t, ConstVec x, const PointMotion& motion) {
  const std::vector<double> gradient = change_of(phase, PointQuantity::strain, t, x);
  double largest = 0;
  for (const double component : gradient) largest = std::max(largest, std::abs(component));
  return largest * extent_of(motion) <= negligible * motion.largest;
}

}  // namespace

std::optional<FoundMechanism> find_mechanism(const LagrangianPhase& phase, double t, ConstVec u) {
  if (phase.size() == 0 || phase.info().updated_lagrangian || phase.contact() || phase.info().may_touch)
    return std::nullopt;
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
  if (!rigid.empty()) return FoundMechanism{true, fmt::format("the body {}: {}", rigid, furthest)};
  return FoundMechanism{false, "no material point is strained: " + furthest};
}

std::string to_string(const FoundMechanism& mechanism) {
  return fmt::format(
      "the body is not held: nothing resists a motion in which {}; its loads drive that motion, and it is never at "
      "rest; expected {}, loads that do not drive it",
      mechanism.description,
      mechanism.is_rigid ? "a support against it"
                         : "more material points per cell (there are too few material points for this basis), a basis "
                           "of lower degree, a support");
}

void refuse_mechanism(const Problem& problem, const LagrangianPhase& phase, ConstVec u) {
  const bool varies = loads_vary(problem);
  if (!problem.stop.wants_equilibrium() || (varies && !(problem.stop.time > 0))) return;
  const auto found = find_mechanism(phase, varies ? problem.stop.time : 0, u);
  if (!found) return;
  throw_scene_error(found->is_rigid ? "support" : "body", to_string(*found) + ", or stop.residual = 0 and stop.time");
}

}  // namespace stillpoint
