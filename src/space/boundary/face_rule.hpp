// Quadrature rules for the pieces of a face in each cell.
#pragma once

#include <stillpoint/problem.hpp>

#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "space/points/cell_positions.hpp"
#include "space/points/moment_fit.hpp"

namespace stillpoint {

/// A point ξ in [−1, 1] and its weight; the weights of a rule have the sum 2.
struct FacePoint {
  double xi, weight;
};

/// Three Gauss points, exact to degree 5. If material points carry the pieces, one piece for each point along the face,
/// of the point's width.
inline std::vector<FacePoint> face_rule(const BodySpec& body, std::size_t along, bool carried, bool domains) {
  if (!carried) return {{-std::sqrt(0.6), 5.0 / 9}, {0.0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}};
  const Placement placement = body.placement == Placement::gauss ? Placement::gauss : Placement::uniform;
  const std::vector<double> xi = line_positions(placement, body.points_per_cell[along]);
  const Eigen::MatrixXd row = Eigen::Map<const Eigen::RowVectorXd>(xi.data(), static_cast<Eigen::Index>(xi.size()));
  const bool fitted = body.volumes == VolumeRule::consistent && !domains;
  const MomentFit fit = fitted ? fit_moments(row) : equal_weights(row);
  std::vector<FacePoint> rule;
  for (std::size_t k = 0; k < xi.size(); ++k) rule.push_back({xi[k], 2 * fit.weights(static_cast<Eigen::Index>(k))});
  return rule;
}

/// The rule of so many Gauss points in each of so many equal parts.
inline std::vector<FacePoint> gauss_in_parts(int points, int parts) {
  const std::vector<double> xi = line_positions(Placement::gauss, points);
  const Eigen::MatrixXd row = Eigen::Map<const Eigen::RowVectorXd>(xi.data(), static_cast<Eigen::Index>(xi.size()));
  const MomentFit gauss = fit_moments(row);
  std::vector<FacePoint> rule;
  for (const double middle : line_positions(Placement::uniform, parts)) {
    for (std::size_t k = 0; k < xi.size(); ++k)
      rule.push_back({middle + xi[k] / parts, 2 * gauss.weights(static_cast<Eigen::Index>(k)) / parts});
  }
  return rule;
}

/// The rule for a load that varies along the face, so that the products of cubic loads with the functions are exact.
/// Five Gauss points, exact to degree 9, as cubic functions have degree 6 along an oblique line; or three in each of
/// the n equal parts that material points carry.
inline std::vector<FacePoint> varying_face_rule(const BodySpec& body, std::size_t along, bool carried) {
  return carried ? gauss_in_parts(3, body.points_per_cell[along]) : gauss_in_parts(5, 1);
}

}  // namespace stillpoint
