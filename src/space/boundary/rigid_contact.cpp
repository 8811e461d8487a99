#include "space/boundary/rigid_contact.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.hpp"
#include "scene/body_depth.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

std::vector<char> bodies_touched(const Problem& problem) {
  std::vector<char> touched(problem.bodies.size(), 0);
  for (const RigidSpec& rigid : problem.rigid) {
    const std::vector<char> by_this = bodies_touched_by(problem, rigid);
    for (std::size_t k = 0; k < touched.size(); ++k) touched[k] = touched[k] || by_this[k];
  }
  return touched;
}

}  // namespace

template <Kinematics K>
RigidContact<K>::RigidContact(const Problem& problem, const Grid<dim>& grid, double time_scale)
    : surface_(problem, bodies_touched(problem), grid) {
  const std::size_t patches = surface_.patches().size();
  for (const RigidSpec& spec : problem.rigid) {
    const std::size_t pieces = spec.friction > 0 ? surface_.size() : 0;
    bodies_.push_back({.finder = TouchFinder<K>(problem, spec, surface_, time_scale),
                       .friction = spec.friction,
                       .lambda = std::vector<double>(patches, 0.0),
                       .lambda_t = std::vector<Position>(patches, Position::Zero()),
                       .anchor = std::vector<Position>(pieces, Position::Zero()),
                       .closed = std::vector<char>(pieces, 0)});
    remembers_ = remembers_ || spec.friction > 0;
  }
}

template <Kinematics K>
void RigidContact<K>::begin_phase(const Parts& phase, double t, const StiffnessBound& stiffness_bound) {
  if (empty()) return;
  surface_.begin_phase(phase, stiffness_bound);
  start_ = t;
  const double bound = surface_.bound_of_frequency(phase);
  if (!has_begun_) first_bound_ = bound;
  growth_ = first_bound_ > 0 ? std::max(1.0, bound / first_bound_) : 1;
  for (RigidBody& rigid : bodies_) rigid.finder.begin_phase();
  if (std::exchange(has_begun_, true)) return;
  refuse_overlaps(t);
  for (RigidBody& rigid : bodies_) {
    const RigidPlacement<N> placement = rigid.finder.placement(t);
    for (std::size_t s = 0; s < rigid.anchor.size(); ++s)
      rigid.anchor[s] = placement.to_body(TouchFinder<K>::position_of(surface_.start(s)));
  }
}

template <Kinematics K>
void RigidContact<K>::refuse_overlaps(double t) const {
  constexpr double most = 0.5;  // [cells]
  for (std::size_t r = 0; r < bodies_.size(); ++r) {
    const TouchFinder<K>& finder = bodies_[r].finder;
    const RigidPlacement<N> placement = finder.placement(t);
    for (const auto& patch : surface_.patches()) {
      if (!finder.touches(patch.body)) continue;
      for (std::size_t s = patch.begin; s < patch.end; ++s) {
        const double cells = -finder.distance_at_start(s, placement) / patch.cell;
        if (!(cells > most)) continue;
        throw_scene_error(
            fmt::format("rigid[{}]", r),
            fmt::format("{} overlaps body[{}] by {:.3g} cells at ({:.6g}) when the run begins; expected at most half "
                        "a cell",
                        in_quotes(finder.spec().name), patch.body, cells, fmt::join(surface_.start(s), ", ")));
      }
    }
  }
}

template <Kinematics K>
void RigidContact<K>::archive(const StateArchive& state) {
  if (empty()) return;
  surface_.archive(state.part("surface"));
  for (std::size_t r = 0; r < bodies_.size(); ++r) {
    RigidBody& rigid = bodies_[r];
    const StateArchive part = state.part(fmt::format("rigid_{}", r));
    part("lambda", Vec(rigid.lambda));
    if (rigid.friction == 0) continue;
    part.each(
        "lambda_t", rigid.lambda_t, [](Position & of) -> auto& { return of; });
    part.each(
        "anchor", rigid.anchor, [](Position & of) -> auto& { return of; });
  }
}

template <Kinematics K>
void RigidContact<K>::add_friction(const RigidBody& rigid, const RigidPlacement<N>& placement, Touch& touch) const {
  const Position& n = touch.at.normal;
  touch.tau_trial = placement.Q * (rigid.lambda_t[touch.patch] - touch.kappa * (touch.X - rigid.anchor[touch.piece]));
  touch.tau_trial -= n.dot(touch.tau_trial) * n;
  const double size = touch.tau_trial.norm(), limit = touch.p > 0 ? rigid.friction * touch.p : 0;
  touch.slips = size > limit || touch.p == 0;
  touch.tau = touch.slips ? Position(limit / std::max(size, limit) * touch.tau_trial) : touch.tau_trial;
  if (limit == 0) touch.tau.setZero();
}

template <Kinematics K>
void RigidContact<K>::add_force(double t, const double* u, Vec R, Vec at_supports, Vec forces) const {
  if (empty()) return;
  std::ranges::fill(forces, 0.0);
  const std::size_t patches = surface_.patches().size();
  for (std::size_t r = 0; r < bodies_.size(); ++r) {
    for_closed(bodies_[r], bodies_[r].finder.placement(t), u, [&](const Touch& touch) {
      Point<dim> f{};
      double* const sum = forces.data() + dim * (r * patches + touch.patch);
      for (int i = 0; i < dim; ++i) {
        const double on_body = touch.area * (touch.p * touch.at.normal[i] + touch.tau[i]);
        sum[i] += on_body;
        f[static_cast<std::size_t>(i)] = -on_body;
      }
      surface_.add(touch.piece, f, R, at_supports);
    });
  }
}

// −∂f/∂x at a piece that touches, or all but does. With the direction d of τ where it slips at μ p,
//
//   ∂τ/∂x = −κ (I − n nᵀ) where it sticks,   −μ κ d nᵀ − κ |τ|/|τ_trial| (I − n nᵀ − d dᵀ) where it slips.
template <Kinematics K>
auto RigidContact<K>::stiffness(const RigidBody& rigid, Tangent kind, const Touch& touch) const -> Matrix {
  const Position& n = touch.at.normal;
  Matrix S = touch.kappa * n * n.transpose();
  if (kind != Tangent::stable) S -= touch.p * touch.at.hessian;
  if (rigid.friction > 0) {
    const Matrix along = Matrix::Identity() - n * n.transpose();
    if (kind != Tangent::consistent || !touch.slips) {
      S += touch.kappa * along;
    } else if (touch.p > 0) {
      const double size = touch.tau_trial.norm();
      const Position d = touch.tau_trial / size;
      S += rigid.friction * touch.kappa * d * n.transpose() +
           touch.kappa * touch.tau.norm() / size * (along - d * d.transpose());
    }
  }
  return touch.area * S;
}

// Calls visit(piece, −∂f/∂x). For the stiffest tangent each piece is held in all directions, whatever touches it.
template <Kinematics K>
template <class Visit>
void RigidContact<K>::for_stiffness(Tangent kind, double t, const double* u, const Visit& visit) const {
  if (kind == Tangent::stiffest) {
    for (const auto& patch : surface_.patches())
      for (std::size_t s = patch.begin; s < patch.end; ++s)
        visit(s, Matrix(surface_.area(s) * patch.stiffness * Matrix::Identity()));
    return;
  }
  for (const RigidBody& rigid : bodies_)
    for_touches(rigid, rigid.finder.placement(t), u, touching,
                [&](const Touch& touch) { visit(touch.piece, stiffness(rigid, kind, touch)); });
}

template <Kinematics K>
void RigidContact<K>::add_product(Tangent kind, double t, const double* u, const double* du, Vec dR) const {
  if (empty()) return;
  for_stiffness(kind, t, u, [&](std::size_t s, const Matrix& S) {
    const Position force = S * TouchFinder<K>::position_of(surface_.motion(s, du));
    Point<dim> f;
    for (int i = 0; i < dim; ++i) f[static_cast<std::size_t>(i)] = force[i];
    surface_.add(s, f, dR, {});
  });
}

template <Kinematics K>
void RigidContact<K>::add_matrix(Tangent kind, double t, const double* u, SparseMatrix& matrix) const {
  if (empty()) return;
  MatrixEntries entries;
  for_stiffness(kind, t, u, [&](std::size_t s, const Matrix& S) {
    surface_.for_free(s, [&](int i, int row, double w_row) {
      surface_.for_free(s, [&](int j, int column, double w_column) {
        if (S(i, j) != 0) entries.emplace_back(row, column, w_row * S(i, j) * w_column);
      });
    });
  });
  SparseMatrix of_contact(matrix.rows(), matrix.cols());
  of_contact.setFromTriplets(entries.begin(), entries.end());
  matrix += of_contact;
}  // NOLINT(clang-analyzer-unix.Malloc): the analyzer loses sight of Eigen's destructor

template <Kinematics K>
void RigidContact<K>::add_displacements(double t, std::vector<double>& to) const {
  for (const RigidBody& rigid : bodies_) {
    const RigidPlacement<N> before = rigid.finder.placement(start_), now = rigid.finder.placement(t);
    for (const auto& patch : surface_.patches()) {
      const Position x = TouchFinder<K>::position_of(surface_.start(patch.begin));
      const Position moved = now.to_space(before.to_body(x)) - x;
      to.insert(to.end(), moved.data(), moved.data() + dim);
    }
  }
}

// λ_t − κ (X − a) = τ
template <Kinematics K>
void RigidContact<K>::drag(RigidBody& rigid, const RigidPlacement<N>& placement, const Touch& touch) const {
  const Position tau = placement.Q.transpose() * touch.tau;
  rigid.anchor[touch.piece] = touch.X + (tau - rigid.lambda_t[touch.patch]) / touch.kappa;
}

// A piece that is open sticks where it closes, which is near to where it is now.
template <Kinematics K>
void RigidContact<K>::commit(double t, const double* u) {
  for (RigidBody& rigid : bodies_) {
    if (rigid.friction == 0) continue;
    const RigidPlacement<N> placement = rigid.finder.placement(t);
    std::ranges::fill(rigid.closed, 0);
    for_closed(rigid, placement, u, [&](const Touch& touch) {
      rigid.closed[touch.piece] = 1;
      if (touch.slips) drag(rigid, placement, touch);
    });
    for (std::size_t s = 0; s < rigid.closed.size(); ++s)
      if (!rigid.closed[s]) rigid.anchor[s] = placement.to_body(TouchFinder<K>::position_of(surface_.position(s, u)));
  }
}

template <Kinematics K>
void RigidContact<K>::update_multipliers(double t, const double* u) {
  struct Sum {
    double area = 0, force = 0;
    Position shear = Position::Zero();
  };
  for (RigidBody& rigid : bodies_) {
    const RigidPlacement<N> placement = rigid.finder.placement(t);
    std::vector<Sum> sums(surface_.patches().size());
    std::vector<Touch> touches;
    for_closed(rigid, placement, u, [&](const Touch& touch) {
      Sum& sum = sums[touch.patch];
      sum.area += touch.area;
      sum.force += touch.area * touch.p;
      sum.shear += touch.area * (placement.Q.transpose() * touch.tau);
      touches.push_back(touch);
    });
    for (std::size_t k = 0; k < sums.size(); ++k) {
      rigid.lambda[k] = sums[k].area > 0 ? sums[k].force / sums[k].area : 0;
      rigid.lambda_t[k] = sums[k].area > 0 ? Position(sums[k].shear / sums[k].area) : Position::Zero();
    }
    if (rigid.friction == 0) continue;
    for (const Touch& touch : touches)
      if (touch.slips) drag(rigid, placement, touch);
  }
}

template class RigidContact<Kinematics::line>;
template class RigidContact<Kinematics::plane>;
template class RigidContact<Kinematics::axisymmetric>;
template class RigidContact<Kinematics::space>;

}  // namespace stillpoint
