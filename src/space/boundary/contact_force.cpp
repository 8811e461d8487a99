#include "space/boundary/contact_force.hpp"

#include <limits>
#include <map>
#include <span>

#include <fmt/format.h>

#include "space/boundary/facet_finder.hpp"
#include "space/boundary/force_across.hpp"
#include "space/boundary/small_stiffness.hpp"

namespace stillpoint {

ContactState ContactFit::state() const {
  const auto norm = [](const std::vector<double>& values) {
    double squares = 0;
    for (const double value : values) squares += value * value;
    return std::sqrt(squares);
  };
  const double force = norm(forces);
  return {touches, balanced, misfit, force > 0 ? norm(changes) / force : 0};
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::anchor_at_start(double t, const std::vector<Position>& slip) {
  RigidPlacement<N> placement = finder_.placement(t);
  placement.u += settled_;
  for (std::size_t s = 0; s < anchor_.size(); ++s) {
    anchor_[s] = placement.to_body(TouchFinder<K>::position_of(surface_.start(s)));
    if (!slip.empty()) anchor_[s] -= slip[s];
  }
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::anchor_new_at_start(double t) {
  const std::vector<Position> before = anchor_;
  anchor_at_start(t, {});
  for (const auto& part : surface_.parts()) {
    for (std::size_t s = part.first_piece; s < part.end_piece && was_there(part.body) && remembers(); ++s)
      anchor_[s] = before[s];
  }
}

template <Kinematics K, class Finder>
auto ContactForce<K, Finder>::slips(double t, const double* u) const -> std::vector<Position> {
  const RigidPlacement<N> placement = this->placement(t, u);
  std::vector<Position> slips(anchor_.size());
  for (std::size_t s = 0; s < slips.size(); ++s)
    slips[s] = placement.to_body(TouchFinder<K>::position_of(surface_.position(s, u))) - anchor_[s];
  return slips;
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::archive(const StateArchive& state) {
  resize();
  for (Eigen::Index i = 0; i < N && finder_.is_free(); ++i) state(fmt::format("settled_{}", i), settled_[i]);
  for (const auto& part : surface_.parts()) archive_part(state.part(surface_.name_of(part)), part);
  multipliers_.archive(state);
  if (remembers()) state("friction_work", friction_work_);
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::take_over(const StateArchive& state) {
  for (Eigen::Index i = 0; i < N && finder_.is_free(); ++i) state(fmt::format("settled_{}", i), settled_[i]);
  for (const auto& part : surface_.parts()) {
    if (!state.has_part(surface_.name_of(part))) continue;
    archive_part(state.part(surface_.name_of(part)), part);
    was_there_.resize(part.body + 1);
    was_there_[part.body] = 1;
  }
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::resize() {
  multipliers_.resize();
  if (!remembers()) return;
  anchor_.resize(surface_.size());
  closed_.resize(anchor_.size());
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::archive_part(const StateArchive& state, const typename ContactSurface<K>::Part& part) {
  multipliers_.archive_part(state, part);
  if (!remembers()) return;
  std::span<Position> anchor = std::span(anchor_).subspan(part.first_piece, part.end_piece - part.first_piece);
  state.each(
      "anchor", anchor, [](Position & of) -> auto& { return of; });
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::add_force(double t, const double* u, Vec R, Vec at_supports, Vec of_patches) const {
  const RigidPlacement<N> placement = this->placement(t, u);
  if (!placement.u.allFinite() || !placement.Q.allFinite())  // which would touch nothing
    std::ranges::fill(R, std::numeric_limits<double>::quiet_NaN());
  for_closed(placement, u, [&](const Touch& touch) {
    Point<dim> f{};
    for (std::size_t i = 0; i < dim; ++i) {
      const auto along = static_cast<Eigen::Index>(i);
      const double on_border = touch.area * (touch.p * touch.at.normal[along] + touch.tau[along]);
      if (!of_patches.empty()) of_patches[dim * touch.patch + i] += on_border;
      f[i] = -on_border;
    }
    surface_.add(touch.piece, f, R, at_supports);
  });
}

template <Kinematics K, class Finder>
RigidPlacement<ContactForce<K, Finder>::N> ContactForce<K, Finder>::placement(double t, const double* u) const {
  constexpr double longest = 0.25;  // [cells]
  RigidPlacement<N> placement = finder_.placement(t);
  if (!finder_.is_free()) return placement;
  placement.u += settled_;
  if (surface_.empty() || is_gone(t, u)) return placement;
  const double cell = surface_.patches().front().cell;
  const double rounding = rounding_of(TouchFinder<K>::position_of(surface_.start(0)).norm());
  settle<N>(
      placement, {longest * cell, rounding, touching * cell, surface_.extent()},
      [&] { return balance(t, placement, u); }, [&] { return way_to_touch(placement, u); });
  return placement;
}

// Far beyond the grid, and driven still further away from all of it.
template <Kinematics K, class Finder>
bool ContactForce<K, Finder>::is_gone(double t, const double* u) const {
  constexpr double far = 30;  // extents of the grid
  const double extent = surface_.extent();
  if (!finder_.is_free() || !(settled_.norm() > far * extent)) return false;
  RigidPlacement<N> here = finder_.placement(t);
  here.u += settled_;
  RigidPlacement<N> further = here;
  further.u += extent * settled_.normalized();
  const double way = way_to_touch(here, u);
  return way > 2 * extent && way_to_touch(further, u) > way && finder_.load(t).dot(settled_) > 0;
}

template <Kinematics K, class Finder>
auto ContactForce<K, Finder>::balance(double t, const RigidPlacement<N>& placement, const double* u) const
    -> Balance<N> {
  Balance<N> balance{.load = finder_.load(t)};
  for_touches(placement, u, touching, [&](const Touch& touch) {
    if (touch.p > 0) balance.force += touch.area * (touch.p * touch.at.normal + touch.tau);
    balance.stiffness += stiffness_of(Tangent::consistent, shear_, touch);
  });
  if (K == Kinematics::axisymmetric) balance.force[0] = 0;
  balance.stiffness = along_axes(balance.stiffness);
  return balance;
}

// The least way to what it touches, or 0: φ falls by no more than the way.
template <Kinematics K, class Finder>
double ContactForce<K, Finder>::way_to_touch(const RigidPlacement<N>& placement, const double* u) const {
  double least = std::numeric_limits<double>::infinity();
  const auto patches = surface_.patches();
  const auto everywhere = [](std::size_t) { return std::numeric_limits<double>::infinity(); };
  finder_.for_near(placement, u, everywhere, [&](const typename TouchFinder<K>::Near& near) {
    const double kappa = patches[near.patch].stiffness;
    least = std::min(least, near.at.distance - (kappa > 0 ? multipliers_.pressure(near.piece) / kappa : 0));
  });
  return std::max(0.0, least);
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::add_product(Tangent kind, double t, const double* u, const double* du, Vec dR) const {
  const RigidPlacement<N> placement = this->placement(t, u);
  Position moved = Position::Zero();  // δd
  if (finder_.is_free()) {
    Position force = Position::Zero();
    Matrix all = Matrix::Zero();
    for_stiffness(kind, placement, u, [&](std::size_t s, const Matrix& S) {
      force += S * TouchFinder<K>::position_of(surface_.motion(s, du));
      all += S;
    });
    moved = flexibility<N>(along_axes(all)) * force;
  }
  for_stiffness(kind, placement, u, [&](std::size_t s, const Matrix& S) {
    const Position f = S * (TouchFinder<K>::position_of(surface_.motion(s, du)) - moved);
    Point<dim> on_piece;
    for (int i = 0; i < dim; ++i) on_piece[static_cast<std::size_t>(i)] = f[i];
    surface_.add(s, on_piece, dR, {});
  });
}

// Of a free body −B (Σ A S)⁻¹ C besides, with B = Σ w A S and C = Σ A S w: all that it touches is coupled.
template <Kinematics K, class Finder>
void ContactForce<K, Finder>::add_entries(Tangent kind, double t, const double* u, MatrixEntries& entries) const {
  const RigidPlacement<N> placement = this->placement(t, u);
  std::map<int, std::pair<Position, Position>> coupled;  // rows of B and columns of C
  Matrix all = Matrix::Zero();
  for_stiffness(kind, placement, u, [&](std::size_t s, const Matrix& S) {
    surface_.add_entries(s, S, entries);
    if (!finder_.is_free()) return;
    all += S;
    surface_.for_free(s, [&](int i, int dof, double w) {
      auto& [row, column] = coupled.try_emplace(dof, Position::Zero(), Position::Zero()).first->second;
      row += w * S.row(i).transpose();
      column += w * S.col(i);
    });
  });
  if (coupled.empty()) return;
  const Matrix inverse = flexibility<N>(along_axes(all));
  for (const auto& [row, of_row] : coupled)
    for (const auto& [column, of_column] : coupled)
      entries.emplace_back(row, column, -of_row.first.dot(inverse * of_column.second));
}

// λ_t − κ (X − a) = τ
template <Kinematics K, class Finder>
void ContactForce<K, Finder>::drag(const RigidPlacement<N>& placement, const Touch& touch) {
  const Position tau = placement.Q.transpose() * touch.tau;
  anchor_[touch.piece] = touch.X + (tau - multipliers_.shear(touch.piece)) / touch.kappa;
}

// A piece that is open sticks where it closes, which is near to where it is now, and bears no shear there: a shear
// without a limit would be back at once, and there may be no rest between open and closed.
template <Kinematics K, class Finder>
void ContactForce<K, Finder>::commit(double t, const double* u) {
  const RigidPlacement<N> placement = this->placement(t, u);
  if (finder_.is_free()) settled_ = placement.u - finder_.placement(t).u;
  if (!remembers()) return;
  std::ranges::fill(closed_, 0);
  for_closed(placement, u, [&](const Touch& touch) {
    closed_[touch.piece] = 1;
    if (!touch.slips) return;
    const Position before = anchor_[touch.piece];
    drag(placement, touch);
    friction_work_ += touch.area * touch.tau.norm() * (anchor_[touch.piece] - before).norm();
  });
  for (std::size_t s = 0; s < closed_.size(); ++s) {
    if (closed_[s]) continue;
    anchor_[s] = placement.to_body(TouchFinder<K>::position_of(surface_.position(s, u)));
    multipliers_.release_shear(s);
  }
}

template <Kinematics K, class Finder>
bool ContactForce<K, Finder>::is_touched(double t, const double* u) const {
  bool is_touched = false;
  for_closed(placement(t, u), u, [&](const Touch&) { is_touched = true; });
  return is_touched;
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::update_multipliers(double t, const double* u, bool evenly) {
  const RigidPlacement<N> placement = this->placement(t, u);
  const std::vector<Touch> closed = this->closed(placement, u);
  multipliers_.update(closed, placement.Q, evenly);
  for (const Touch& touch : closed)
    if (touch.slips && remembers()) drag(placement, touch);
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::add_fit(double t, const double* u, ContactFit& fit) const {
  const RigidPlacement<N> placement = this->placement(t, u);
  if (finder_.is_free()) fit.balanced = fit.balanced && balance(t, placement, u).is_near();
  const std::vector<Touch> touches = multipliers_.with_kept(closed(placement, u));
  Eigen::MatrixXd fitted(touches.size(), 2);  // g, p
  Eigen::Index row = 0;
  for (const Touch& touch : touches) fitted.row(row++) << touch.at.distance, touch.p;
  fitted = multipliers_.told(touches, fitted);
  const auto feel = [&](const Touch& touch, double p, std::vector<double>& unknowns) {
    Point<dim> f;
    for (std::size_t i = 0; i < dim; ++i) f[i] = touch.area * p * touch.at.normal[static_cast<Eigen::Index>(i)];
    surface_.add(touch.piece, f, unknowns, {});
  };
  row = 0;
  for (const Touch& touch : touches) {
    fit.touches = true;
    fit.misfit = std::max(fit.misfit, std::abs(fitted(row, 0)) / surface_.patches()[touch.patch].cell);
    feel(touch, touch.p, fit.forces);
    feel(touch, fitted(row, 1) - multipliers_.pressure(touch.piece), fit.changes);
    ++row;
  }
}

template <Kinematics K, class Finder>
std::vector<double> ContactForce<K, Finder>::mean_gaps(double t, const double* u) const {
  const std::vector<Touch> touches = closed(this->placement(t, u), u);
  Eigen::MatrixXd distances(touches.size(), 1);
  Eigen::Index row = 0;
  for (const Touch& touch : touches) distances(row++, 0) = touch.at.distance;
  const auto means = multipliers_.means_of_patches(touches, distances);
  std::vector<double> gaps(means.area.size());
  for (std::size_t k = 0; k < gaps.size(); ++k)
    gaps[k] =
        means.area[k] > 0 ? means.values(static_cast<Eigen::Index>(k), 0) : std::numeric_limits<double>::quiet_NaN();
  return gaps;
}

// Only pieces that are hardly off it: what is further away has not come there within a phase.
template <Kinematics K, class Finder>
auto ContactForce<K, Finder>::ways_to_mean_gap(double t, const double* u) const -> std::vector<Position> {
  constexpr double most = 0.01;  // [cells], about what a phase may add
  const std::vector<double> gaps = mean_gaps(t, u);
  if (std::ranges::all_of(gaps, [](double gap) { return std::isnan(gap); })) return {};
  const auto patches = surface_.patches();
  std::vector<Position> ways(surface_.size(), Position::Zero());
  for_touches(this->placement(t, u), u, most, [&](const Touch& touch) {
    const double way = gaps[touch.patch] - touch.at.distance;
    if (std::abs(way) <= most * patches[touch.patch].cell) ways[touch.piece] = way * touch.at.normal;
  });
  return ways;
}

template <Kinematics K, class Finder>
void ContactForce<K, Finder>::follow(const std::vector<PieceOrigin>& origins, std::vector<Position>& slip) {
  multipliers_.follow(origins);
  if (!remembers()) return;
  slip = of_pieces_cut_anew(slip, origins);
  anchor_.resize(slip.size());
  closed_.assign(slip.size(), 0);
}

template <Kinematics K, class Finder>
ContactReport ContactForce<K, Finder>::report(double t, const double* u) const {
  constexpr double rounding = 1e-6;  // of the limit: a piece whose anchor was dragged is at it
  constexpr double faces = 0.35;     // the cosine between the normals of what touches, from which on it is in front
  ContactReport report;
  const RigidPlacement<N> placement = this->placement(t, u);
  const Position centre = placement.a + placement.u, moved = placement.u - finder_.placement(t).u;
  for (int i = 0; i < N; ++i) report.displacement[static_cast<std::size_t>(i)] = moved[i];
  double slipping = 0;
  Position hooked = Position::Zero();
  std::vector<PushedPiece<K>> pushed;
  for_closed(placement, u, [&](const Touch& touch) {
    const Position border = TouchFinder<K>::position_of(surface_.piece(touch.piece).deformed_area(u)).normalized();
    const double facing = -touch.at.normal.dot(border);
    if (facing < faces) {
      hooked += touch.area * touch.p * (touch.at.normal + facing * border);
    } else if (shear_.acts()) {
      report.shear_left += touch.area * (shear_.at(touch.p) - touch.tau.norm());
    }
    pushed.push_back({touch.patch, touch.piece, touch.area * touch.p * touch.at.normal});
    const Position f = touch.area * (touch.p * touch.at.normal + touch.tau), arm = touch.x - centre;
    for (int i = 0; i < N; ++i) report.force[static_cast<std::size_t>(i)] += f[i];
    add_moment<N>(arm, f, report.moment);
    report.area += touch.area;
    if (touch.tau.norm() >= (1 - rounding) * shear_.at(touch.p)) slipping += touch.area;
    report.stretch = std::max(report.stretch, surface_.stretch(touch.piece));
    const double cells = -touch.at.distance / surface_.patches()[touch.patch].cell;
    report.penetration = std::max(report.penetration, cells);
    double gives = 0;  // what is free along n
    surface_.for_free(touch.piece, [&](int i, int, double w) { gives += std::abs(w * touch.at.normal[i]); });
    if (gives < rounding) report.held = std::max(report.held, cells);
  });
  report.slipping = report.area > 0 ? slipping / report.area : 0;
  if (K == Kinematics::axisymmetric) hooked[0] = 0;  // which cancels around the axis
  report.hooked = hooked.norm();
  report.few = few_amid_border(surface_, pushed);
  if (finder_.is_free()) report.across = force_across<K>(surface_, pushed, u);
  report.is_gone = is_gone(t, u);
  return report;
}

template <Kinematics K, class Finder>
std::vector<char> ContactForce<K, Finder>::bearing_patches(const RigidPlacement<N>& placement, const double* u) const {
  std::vector<char> bearing(surface_.patches().size(), 0);
  for_closed(placement, u, [&](const Touch& touch) { bearing[touch.patch] = 1; });
  return bearing;
}

template class ContactForce<Kinematics::line, TouchFinder<Kinematics::line>>;
template class ContactForce<Kinematics::plane, TouchFinder<Kinematics::plane>>;
template class ContactForce<Kinematics::axisymmetric, TouchFinder<Kinematics::axisymmetric>>;
template class ContactForce<Kinematics::space, TouchFinder<Kinematics::space>>;
template class ContactForce<Kinematics::line, FacetFinder<Kinematics::line>>;
template class ContactForce<Kinematics::plane, FacetFinder<Kinematics::plane>>;
template class ContactForce<Kinematics::axisymmetric, FacetFinder<Kinematics::axisymmetric>>;
template class ContactForce<Kinematics::space, FacetFinder<Kinematics::space>>;

}  // namespace stillpoint
