// The stress of level ground at rest, by the weight above.
#pragma once

#include <stillpoint/problem.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/body_depth.hpp"

namespace stillpoint {

class WeightAbove {
 public:
  /// bodies: those of the problem that bear on each other, before the motion. surface: up to which there is ground, of
  /// the topmost body [m]; empty: bodies end where their shapes do, which have to be known. The body force is constant
  /// and vertical. The problem outlives this object.
  WeightAbove(const Problem& problem, const std::vector<const BodySpec*>& bodies, std::optional<double> surface);

  /// ∫ ρ b_y dy above X, a position in one of the bodies [Pa]. of: the material there, which is all that counts where
  /// the ground has one density up to the surface, or the surface of a body is not known.
  double operator()(std::vector<double> X, const MaterialSpec& of) const;

 private:
  std::optional<std::size_t> body_at(const std::vector<double>& X) const;
  double column(const MaterialSpec& material, std::vector<double> X, double from, double top) const;

  double b_y_;  // [m/s²]
  std::optional<double> surface_;
  double highest_;  // of what is above a position [m]
  double step_;     // over the border of a body [m]
  std::vector<double> lines_;
  std::vector<BodyDepth> depths_;
  std::vector<const MaterialSpec*> materials_;  // of the bodies
  bool by_depth_ = false;                       // the depth below the surface is all that matters
};

/// σ_xx, σ_yy, σ_zz of ground at rest at X, σ_xx = σ_zz = K0 σ_yy. key: where the scene has K0. Throws SceneError
/// unless K0 > 0.
std::array<double, 3> stress_at_rest(const Expression& K0, double sigma_yy, const std::vector<double>& X,
                                     const std::string& key);

}  // namespace stillpoint
