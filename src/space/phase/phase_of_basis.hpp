// The choice of the basis in make_phase_of() and make_phase_of_domains(), for one kinematics.
#pragma once

#include <stdexcept>

#include "space/grid/domain_basis.hpp"
#include "space/phase/material_point_phase.hpp"
#include "space/phase/phase_factory.hpp"

namespace stillpoint {

/// Makes a phase with a spline basis. Spline: the family of the basis, by its degree.
template <template <int> class Spline, Kinematics K>
std::unique_ptr<LagrangianPhase> make_phase_of_splines(const Problem& problem, const PhaseBegin& begin) {
  switch (problem.grid.basis) {
    case BasisKind::linear:
      return std::make_unique<MaterialPointPhase<Spline<1>, K>>(problem, begin);
    case BasisKind::quadratic:
      return std::make_unique<MaterialPointPhase<Spline<2>, K>>(problem, begin);
    case BasisKind::cubic:
      return std::make_unique<MaterialPointPhase<Spline<3>, K>>(problem, begin);
    case BasisKind::hermite:
      break;
  }
  throw std::logic_error("a basis that is no spline, or without an instantiation");
}

template <Kinematics K>
std::unique_ptr<LagrangianPhase> make_phase_of(const Problem& problem, const PhaseBegin& begin) {
  if (problem.grid.basis == BasisKind::hermite)
    return std::make_unique<MaterialPointPhase<CubicHermite, K>>(problem, begin);
  return make_phase_of_splines<BSpline, K>(problem, begin);
}

template <Kinematics K>
std::unique_ptr<LagrangianPhase> make_phase_of_domains(const Problem& problem, const PhaseBegin& begin) {
  return make_phase_of_splines<DomainBSpline, K>(problem, begin);
}

}  // namespace stillpoint
