// The material points of a cell that the surface of a solid cuts.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "geometry/solid.hpp"

namespace stillpoint {

/// Points and their shares of the volume of the part inside: Σ_p share_p q(x_p) = mean of q over that part.
struct SolidCellRule {
  std::vector<SpacePoint> x;
  std::vector<double> share;  // > 0, sum 1
  int degree = 0;             // every polynomial of this total degree is integrated exactly
};

/// The number of points of CellPart::gauss_points(), for this many points at most: as many as there are moments.
std::size_t count_of_gauss_points(std::size_t most_points);

/// The part of a cell that a solid occupies, described by its moments.
class CellPart {
 public:
  /// The part of a solid in a box, for this many points at most. empty() if there is none.
  CellPart(const Solid& solid, const SpaceBox& box, std::size_t most_points);

  bool empty() const { return !(volume_ > 0); }
  double volume() const { return volume_; }  // [m³]
  /// √12 times the standard deviation along an axis: for a box its length [m].
  double extent(std::size_t axis) const { return extent_[axis]; }

  /// A rule of the points that lie inside, with equal shares and the degree that these happen to integrate. inside: if
  /// it is empty there is one point, at the centroid or, where that lies outside, at a position inside.
  SolidCellRule equal_shares(std::vector<SpacePoint> inside) const;
  /// The same points, with shares fitted to the moments of the part,
  ///
  ///   Σ_p share_p q(x_p) = mean of q over the part,   share_p ≥ 0,
  ///
  /// for all q up to the total degree that the points allow, nearest to equal shares; points whose share vanishes are
  /// omitted.
  SolidCellRule fitted_shares(std::vector<SpacePoint> inside) const;
  /// At most `most_points` points: from positions all over the part, those with which shares ≥ 0 have the moments of
  /// the highest degree for which that many points suffice, as many as there are moments [Tchakaloff 1957]. Eight
  /// points have the moments of trilinear functions, of degree 1 and of yz, zx, xy and xyz.
  SolidCellRule gauss_points() const;

 private:
  // Coordinates along the principal axes of the part, scaled by its extents: moments are of order one, however thin it
  // is.
  Eigen::Matrix3Xd seen_from_part(const std::vector<SpacePoint>& x) const;
  /// The Legendre products of all degrees up to this one; one column for each point.
  static Eigen::MatrixXd products(const Eigen::Matrix3Xd& xi, int degree);
  Eigen::MatrixXd products_of_axes(const std::vector<SpacePoint>& x) const;
  std::vector<SpacePoint> or_one(std::vector<SpacePoint> inside) const;
  std::vector<SpacePoint> lattice_inside() const;
  std::optional<Eigen::VectorXd> shares_for(const std::vector<SpacePoint>& from, int degree) const;
  SolidCellRule with_shares(const std::vector<SpacePoint>& x, const Eigen::VectorXd& share, int degree) const;

  const Solid& solid_;
  SpaceBox box_;
  std::size_t most_points_;
  int degree_;  // with no more moments than points
  SpaceRule rule_;
  double volume_ = 0;
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero(), extent_ = centroid_, half_ = centroid_;
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // one in each row
  Eigen::VectorXd moments_;
};

}  // namespace stillpoint
