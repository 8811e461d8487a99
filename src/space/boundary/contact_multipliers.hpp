// The multipliers of contact, of each piece of a surface: λ, the pressure that needs no penetration, and with friction
// λ_t, the shear that needs no elastic slip; and how they are taken from what is borne.
//
// With Π for what can be told (trace_fit.hpp, or means over patches), λ ← Π max(0, λ − κ g) comes to its end from any λ
// if Π is one and the same projection: it is firmly nonexpansive, as the steps of an augmented Lagrangian are
// [Rockafellar 1976]. A Π over the pieces that touch at the time is not, and where pieces open and close from one
// update to the next there is no end. After some twenty updates those that open therefore stay in it, with p = 0.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "space/boundary/contact_law.hpp"
#include "space/boundary/contact_surface.hpp"

namespace stillpoint {

template <Kinematics K>
class ContactMultipliers {
  static constexpr int N = TouchFinder<K>::N;

 public:
  using Touch = ContactTouch<K>;
  using Position = typename TouchFinder<K>::Position;
  /// Of what touches, by area.
  struct PatchMeans {
    std::vector<double> area;  // (patches) [m²]; 0 where nothing touches
    Eigen::MatrixXd values;    // (patches × components); 0 there
  };

  /// The surface must outlive this object. has_shear: whether there is friction.
  ContactMultipliers(const ContactSurface<K>& surface, bool has_shear)
      : surface_(surface),
        has_shear_(has_shear),
        lambda_(surface.size(), 0.0),
        lambda_t_(has_shear ? surface.size() : 0, Position::Zero()) {}

  /// λ [Pa], and the largest of a patch.
  double pressure(std::size_t piece) const { return lambda_[piece]; }
  double largest_pressure(std::size_t patch) const {
    const auto& of = surface_.patches()[patch];
    return *std::max_element(lambda_.begin() + static_cast<std::ptrdiff_t>(of.begin),
                             lambda_.begin() + static_cast<std::ptrdiff_t>(of.end));
  }
  /// λ_t, in the axes of T⁻¹ x [Pa]. Needs has_shear.
  const Position& shear(std::size_t piece) const { return lambda_t_[piece]; }
  void release_shear(std::size_t piece) { lambda_t_[piece].setZero(); }

  /// To as many pieces as the surface has by now; what is new bears nothing.
  void resize();
  /// Takes over the multipliers where the surface was cut anew. origins: of all pieces.
  void follow(const std::vector<PieceOrigin>& origins);
  void archive(const StateArchive& state);
  void archive_part(const StateArchive& state, const typename ContactSurface<K>::Part& part);

  /// Takes what the pieces that touch bear as multipliers; Q: the rotation of T. evenly: by changes that are smoothed
  /// (patch_neighbours.hpp), of which there may be any number, and which are not counted.
  void update(const std::vector<Touch>& closed, const Eigen::Matrix<double, N, N>& Q, bool evenly);
  /// The pieces that bear a pressure, and then those that are kept with them although they are open: of p = 0 at the
  /// gap λ/κ.
  std::vector<Touch> with_kept(std::vector<Touch> closed) const;
  /// What can be told of values of the pieces that touch, (touches × components): what the grid's functions can
  /// (trace_fit.hpp), or the means of patches.
  Eigen::MatrixXd told(const std::vector<Touch>& touches, const Eigen::MatrixXd& values) const;
  PatchMeans means_of_patches(const std::vector<Touch>& touches, const Eigen::MatrixXd& values) const;

 private:
  /// λ, and with friction λ_t, as a row.
  Eigen::RowVectorXd multiplier(std::size_t piece) const;
  void set(std::size_t piece, const Eigen::RowVectorXd& value);
  /// borne: by the pieces that touch, (touches × components of a multiplier).
  void take(const std::vector<Touch>& touches, const Eigen::MatrixXd& borne);
  void change_evenly(const std::vector<Touch>& touches, Eigen::MatrixXd borne);

  const ContactSurface<K>& surface_;
  bool has_shear_;
  // Of the pieces, the second with friction alone:
  std::vector<double> lambda_;
  std::vector<Position> lambda_t_;
  long updates_ = 0;        // since the border was cut, but those made evenly
  std::vector<char> kept_;  // whether a piece has touched at one of them, late ones alone; empty before those
};

}  // namespace stillpoint
