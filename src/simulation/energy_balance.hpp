// Whether a quasi-static answer depends on speed: the kinetic energy beside the work that was done on the body.
#pragma once

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// W = ∫ F · du + work of the moving walls, by the trapezoidal rule from row to row and phase to phase. In one
/// dimension nothing is watched.
class EnergyBalance {
 public:
  explicit EnergyBalance(const LagrangianPhase& phase) : phase_(phase), watches_(phase.dim() > 1) {}

  bool watches() const { return watches_; }
  std::vector<std::string> columns() const;  // "inertia.<figure>"
  /// In the order of columns(), for the kinetic energy of now [J].
  std::vector<double> values(double kinetic_energy) const;
  double external_work() const { return work_; }  // [J]

  /// To (t, u) with the external forces F there; u, F: (n).
  void advance(double t, ConstVec F, ConstVec u);
  /// A phase has begun, with u = 0; F: (n).
  void begin_phase(ConstVec F);

 private:
  double wall_power(double t) const;

  const LagrangianPhase& phase_;
  bool watches_;
  double work_ = 0, t_ = 0, power_ = 0;
  std::vector<double> u_, F_;
};

}  // namespace stillpoint
