// How bodies of a contact have moved on each other since the phase began, when each piece of the first border got its
// facet of the second.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "scene/contact_bodies.hpp"
#include "space/boundary/body_contact.hpp"
#include "space/boundary/facet_search.hpp"

namespace stillpoint {
namespace {

/// In the plane without a third component.
template <std::size_t Dim>
Eigen::Vector3d in_space(const std::array<double, Dim>& vector) {
  Eigen::Vector3d all = Eigen::Vector3d::Zero();
  for (std::size_t d = 0; d < Dim; ++d) all[static_cast<Eigen::Index>(d)] = vector[d];
  return all;
}

/// By how much a normal has turned beyond the turn Q of another one, the shortest that there is:
///   the angle between Q n and n',   N' = Q N.
double angle_of_turn(const Eigen::Vector3d& n, const Eigen::Vector3d& n_now, const Eigen::Vector3d& N,
                     const Eigen::Vector3d& N_now) {
  const Eigen::Vector3d carried = Eigen::Quaterniond::FromTwoVectors(N, N_now) * n;
  return std::atan2(carried.cross(n_now).norm(), carried.dot(n_now));
}

/// The mean normal of the facets that are opposite to places up to a cell before and behind x, so that facets of some
/// length do not count by chance; 0 where none is.
template <Kinematics K>
typename TouchFinder<K>::Position mean_normal(const FacetSearch<K>& search, const BorderPiece<K>& piece,
                                              const typename TouchFinder<K>::Position& cell_along) {
  constexpr int looks = 8;  // each way
  typename TouchFinder<K>::Position sum = TouchFinder<K>::Position::Zero();
  for (int look = -looks; look <= looks; ++look) {
    auto x = piece.place();
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += cell_along[static_cast<Eigen::Index>(i)] * look / looks;
    if (const auto facet = search.opposite(x, piece.normal())) sum += TouchFinder<K>::position_of(facet->normal);
  }
  return sum / (2 * looks + 1);
}

}  // namespace

// Each border turns with its normal. One piece of a patch tells as much as all of them: three on a generator of a
// cylinder lie on a line, and the lines between pieces say nothing of a turn about it.
template <Kinematics K>
double BodyContact<K>::turned(const Pair& pair, const double* u) {
  double most = 0;
  const std::vector<char> bears = pair.force.bearing_patches({}, u);
  const auto patches = pair.first.patches();
  for (std::size_t k = 0; k < patches.size(); ++k) {
    for (std::size_t s = patches[k].begin; bears[k] && s < patches[k].end; ++s) {
      if (!pair.force.finder().is_there(s)) continue;
      const BorderPiece<K>&piece = pair.first.piece(s), &opposite = pair.second.piece(pair.force.finder().opposite(s));
      most = std::max(most, angle_of_turn(in_space(piece.vector), in_space(piece.deformed_area(u)),
                                          in_space(opposite.vector), in_space(opposite.deformed_area(u))));
    }
  }
  return most;
}

template <Kinematics K>
double BodyContact<K>::slid(const Pair& pair, const double* u) {
  double most = 0;
  pair.force.for_closed({}, u, [&](const auto& touch) {
    const Position moved = TouchFinder<K>::position_of(pair.first.motion(touch.piece, u));
    const Position along = moved - touch.at.normal.dot(moved) * touch.at.normal;
    most = std::max(most, along.norm() / pair.first.patches()[touch.patch].cell);
  });
  return most;
}

// Σ A p (n − n'),   n, n': of the facets opposite when the phase began, and of those opposite now, where the bodies
// are.
template <Kinematics K>
std::array<double, 3> BodyContact<K>::strayed(const Pair& pair, const double* u) {
  Position way = Position::Zero();  // along each other
  pair.force.for_closed({}, u, [&](const auto& touch) {
    const Position moved = TouchFinder<K>::position_of(pair.first.motion(touch.piece, u));
    way += touch.area * touch.p * (moved - touch.at.normal.dot(moved) * touch.at.normal);
  });
  std::array<double, 3> sum{};
  if (!(way.norm() > 0)) return sum;
  const std::vector<BorderPiece<K>> pieces = moved_pieces(pair.second, u);
  const FacetSearch<K> before(pair.second), now(pair.second.patches(), pieces);
  pair.force.for_closed({}, u, [&](const auto& touch) {
    const Position cell_along = pair.first.patches()[touch.patch].cell * way.normalized();
    BorderPiece<K> piece = pair.first.piece(touch.piece);
    Position change = mean_normal<K>(before, piece, cell_along);
    piece.move(u);
    change -= mean_normal<K>(now, piece, cell_along);
    for (int i = 0; i < N; ++i) sum[static_cast<std::size_t>(i)] += touch.area * touch.p * change[i];
  });
  return sum;
}

template <Kinematics K>
void BodyContact<K>::add_reports(const double* u, std::vector<ContactReport>& to) const {
  for (const auto& pair : pairs_) {
    ContactReport report;  // of nothing
    if (are_there(problem_, pair->spec)) {
      report = pair->force.report(0, u);
      report.slid = slid(*pair, u);
      if (!problem_.phase.ends()) report.strayed = strayed(*pair, u);  // else facets are found anew, and soon
      report.turned = turned(*pair, u);
    }
    report.name = pair->spec.name();
    to.push_back(std::move(report));
  }
}

template void BodyContact<Kinematics::line>::add_reports(const double*, std::vector<ContactReport>&) const;
template void BodyContact<Kinematics::plane>::add_reports(const double*, std::vector<ContactReport>&) const;
template void BodyContact<Kinematics::axisymmetric>::add_reports(const double*, std::vector<ContactReport>&) const;
template void BodyContact<Kinematics::space>::add_reports(const double*, std::vector<ContactReport>&) const;

}  // namespace stillpoint
