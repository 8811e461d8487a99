// A body gives way if points yield, or if the friction of a wall, of a rigid body or between bodies is used up.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

inline constexpr const char* plastic_strain_name = "plastic_strain";  // in the history of a law

class GivingWay {
 public:
  /// The phase, which may be any of the run, outlives this object.
  GivingWay(const Problem& problem, const LagrangianPhase& phase);

  /// True if the body can give way: a law remembers its path, or a friction has an end.
  bool is_possible() const { return remembers_ || has_friction_; }
  /// True if a law has a plastic strain.
  bool yields() const { return yields_; }
  /// V_p at the start, (P) [m³]; empty if no law has a plastic strain.
  const std::vector<double>& volumes() const { return volumes_; }
  /// True if it shows that a body gives way, by a plastic strain or by friction; otherwise a law remembers something
  /// that is not known here.
  bool shows() const { return yields_ || has_friction_ || !remembers_; }
  /// Σ_p V_p γᵖ_p, with the volumes of the start; it only grows [m³]. 0 if laws have no plastic strain.
  double plastic_strain() const;
  /// What the body slides along at (t, u), "wall 'floor'": walls with |T| = friction |N| in the last evaluation, and
  /// rigid and other bodies along which all that touches them slips.
  std::vector<std::string> slides_along(double t, ConstVec u) const;

 private:
  std::vector<std::string> sliding_walls(double t) const;
  std::vector<std::string> sliding_contacts(double t, ConstVec u) const;

  const LagrangianPhase& phase_;
  std::vector<ShearLimit> shear_of_walls_;
  std::vector<std::string> contacts_;          // the rigid bodies and the pairs of bodies that touch, in words
  std::vector<ShearLimit> shear_of_contacts_;  // of each
  bool remembers_, yields_, has_friction_;
  std::vector<double> volumes_;
};

}  // namespace stillpoint
