// Whether what yielded did so because the motion went too far.
//
// On a slow path the out-of-balance force Q drives the motion all the way, Q·v ≥ 0. Where Q·v < 0 inertia carries the
// body on against forces that hold it back already: what yields then would not have yielded under a load that grows
// slowly. So the share
//
//   ∫_{Q·v<0} dκ / ∫ dκ,   κ = Σ_p V_p κ_p the plastic strain of all points,
//
// is 0 of a slow ramp and of an elastic body, and grows with the settlement that is too much: on three bodies that
// yield, by twelve strategies, it ranks them as the difference from a slow ramp does, which neither the energy that
// damping takes, nor the largest kinetic energy or strain energy beside the last one do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/model.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

class Overshoot {
 public:
  /// The model outlives it.
  Overshoot(const Scene& scene, const Model& model);

  /// Whether it wants a sample, 32 times in a period of the body; never if nothing can yield, nothing moves, or no
  /// equilibrium is asked for.
  bool due(double t) const { return watches_ && t >= next_; }
  /// power: Q·v at t [W].
  void sample(double t, double power);
  /// Empty: nothing has yielded.
  std::optional<double> share() const;
  /// What to say of it; empty: nothing.
  std::string note() const;

  void archive(const StateArchive& state) {
    state("next", next_);
    state("power", power_);
    state("first", first_);
    state("last", last_);
    state("against", against_);
    state("begun", begun_);
  }

 private:
  double plastic_strain();

  const Model& model_;
  bool watches_ = false;
  double interval_ = 0, next_ = 0;  // [s]
  double power_ = 0;                // at the last sample
  double first_ = 0, last_ = 0;     // κ at the first and at the last sample [m³]
  double against_ = 0;              // part of last_ − first_
  bool begun_ = false;
  std::vector<double> volumes_;    // at the start, (P) [m³]
  std::vector<double> of_points_;  // κ_p, (P)
};

}  // namespace stillpoint
