// Bodies that move away. In a scene with contact a body without supports may come to rest on what it meets. One that
// its loads drive into a direction in which nothing resists, with nothing ahead, never does.
//
// With x_a the translation of a part of the bodies that no support holds along an axis,
//
//   G_ab = x_aᵀ K x_b,   f_a = x_aᵀ (F − R),
//
// nothing resists along the null vectors of G, in which bodies that touch move together; friction resists also where it
// slips. The bodies go the way of the part of f in that null space.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "base/text.hpp"
#include "output/point_fields.hpp"
#include "scene/contact_bodies.hpp"
#include "scene/grid_lines.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

std::string moves_away(const Problem& problem, const std::string& name, ConstVec direction) {
  constexpr double aligned = 0.9999;
  std::string along = fmt::format("({:.3g})", fmt::join(direction, ", "));
  for (std::size_t axis = 0; axis < direction.size(); ++axis)
    if (std::abs(direction[axis]) > aligned) along = (problem.state == StressState::axisymmetric ? "rz" : "xyz")[axis];
  return fmt::format(
      "{} is held by nothing along {} and moves away: no support, no friction and no other body is in its way now; "
      "expected one, or stop.residual = 0 and stop.time for its motion",
      name, along);
}

/// A free rigid body that moves away, in words; empty: there is none.
std::string free_body_that_left(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  if (std::ranges::none_of(problem.rigid, &RigidSpec::free)) return "";
  const std::vector<ContactReport> reports = phase.supports().contacts(t, u);
  for (std::size_t r = 0; r < problem.rigid.size(); ++r) {
    if (!reports[r].is_gone) continue;
    const auto& d = reports[r].displacement;
    const double length = std::hypot(d[0], d[1], d[2]);
    const std::array direction{d[0] / length, d[1] / length, d[2] / length};
    return moves_away(problem, in_quotes(problem.rigid[r].name),
                      ConstVec(direction).first(static_cast<std::size_t>(problem.dim)));
  }
  return "";
}

/// How the bodies would set out along what nothing resists, as accelerations of the unknowns, (n) [m/s²]; empty: they
/// do not.
std::vector<double> free_way(RunState& run) {
  constexpr std::size_t most_parts = 100;
  constexpr double none = 1e-9, rounding = 1e-6;
  const LagrangianPhase& phase = *run.model.phase;
  const std::vector<FreePart> parts = phase.shape().free_parts();
  if (parts.empty() || parts.size() > most_parts) return {};
  const ConstVec u = run.motion->u();
  const std::size_t n = phase.size();
  std::vector<double> Q(n), F(n), x(n), Kx(n), Mx(n);
  run.motion->evaluate(run.t);
  run.motion->system.last_static_balance(Q);
  phase.external_force(run.t, u, F);

  const auto size = static_cast<Eigen::Index>(parts.size());
  Eigen::MatrixXd G(size, size);
  Eigen::VectorXd f(size), scale(size), mass(size);
  for (Eigen::Index a = 0; a < size; ++a) {
    const FreePart& part = parts[static_cast<std::size_t>(a)];
    std::ranges::fill(x, 0.0);
    for (const std::size_t k : part.unknowns) x[k] = 1;
    phase.tangents().apply(Tangent::elastic, run.t, u, x, Kx);
    phase.mass().apply(x, Mx);
    f[a] = scale[a] = mass[a] = 0;
    for (const std::size_t k : part.unknowns) {
      f[a] += Q[k];
      scale[a] += std::abs(F[k]) + std::abs(F[k] - Q[k]);
      mass[a] += Mx[k];
    }
    for (Eigen::Index b = 0; b < size; ++b) {
      G(b, a) = 0;
      for (const std::size_t k : parts[static_cast<std::size_t>(b)].unknowns) G(b, a) += Kx[k];
    }
  }
  // A rough motion, which is no translation of a part along an axis, tells how stiff the bodies are.
  constexpr double golden = std::numbers::phi - 1;
  for (std::size_t k = 0; k < n; ++k) x[k] = std::fmod(golden * static_cast<double>(k), 1.0) < 0.5 ? 1 : -1;
  phase.tangents().apply(Tangent::elastic, run.t, u, x, Kx);
  phase.mass().apply(x, Mx);
  const double stiffness = sum_over(n, [&](std::size_t k) { return x[k] * Kx[k]; }),
               inertia = sum_over(n, [&](std::size_t k) { return x[k] * Mx[k]; });

  const Eigen::VectorXd by_mass = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd G_m = by_mass.asDiagonal() * (G + G.transpose()) / 2 * by_mass.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(G_m);
  Eigen::VectorXd drive = Eigen::VectorXd::Zero(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::VectorXd mode = modes.eigenvectors().col(k);
    if (std::abs(modes.eigenvalues()[k]) <= none * stiffness / inertia)
      drive += mode.dot(by_mass.cwiseProduct(f)) * mode;
  }
  if (!(drive.norm() > rounding * by_mass.cwiseProduct(scale).norm())) return {};
  std::ranges::fill(x, 0.0);
  for (Eigen::Index a = 0; a < size; ++a)
    for (const std::size_t k : parts[static_cast<std::size_t>(a)].unknowns) x[k] = by_mass[a] * drive[a];
  return x;
}

double length(const std::vector<double>& way) { return lengths_of(way, way.size())[0]; }
std::vector<double> unit(std::vector<double> way) {
  const double whole = length(way);
  for (double& along : way) along /= whole;
  return way;
}

struct Box {
  std::array<double, 3> low, high;
};

/// Whether a box that goes on along d comes to another one, or is at it.
bool comes_to(const Box& box, const Box& other, ConstVec d) {
  double from = 0, to = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < d.size(); ++axis) {
    double enters = other.low[axis] - box.high[axis], leaves = other.high[axis] - box.low[axis];
    if (d[axis] == 0) {
      if (enters > 0 || leaves < 0) return false;
      continue;
    }
    if (d[axis] < 0) std::swap(enters, leaves);
    from = std::max(from, enters / d[axis]), to = std::min(to, leaves / d[axis]);
  }
  return from <= to;
}

/// The bodies where they are now, and the ways that they set out on.
struct Setting {
  std::size_t dim;
  std::vector<Box> boxes;                 // with a cell around each
  std::vector<std::vector<double>> ways;  // of the bodies, (dim)
};
Setting setting_out(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u, ConstVec x) {
  const auto dim = static_cast<std::size_t>(phase.dim());
  Setting set{dim, {}, {}};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Box none{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  set.boxes.assign(problem.bodies.size(), none);
  set.ways.resize(problem.bodies.size());
  const std::vector<double> at = current_positions(phase, t, u),
                            moved = change_of(phase, PointQuantity::displacement, t, x);
  const std::vector<int> bodies = phase.fields().point_data().bodies;
  for (std::size_t p = 0; p < bodies.size(); ++p) {
    const auto k = static_cast<std::size_t>(bodies[p]);
    for (std::size_t d = 0; d < dim; ++d) {
      const double cell = smallest_cell(problem.grid, d), x_d = at[dim * p + d];
      set.boxes[k].low[d] = std::min(set.boxes[k].low[d], x_d - cell);
      set.boxes[k].high[d] = std::max(set.boxes[k].high[d], x_d + cell);
    }
    if (!set.ways[k].empty()) continue;
    const auto first = moved.begin() + static_cast<std::ptrdiff_t>(dim * p);
    set.ways[k].assign(first, first + static_cast<std::ptrdiff_t>(dim));
  }
  for (std::vector<double>& way : set.ways) way.resize(dim, 0.0);
  return set;
}

/// Whether two bodies that have a contact come to each other.
bool meet(const Problem& problem, const Setting& set) {
  constexpr double rounding = 1e-6;
  return std::ranges::any_of(problem.contacts, [&](const ContactSpec& contact) {
    if (!are_there(problem, contact)) return false;
    const auto [a, b] = bodies_of(problem, contact);
    const std::vector<double>&of_a = set.ways[a], &of_b = set.ways[b];
    std::vector<double> relative = of_a;
    for (std::size_t d = 0; d < set.dim; ++d) relative[d] -= of_b[d];
    return length(relative) > rounding * (length(of_a) + length(of_b)) &&
           comes_to(set.boxes[a], set.boxes[b], relative);
  });
}

/// A body that moves away, in words; empty: none does, or it is not known yet.
std::string body_that_leaves(RunState& run) {
  const Problem& problem = run.scene;
  const LagrangianPhase& phase = *run.model.phase;
  const ConstVec u = run.motion->u();
  const std::vector<double> x = free_way(run);
  if (x.empty()) return "";
  const Setting set = setting_out(problem, phase, run.t, u, x);
  if (meet(problem, set)) return "";
  constexpr double slow = 1e-3;
  const auto fastest = static_cast<std::size_t>(std::ranges::max_element(set.ways, {}, length) - set.ways.begin());
  for (std::size_t k = 0; k < set.ways.size(); ++k) {
    const std::vector<double>& way = set.ways[k];
    if (length(way) > slow * length(set.ways[fastest]) && phase.supports().is_rigid_body_ahead(k, unit(way), run.t, u))
      return "";
  }
  return moves_away(problem, name_of_body(problem, fastest), unit(set.ways[fastest]));
}

/// A body that has gone far beyond the grid in a single phase, in words; empty: none has. What it slides on may hold it
/// by friction in K, and a solver without time has no velocity that would tell.
std::string body_that_is_lost(RunState& run) {
  constexpr double far = 100;  // extents of the grid
  if (run.model.phase->info().updated_lagrangian) return "";
  double extent = 0, furthest = 0;
  for (std::size_t d = 0; d < run.scene.grid.min.size(); ++d)
    extent = std::max(extent, run.scene.grid.max[d] - run.scene.grid.min[d]);
  for (const double u : run.motion->u()) furthest = std::max(furthest, std::abs(u));
  if (!(furthest > far * extent)) return "";
  return fmt::format(
      "a node has moved by {:.3g} m, {:.2g} times the length of the grid, and nothing brings it to rest: what holds "
      "the body slides or is gone; expected a support or more friction, or stop.residual = 0 and stop.time for its "
      "motion",
      furthest, furthest / extent);
}

class UnheldBodies : public Watcher {
 public:
  Verdict judge(RunState& run) override {
    if (run.evaluations() < next_look_) return {};
    next_look_ = 2 * run.evaluations();
    said_ = look(run);
    return said_.empty() ? Verdict{} : run.failed(said_);
  }
  /// Of a run that ended otherwise, as a static solver's.
  void fill_state(Summary& summary, RunState& run) override {
    if (said_.empty()) add_note(summary, look(run));
  }
  void archive(const StateArchive& state, RunState&) override { state("next_look", next_look_); }

 private:
  static std::string look(RunState& run) {
    const Problem& problem = run.scene;
    const LagrangianPhase& phase = *run.model.phase;
    const bool wants_rest = problem.stop.wants_equilibrium() && !(problem.stop.time > 0) && problem.stages.empty();
    if (!wants_rest || !problem.may_touch() || !run.schedule.settled(run.t)) return "";
    if (std::string said = body_that_is_lost(run); !said.empty()) return said;
    if (std::string said = free_body_that_left(problem, phase, run.t, run.motion->u()); !said.empty()) return said;
    // What walls and driven loads do is not in K, and in phases a body that moves away comes to the end of the grid.
    const bool is_known = !phase.contact() && !problem.load && !phase.info().updated_lagrangian;
    return is_known && phase.size() > 0 ? body_that_leaves(run) : "";
  }

  long next_look_ = 100;  // [evaluations]
  std::string said_;
};

}  // namespace

std::unique_ptr<Watcher> watch_unheld_bodies() { return std::make_unique<UnheldBodies>(); }

}  // namespace stillpoint
