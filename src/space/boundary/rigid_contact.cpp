#include "space/boundary/rigid_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/facet_search.hpp"

namespace stillpoint {
namespace {

std::vector<char> bodies_touched(const Problem& problem) {
  std::vector<char> touched(problem.bodies.size(), 0);
  for (const auto* all : {&problem.rigid, &problem.later_rigid}) {
    for (const RigidSpec& rigid : *all) {
      const std::vector<char> by_this = bodies_touched_by(problem, rigid);
      for (std::size_t k = 0; k < touched.size(); ++k) touched[k] = touched[k] || by_this[k];
    }
  }
  return touched;
}

}  // namespace

template <Kinematics K>
RigidContact<K>::RigidContact(const Problem& problem, const Grid<dim>& grid, const std::vector<int>& first_number,
                              double time_scale)
    : first_number_(first_number), surface_(problem, bodies_touched(problem), grid) {
  for (const RigidSpec& spec : problem.rigid)
    bodies_.emplace_back(surface_, TouchFinder<K>(problem, spec, surface_, time_scale), spec.shear);
}

template <Kinematics K>
void RigidContact<K>::begin_phase(const Parts& phase, double t, const StiffnessBound& stiffness_bound) {
  surface_.begin_phase(phase, stiffness_bound);
  if (empty()) return;
  surface_.take_growth(phase);
  start_ = t;
  least_cell_ = std::numeric_limits<double>::infinity();  // where the body to touch is not there yet
  for (const SurfacePatch& patch : surface_.patches()) least_cell_ = std::min(least_cell_, patch.cell);
  for (RigidBody& rigid : bodies_) rigid.finder().begin_phase();
  if (std::exchange(has_begun_, true)) return;
  refuse_overlaps(t);
  refuse_points_inside(phase, t);
  for (RigidBody& rigid : bodies_) rigid.anchor_new_at_start(t);
}

template <Kinematics K>
void RigidContact<K>::refuse_overlaps(double t) const {
  constexpr double most = 0.5;  // [cells]
  for (std::size_t r = 0; r < bodies_.size(); ++r) {
    const TouchFinder<K>& finder = bodies_[r].finder();
    const RigidPlacement<N> placement = finder.placement(t);
    Intrusion deepest;
    for (const auto& patch : surface_.patches()) {
      if (!finder.touches(patch.body) || bodies_[r].was_there(patch.body)) continue;
      for (std::size_t s = patch.begin; s < patch.end; ++s)
        deepest.take(-finder.distance(surface_.start(s), placement) / patch.cell, patch.body, surface_.start(s));
    }
    if (!(deepest.cells > most)) continue;
    throw_scene_error(
        fmt::format("rigid[{}]", r),
        fmt::format("{} overlaps body[{}] by {:.3g} cells at ({:.6g}) when {}; expected at most half a cell",
                    in_quotes(finder.spec().name), deepest.other, deepest.cells, fmt::join(deepest.at, ", "), begin()));
  }
}

// Contact is felt by the border of a body alone: what is in its middle would bear nothing.
template <Kinematics K>
void RigidContact<K>::refuse_points_inside(const Parts& phase, double t) const {
  constexpr double most = 0.5;  // [cells]
  const std::vector<BorderPiece<K>> border = moved_pieces(surface_, nullptr);
  for (std::size_t r = 0; r < bodies_.size(); ++r) {
    const TouchFinder<K>& finder = bodies_[r].finder();
    const RigidPlacement<N> placement = finder.placement(t);
    const Intrusion surface = deepest_surface(r, placement, border);
    if (surface.cells > 1 && !bodies_[r].was_there(surface.other))
      throw_scene_error(
          fmt::format("rigid[{}]", r),
          fmt::format(
              "{} is inside body[{}]: its surface at ({:.6g}) is {:.3g} cells below the border when {}; expected a "
              "hole in the body",
              in_quotes(finder.spec().name), surface.other, fmt::join(surface.at, ", "), surface.cells, begin()));
    const Intrusion deepest = deepest_point(r, placement, phase, nullptr);
    if (!(deepest.cells > most)) continue;
    throw_scene_error(
        fmt::format("rigid[{}]", r),
        fmt::format("{} is inside body[{}]: a material point at ({:.6g}) is {:.3g} cells inside it when "
                    "{}; expected at most half a cell, or a hole in the body",
                    in_quotes(finder.spec().name), deepest.other, fmt::join(deepest.at, ", "), deepest.cells, begin()));
  }
}

template <Kinematics K>
bool RigidContact<K>::move_on(double share) {
  bool moves = false;
  for (RigidBody& rigid : bodies_) moves = rigid.finder().move_on(start_, share) || moves;
  return moves;
}

template <Kinematics K>
void RigidContact<K>::end_phase(double t, const double* u, bool in_place) {
  if (in_place) return surface_.end_phase(u, in_place);
  std::vector<std::vector<Position>> ways, slips;
  std::vector<std::vector<double>> gaps;
  std::vector<RigidPlacement<N>> placements;
  for (const RigidBody& rigid : bodies_) {
    ways.push_back(rigid.ways_to_mean_gap(t, u));
    slips.push_back(rigid.slips(t, u));
    gaps.push_back(rigid.mean_gaps(t, u));
    placements.push_back(rigid.placement(t, u));
  }
  surface_.end_phase(u, in_place);
  for (const std::vector<Position>& of_body : ways) surface_.move(of_body);
  const std::vector<PieceOrigin> origins = surface_.cut_anew();
  for (std::size_t r = 0; r < bodies_.size() && !origins.empty(); ++r) {
    surface_.move(ways_of_new_pieces(bodies_[r].finder(), placements[r], gaps[r], origins));
    bodies_[r].follow(origins, slips[r]);
    bodies_[r].anchor_at_start(t, slips[r]);
  }
}

// A piece in the middle of the line between two on a curved border would lie deeper in the rigid body than they do, and
// press by the stiffness of a cell times that depth.
template <Kinematics K>
auto RigidContact<K>::ways_of_new_pieces(const TouchFinder<K>& finder, const RigidPlacement<N>& placement,
                                         const std::vector<double>& gaps, const std::vector<PieceOrigin>& origins) const
    -> std::vector<Position> {
  constexpr double most = 0.05;  // [cells]
  std::vector<Position> ways(origins.size(), Position::Zero());
  for (const auto& patch : surface_.patches()) {
    if (!finder.touches(patch.body)) continue;
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      const auto& [pieces, patches] = origins[s];
      const double gap = (gaps[patches[0]] + gaps[patches[1]]) / 2;
      if (pieces[0] == pieces[1] || std::isnan(gap)) continue;
      const Nearest<N> at = finder.nearest(TouchFinder<K>::position_of(surface_.start(s)), placement);
      const double way = gap - at.distance;
      if (std::abs(way) <= most * patch.cell) ways[s] = way * at.normal;
    }
  }
  return ways;
}

template <Kinematics K>
void RigidContact<K>::archive(const StateArchive& state) {
  surface_.archive(state.part("surface"));
  for (RigidBody& rigid : bodies_) rigid.archive(state.part(name_of(rigid)));
}

template <Kinematics K>
void RigidContact<K>::take_over(const StateArchive& state) {
  is_later_stage_ = true;
  surface_.take_over(state.part("surface"));
  for (RigidBody& rigid : bodies_) {
    rigid.begin_on_surface();
    if (state.has_part(name_of(rigid))) rigid.take_over(state.part(name_of(rigid)));
  }
}

template <Kinematics K>
void RigidContact<K>::leave_placed(const WaysSincePlaced<dim>& ways) {
  is_later_stage_ = false;
  surface_.leave_placed(ways);
  for (RigidBody& rigid : bodies_) rigid.begin_on_surface();
}

template <Kinematics K>
std::string RigidContact<K>::name_of(const RigidBody& rigid) {
  return fmt::format("rigid_{}", rigid.finder().spec().number);
}

template <Kinematics K>
void RigidContact<K>::add_force(double t, const double* u, Vec R, Vec at_supports, Vec forces) const {
  std::ranges::fill(forces, 0.0);
  for (std::size_t r = 0; r < bodies_.size(); ++r)
    bodies_[r].add_force(t, u, R, at_supports, forces.subspan(r * of_each(), of_each()));
}

template <Kinematics K>
void RigidContact<K>::add_product(Tangent kind, double t, const double* u, const double* du, Vec dR) const {
  if (empty()) return;
  if (kind == Tangent::stiffest) return surface_.add_product_held(du, dR);
  for (const RigidBody& rigid : bodies_) rigid.add_product(kind, t, u, du, dR);
}

template <Kinematics K>
void RigidContact<K>::add_entries(Tangent kind, double t, const double* u, MatrixEntries& entries) const {
  if (empty()) return;
  if (kind == Tangent::stiffest) return surface_.add_entries_held(entries);
  for (const RigidBody& rigid : bodies_) rigid.add_entries(kind, t, u, entries);
}

template <Kinematics K>
void RigidContact<K>::add_displacements(double t, std::vector<double>& to) const {
  for (const RigidBody& rigid : bodies_) {
    const RigidPlacement<N> before = rigid.finder().placement(start_), now = rigid.finder().placement(t);
    for (const auto& patch : surface_.patches()) {
      const Position x = TouchFinder<K>::position_of(surface_.start(patch.begin));
      const Position moved = now.to_space(before.to_body(x)) - x;
      to.insert(to.end(), moved.data(), moved.data() + dim);
    }
  }
}

template <Kinematics K>
void RigidContact<K>::commit(double t, const double* u) {
  for (RigidBody& rigid : bodies_) rigid.commit(t, u);
}

template <Kinematics K>
void RigidContact<K>::update_multipliers(double t, const double* u, bool evenly) {
  for (RigidBody& rigid : bodies_) rigid.update_multipliers(t, u, evenly);
}

template <Kinematics K>
void RigidContact<K>::add_fit(double t, const double* u, ContactFit& fit) const {
  for (const RigidBody& rigid : bodies_) rigid.add_fit(t, u, fit);
}

template <Kinematics K>
void RigidContact<K>::add_reports(double t, const double* u, std::vector<ContactReport>& to) const {
  for (const RigidBody& rigid : bodies_) {
    to.push_back(rigid.report(t, u));
    to.back().name = rigid.finder().spec().name;
  }
}

template <Kinematics K>
RigidFaces<K> RigidContact<K>::faces(double t, const double* u) const {
  RigidFaces<K> faces(first_number_);
  for (const RigidBody& rigid : bodies_) faces.add(rigid.finder(), rigid.placement(t, u));
  return faces;
}

template class RigidContact<Kinematics::line>;
template class RigidContact<Kinematics::plane>;
template class RigidContact<Kinematics::axisymmetric>;
template class RigidContact<Kinematics::space>;

}  // namespace stillpoint
