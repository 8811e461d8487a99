#include "space/boundary/rigid_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/body_depth.hpp"
#include "scene/rigid_body.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

std::vector<char> touched_by(const Problem& problem, const RigidSpec& rigid) {
  std::vector<char> touched;
  for (const BodySpec& body : problem.bodies)
    touched.push_back(rigid.bodies.empty() || std::ranges::count(rigid.bodies, body.name) > 0);
  return touched;
}

std::vector<char> touched_by_any(const Problem& problem) {
  std::vector<char> touched(problem.bodies.size(), 0);
  for (const RigidSpec& rigid : problem.rigid) {
    const std::vector<char> by_this = touched_by(problem, rigid);
    for (std::size_t k = 0; k < touched.size(); ++k) touched[k] = touched[k] || by_this[k];
  }
  return touched;
}

template <int N>
Eigen::Vector<double, N> about(const RigidSpec& spec) {
  Eigen::Vector<double, N> a = Eigen::Vector<double, N>::Zero();
  for (std::size_t d = 0; d < std::min<std::size_t>(N, spec.about.size()); ++d)
    a[static_cast<Eigen::Index>(d)] = spec.about[d];
  return a;
}

}  // namespace

template <Kinematics K>
RigidContact<K>::RigidContact(const Problem& problem, const Grid<dim>& grid, double time_scale)
    : problem_(problem), surface_(problem, touched_by_any(problem), grid) {
  for (const RigidSpec& spec : problem.rigid) {
    RigidBody& rigid =
        bodies_.emplace_back(RigidBody{.spec = &spec,
                                       .shape = rigid_shape<N>(spec, K == Kinematics::axisymmetric),
                                       .motion = RigidMotion<N>(spec.motion, spec.rotation, about<N>(spec), time_scale),
                                       .touches = touched_by(problem, spec),
                                       .lambda = std::vector<double>(surface_.patches().size(), 0.0),
                                       .lambda_t = std::vector<Position>(surface_.patches().size(), Position::Zero()),
                                       .anchor = std::vector<Position>(surface_.size(), Position::Zero()),
                                       .anchored = std::vector<char>(surface_.size(), 0),
                                       .looked_at = std::vector<Position>(surface_.size(), Position::Zero()),
                                       .found = std::vector<double>(surface_.size(), 0.0)});
    remembers_ = remembers_ || rigid.spec->friction > 0;
  }
  closed_.resize(surface_.size());
}

template <Kinematics K>
auto RigidContact<K>::position_of(const Point<dim>& x) -> Position {
  Position position = Position::Zero();
  for (int d = 0; d < dim; ++d) position[d] = x[static_cast<std::size_t>(d)];
  return position;
}

// Calls visit(touch) for each piece with λ − κ g ≥ −κ slack. As |∇φ| = 1, φ need not be evaluated where it was found to
// be larger than the way from there.
template <Kinematics K>
template <class Visit>
void RigidContact<K>::for_touching(const RigidBody& rigid, double t, const double* u, double slack,
                                   const Visit& visit) const {
  const RigidPlacement<N> placement = rigid.motion.at(t);
  const auto patches = surface_.patches();
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const auto& patch = patches[k];
    if (!rigid.touches[patch.body] || !(patch.stiffness > 0)) continue;
    const double reach = rigid.lambda[k] / patch.stiffness + slack * patch.cell;
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      const Position x = position_of(surface_.position(s, u)), X = placement.to_body(x);
      const double away = rigid.found[s] - reach;
      if (away > 0 && (X - rigid.looked_at[s]).squaredNorm() < away * away) continue;
      const Nearest<N> at = placement.nearest(*rigid.shape, x);
      if (!(at.distance <= reach)) continue;
      Touch touch{.patch = k,
                  .piece = s,
                  .area = surface_.area(s),
                  .kappa = patch.stiffness,
                  .X = X,
                  .at = at,
                  .p = std::max(0.0, rigid.lambda[k] - patch.stiffness * at.distance),
                  .tau = Position::Zero(),
                  .tau_trial = Position::Zero(),
                  .slips = false};
      if (rigid.spec->friction > 0) add_friction(rigid, placement, touch);
      visit(touch);
    }
  }
}

template <Kinematics K>
void RigidContact<K>::add_friction(const RigidBody& rigid, const RigidPlacement<N>& placement, Touch& touch) const {
  Position trial = rigid.lambda_t[touch.patch];
  if (rigid.anchored[touch.piece]) trial -= touch.kappa * (touch.X - rigid.anchor[touch.piece]);
  const Position& n = touch.at.normal;
  touch.tau_trial = placement.Q * trial;
  touch.tau_trial -= n.dot(touch.tau_trial) * n;
  touch.tau = touch.tau_trial;
  const double size = touch.tau.norm(), limit = rigid.spec->friction * touch.p;
  if (touch.p == 0) {
    touch.tau.setZero();
    touch.slips = true;
  } else if (size > limit) {
    touch.tau *= limit / size;
    touch.slips = true;
  }
}

template <Kinematics K>
void RigidContact<K>::add_force(double t, const double* u, Vec R, Vec at_supports, Vec forces) const {
  if (empty()) return;
  std::ranges::fill(forces, 0.0);
  const std::size_t patches = surface_.patches().size();
  for (std::size_t r = 0; r < bodies_.size(); ++r) {
    for_touching(bodies_[r], t, u, 0, [&](const Touch& touch) {
      if (touch.p == 0) return;
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
  if (rigid.spec->friction > 0) {
    const Matrix along = Matrix::Identity() - n * n.transpose();
    if (kind != Tangent::consistent || !touch.slips) {
      S += touch.kappa * along;
    } else if (touch.p > 0) {
      const double size = touch.tau_trial.norm();
      const Position d = touch.tau_trial / size;
      S += rigid.spec->friction * touch.kappa * d * n.transpose() +
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
    for_touching(rigid, t, u, touching, [&](const Touch& touch) { visit(touch.piece, stiffness(rigid, kind, touch)); });
}

template <Kinematics K>
void RigidContact<K>::add_product(Tangent kind, double t, const double* u, const double* du, Vec dR) const {
  if (empty()) return;
  for_stiffness(kind, t, u, [&](std::size_t s, const Matrix& S) {
    const Point<dim> dx = surface_.motion(s, du);
    Point<dim> force{};
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) force[static_cast<std::size_t>(i)] += S(i, j) * dx[static_cast<std::size_t>(j)];
    surface_.add(s, force, dR, {});
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
void RigidContact<K>::begin_phase(const Parts& phase, double t, const StiffnessBound& stiffness_bound) {
  if (empty()) return;
  surface_.begin_phase(phase, stiffness_bound);
  start_ = t;
  const double bound = surface_.bound_of_frequency(phase);
  if (!has_begun_) first_bound_ = bound;
  growth_ = first_bound_ > 0 ? std::max(1.0, bound / first_bound_) : 1;
  if (!has_begun_) {
    refuse_overlaps(t);
    for (RigidBody& rigid : bodies_) {
      const RigidPlacement<N> placement = rigid.motion.at(t);
      for (std::size_t s = 0; s < surface_.size(); ++s) {
        rigid.anchor[s] = placement.to_body(position_of(surface_.start(s)));
        rigid.anchored[s] = 1;
      }
    }
  }
  look(t, nullptr);
  has_begun_ = true;
}

template <Kinematics K>
void RigidContact<K>::archive(const StateArchive& state) {
  if (empty()) return;
  surface_.archive(state.part("surface"));
  for (std::size_t r = 0; r < bodies_.size(); ++r) {
    RigidBody& rigid = bodies_[r];
    const StateArchive part = state.part(fmt::format("rigid_{}", r));
    part("lambda", Vec(rigid.lambda));
    if (rigid.spec->friction == 0) continue;
    part.each(
        "lambda_t", rigid.lambda_t, [](Position & of) -> auto& { return of; });
    part.each(
        "anchor", rigid.anchor, [](Position & of) -> auto& { return of; });
    part("anchored", rigid.anchored);
  }
}

// Evaluates φ at all pieces, for what follows; u null: where the phase began.
template <Kinematics K>
void RigidContact<K>::look(double t, const double* u) {
  for (RigidBody& rigid : bodies_) {
    const RigidPlacement<N> placement = rigid.motion.at(t);
    for (const auto& patch : surface_.patches()) {
      if (!rigid.touches[patch.body]) continue;
      for (std::size_t s = patch.begin; s < patch.end; ++s) {
        rigid.looked_at[s] = placement.to_body(position_of(u ? surface_.position(s, u) : surface_.start(s)));
        rigid.found[s] = rigid.shape->nearest(rigid.looked_at[s]).distance;
      }
    }
  }
}

template <Kinematics K>
void RigidContact<K>::refuse_overlaps(double t) const {
  constexpr double most = 0.5;  // [cells]
  for (std::size_t r = 0; r < bodies_.size(); ++r) {
    const RigidBody& rigid = bodies_[r];
    const RigidPlacement<N> placement = rigid.motion.at(t);
    for (const auto& patch : surface_.patches()) {
      if (!rigid.touches[patch.body]) continue;
      for (std::size_t s = patch.begin; s < patch.end; ++s) {
        const Position x = position_of(surface_.start(s));
        const double cells = -rigid.shape->nearest(placement.to_body(x)).distance / patch.cell;
        if (cells <= most) continue;
        throw_scene_error(fmt::format("rigid[{}]", r),
                          fmt::format("overlaps body[{}] by {:.3g} cells at ({:.6g}) when the run begins; expected at "
                                      "most half a cell",
                                      patch.body, cells, fmt::join(surface_.start(s), ", ")));
      }
    }
  }
}

template <Kinematics K>
void RigidContact<K>::add_displacements(double t, std::vector<double>& to) const {
  for (const RigidBody& rigid : bodies_) {
    const RigidPlacement<N> before = rigid.motion.at(start_), now = rigid.motion.at(t);
    for (const auto& patch : surface_.patches()) {
      const Position x = position_of(surface_.start(patch.begin));
      const Position moved = now.to_space(before.to_body(x)) - x;
      to.insert(to.end(), moved.data(), moved.data() + dim);
    }
  }
}

template <Kinematics K>
void RigidContact<K>::commit(double t, const double* u) {
  if (!remembers_) return;
  for (RigidBody& rigid : bodies_) {
    if (rigid.spec->friction == 0) continue;
    const RigidPlacement<N> placement = rigid.motion.at(t);
    std::ranges::fill(closed_, 0);
    for_touching(rigid, t, u, 0, [&](const Touch& touch) {
      if (touch.p == 0) return;
      closed_[touch.piece] = 1;
      if (rigid.anchored[touch.piece] && !touch.slips) return;
      const Position tau = placement.Q.transpose() * touch.tau;
      rigid.anchor[touch.piece] = touch.X + (tau - rigid.lambda_t[touch.patch]) / touch.kappa;
      rigid.anchored[touch.piece] = 1;
    });
    // An open piece sticks where it closes: near the surface that is where it was last.
    for (const auto& patch : surface_.patches()) {
      if (!rigid.touches[patch.body]) continue;
      for (std::size_t s = patch.begin; s < patch.end; ++s) {
        if (closed_[s]) continue;
        rigid.anchor[s] = placement.to_body(position_of(surface_.position(s, u)));
        rigid.anchored[s] = 1;
      }
    }
  }
}

template <Kinematics K>
void RigidContact<K>::update_multipliers(double t, const double* u) {
  struct Sum {
    double area = 0, force = 0;
    Position shear = Position::Zero();
  };
  for (RigidBody& rigid : bodies_) {
    const RigidPlacement<N> placement = rigid.motion.at(t);
    std::vector<Sum> sums(surface_.patches().size());
    std::vector<Touch> touches;
    for_touching(rigid, t, u, 0, [&](const Touch& touch) {
      if (touch.p == 0) return;
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
    if (rigid.spec->friction == 0) continue;
    for (const Touch& touch : touches) {
      if (!touch.slips && rigid.anchored[touch.piece]) continue;
      const Position tau = placement.Q.transpose() * touch.tau;
      rigid.anchor[touch.piece] = touch.X + (tau - rigid.lambda_t[touch.patch]) / touch.kappa;
    }
  }
  look(t, u);
}

template <Kinematics K>
ContactState RigidContact<K>::state(double t, const double* u) const {
  ContactState state;
  double changes = 0, forces = 0;  // squares
  for (const RigidBody& rigid : bodies_) {
    std::vector<double> area(surface_.patches().size(), 0.0), gap = area, force = area;
    for_touching(rigid, t, u, 0, [&](const Touch& touch) {
      if (touch.p == 0) return;
      state.touches = true;
      area[touch.patch] += touch.area;
      gap[touch.patch] += touch.area * touch.at.distance;
      force[touch.patch] += touch.area * touch.p;
    });
    for (std::size_t k = 0; k < area.size(); ++k) {
      if (!(area[k] > 0)) continue;
      const auto& patch = surface_.patches()[k];
      state.misfit = std::max(state.misfit, std::abs(gap[k]) / area[k] / patch.cell);
      changes += std::pow(force[k] - rigid.lambda[k] * area[k], 2);
      forces += std::pow(force[k], 2);
    }
  }
  state.change = forces > 0 ? std::sqrt(changes / forces) : 0;
  return state;
}

template <Kinematics K>
std::vector<RigidReport> RigidContact<K>::report(double t, const double* u) const {
  std::vector<RigidReport> reports;
  for (const RigidBody& rigid : bodies_) {
    RigidReport& report = reports.emplace_back();
    report.name = rigid.spec->name;
    const RigidPlacement<N> placement = rigid.motion.at(t);
    const Position centre = placement.a + placement.u;
    constexpr double rounding = 1e-6;  // of the limit: a piece whose anchor was dragged is at it
    double slipping = 0;
    for_touching(rigid, t, u, 0, [&](const Touch& touch) {
      if (touch.p == 0) return;
      const Position f = touch.area * (touch.p * touch.at.normal + touch.tau);
      const Position arm = position_of(surface_.position(touch.piece, u)) - centre;
      for (int i = 0; i < N; ++i) report.force[static_cast<std::size_t>(i)] += f[i];
      if constexpr (N == 3) {
        for (std::size_t i = 0; i < 3; ++i) {
          const auto j = static_cast<int>((i + 1) % 3), k = static_cast<int>((i + 2) % 3);
          report.moment[i] += arm[j] * f[k] - arm[k] * f[j];
        }
      } else {
        report.moment[2] += arm[0] * f[1] - arm[1] * f[0];
      }
      report.area += touch.area;
      if (touch.tau.norm() >= (1 - rounding) * rigid.spec->friction * touch.p) slipping += touch.area;
      report.penetration = std::max(report.penetration, -touch.at.distance / surface_.patches()[touch.patch].cell);
    });
    report.slipping = report.area > 0 ? slipping / report.area : 0;
  }
  return reports;
}

template class RigidContact<Kinematics::line>;
template class RigidContact<Kinematics::plane>;
template class RigidContact<Kinematics::axisymmetric>;
template class RigidContact<Kinematics::space>;

}  // namespace stillpoint
