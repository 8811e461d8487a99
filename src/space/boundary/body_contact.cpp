#include "space/boundary/body_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.hpp"
#include "scene/contact_bodies.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/facet_search.hpp"

namespace stillpoint {
namespace {

/// body: which may be none of the present ones.
std::vector<char> only(const Problem& problem, std::size_t body) {
  std::vector<char> touched(problem.bodies.size(), 0);
  if (body < touched.size()) touched[body] = 1;
  return touched;
}

/// The weights of a foot on a facet, w_m: those of the functions there, or if positions are carried by points those of
/// the piece and of its gradient, which are exact for affine motions.
template <Kinematics K>
std::vector<typename CarriedPoint<dimensions(K)>::Entry> weights_at(const OppositeFacet<dimensions(K)>& facet,
                                                                    const BorderPiece<K>& piece, bool phases_end,
                                                                    const PhaseParts<dimensions(K)>& phase) {
  if (!phases_end) {
    BorderPiece<K> foot = BorderPiece<K>::make(facet.foot, 1, facet.normal);
    foot.at.field = piece.at.field;
    if (foot.freeze_in_single_phase(phase)) return foot.at.entries;
  }
  auto entries = piece.at.entries;
  const auto x = piece.place();
  for (auto& entry : entries)
    for (std::size_t d = 0; d < facet.foot.size(); ++d) entry.w += (facet.foot[d] - x[d]) * entry.dN[d];
  return entries;
}

}  // namespace

template <Kinematics K>
BodyContact<K>::Pair::Pair(const Problem& problem, std::size_t k, const Grid<dim>& grid)
    : spec(problem.contacts[k]),
      number(k),
      first(problem, only(problem, bodies_of(problem, spec).first), grid),
      second(problem, only(problem, bodies_of(problem, spec).second), grid),
      force(first, FacetFinder<K>(first), spec.shear) {}

template <Kinematics K>
BodyContact<K>::BodyContact(const Problem& problem, const Grid<dim>& grid) : problem_(problem) {
  for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
    pairs_.push_back(std::make_unique<Pair>(problem, k, grid));
    if (are_there(problem, problem.contacts[k])) whole_.push_back(pairs_.back().get());
  }
}

template <Kinematics K>
void BodyContact<K>::begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound) {
  if (pairs_.empty()) return;
  std::vector<double> bounds = has_begun_ ? std::vector<double>() : stiffness_bound();
  for (const auto& pair : pairs_)
    for (ContactSurface<K>* const surface : {&pair->first, &pair->second})
      surface->begin_phase(phase, [&] { return bounds; });
  for (Pair* const pair : whole_) {
    const bool is_first = !has_begun_ && !pair->was_whole;
    if (is_first) pair->first.put_in_series(pair->second.mean_stiffness());
    oppose(*pair, phase);
    pair->first.take_growth(phase);
    pair->force.anchor_at_start(0, pair->slip);
    if (is_first) refuse_overlap(*pair);
  }
  has_begun_ = true;
}

// Finds the facet opposite to each piece, and moves the surface relative to it.
template <Kinematics K>
void BodyContact<K>::oppose(Pair& pair, const Parts& phase) const {
  const FacetSearch<K> search(pair.second);
  std::vector<typename FacetFinder<K>::Facet> facets(pair.first.size());
  std::vector<std::vector<typename CarriedPoint<dim>::Entry>> feet(pair.first.size());
  for (std::size_t s = 0; s < facets.size(); ++s) {
    const auto facet = search.opposite(pair.first.start(s), pair.first.normal(s));
    if (!facet) continue;
    facets[s] = {true, facet->gap, TouchFinder<K>::position_of(facet->normal), facet->piece};
    feet[s] = weights_at<K>(*facet, pair.second.piece(facet->piece), problem_.phase.ends(), phase);
  }
  pair.first.move_relative_to(phase, feet);
  pair.force.finder().oppose(std::move(facets));
}

template <Kinematics K>
void BodyContact<K>::refuse_overlap(const Pair& pair) const {
  constexpr double most = 0.5;  // [cells]
  Intrusion deepest;
  for (const auto& patch : pair.first.patches()) {
    for (std::size_t s = patch.begin; s < patch.end; ++s)
      if (pair.force.finder().is_there(s))
        deepest.take(-pair.force.finder().gap_at_start(s) / patch.cell, 0, pair.first.start(s));
  }
  if (!(deepest.cells > most)) return;
  throw_scene_error(fmt::format("contact[{}].bodies", pair.number),
                    fmt::format("{} and {} overlap by {:.3g} cells at ({:.6g}) when the second of them appears; "
                                "expected at most half a cell",
                                in_quotes(pair.spec.bodies[0]), in_quotes(pair.spec.bodies[1]), deepest.cells,
                                fmt::join(deepest.at, ", ")));
}

template <Kinematics K>
void BodyContact<K>::end_phase(const double* u, bool in_place) {
  for (Pair* const pair : whole_) pair->slip = pair->force.slips(0, u);
  for (const auto& pair : pairs_) {
    if (in_place) {
      pair->first.end_phase(u, in_place);
      pair->second.end_phase(u, in_place);
    } else {
      end_phase_of(*pair, u);
    }
  }
}

template <Kinematics K>
void BodyContact<K>::end_phase_of(Pair& pair, const double* u) {
  const bool is_whole = pair.force.finder().has_facets();
  const std::vector<Position> ways = is_whole ? pair.force.ways_to_mean_gap(0, u) : std::vector<Position>();
  pair.first.end_phase(u, /*in_place=*/false);
  pair.first.move(ways);
  const std::vector<PieceOrigin> origins = pair.first.cut_anew();
  if (is_whole && !origins.empty()) pair.force.follow(origins, pair.slip);
  pair.second.end_phase(u, /*in_place=*/false);
  pair.second.cut_anew();
}

template <Kinematics K>
void BodyContact<K>::archive(const StateArchive& state) {
  for (const auto& pair : pairs_) {
    pair->first.archive(state.part(name_of(*pair) + "/first"));
    pair->second.archive(state.part(name_of(*pair) + "/second"));
  }
  for (Pair* const pair : whole_) {
    pair->force.archive(state.part(name_of(*pair) + "/force"));
    archive_slip(state.part(name_of(*pair)), *pair);
  }
}

template <Kinematics K>
void BodyContact<K>::leave_placed(const WaysSincePlaced<dim>& ways) {
  for (const auto& pair : pairs_) {
    pair->first.leave_placed(ways);
    pair->second.leave_placed(ways);
    pair->force.begin_on_surface();
  }
}

template <Kinematics K>
void BodyContact<K>::take_over(const StateArchive& state) {
  for (const auto& pair : pairs_) {
    pair->first.take_over(state.part(name_of(*pair) + "/first"));
    pair->second.take_over(state.part(name_of(*pair) + "/second"));
  }
  for (Pair* const pair : whole_) {
    pair->force.begin_on_surface();
    pair->was_whole = state.has_part(name_of(*pair) + "/force");
    if (!pair->was_whole) continue;
    pair->force.take_over(state.part(name_of(*pair) + "/force"));
    archive_slip(state.part(name_of(*pair)), *pair);
  }
}

template <Kinematics K>
std::string BodyContact<K>::name_of(const Pair& pair) {
  return fmt::format("pair_{}", pair.number);
}

template <Kinematics K>
void BodyContact<K>::archive_slip(const StateArchive& state, Pair& pair) {
  std::vector<double> slip;
  for (const Position& of_piece : pair.slip) slip.insert(slip.end(), of_piece.begin(), of_piece.end());
  state.none_or(N * pair.first.size(), "slip", slip);
  pair.slip.assign(slip.size() / N, Position::Zero());
  for (std::size_t k = 0; k < slip.size(); ++k) pair.slip[k / N][static_cast<Eigen::Index>(k % N)] = slip[k];
}

template <Kinematics K>
void BodyContact<K>::add_force(const double* u, Vec R, Vec at_supports) const {
  for (const Pair* const pair : whole_) pair->force.add_force(0, u, R, at_supports, {});
}

template <Kinematics K>
void BodyContact<K>::add_product(Tangent kind, const double* u, const double* du, Vec dR) const {
  for (const Pair* const pair : whole_) {
    if (kind == Tangent::stiffest) {
      pair->first.add_product_held(du, dR);
    } else {
      pair->force.add_product(kind, 0, u, du, dR);
    }
  }
}

template <Kinematics K>
void BodyContact<K>::add_entries(Tangent kind, const double* u, MatrixEntries& entries) const {
  for (const Pair* const pair : whole_) {
    if (kind == Tangent::stiffest) {
      pair->first.add_entries_held(entries);
    } else {
      pair->force.add_entries(kind, 0, u, entries);
    }
  }
}

template <Kinematics K>
double BodyContact<K>::growth() const {
  double most = 1;
  for (const Pair* const pair : whole_) most = std::max(most, pair->first.growth());
  return most;
}

template <Kinematics K>
void BodyContact<K>::commit(const double* u) {
  for (Pair* const pair : whole_) pair->force.commit(0, u);
}

template <Kinematics K>
void BodyContact<K>::update_multipliers(const double* u, bool evenly) {
  for (Pair* const pair : whole_) pair->force.update_multipliers(0, u, evenly);
}

template <Kinematics K>
void BodyContact<K>::add_fit(const double* u, ContactFit& fit) const {
  for (const Pair* const pair : whole_) pair->force.add_fit(0, u, fit);
}

template class BodyContact<Kinematics::line>;
template class BodyContact<Kinematics::plane>;
template class BodyContact<Kinematics::axisymmetric>;
template class BodyContact<Kinematics::space>;

}  // namespace stillpoint
