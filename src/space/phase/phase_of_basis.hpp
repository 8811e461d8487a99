// make_phase_of() for one kinematics: the choice of the basis.
#pragma once

#include <stdexcept>

#include "space/phase/null_space_stress.hpp"
#include "space/phase/phase_archive.hpp"
#include "space/phase/phase_change.hpp"
#include "space/phase/phase_cut_cells.hpp"
#include "space/phase/phase_diagnosis.hpp"
#include "space/phase/phase_factory.hpp"
#include "space/phase/phase_forces.hpp"
#include "space/phase/phase_inertia.hpp"
#include "space/phase/phase_points.hpp"

namespace stillpoint {

template <Kinematics K>
std::unique_ptr<LagrangianPhase> make_phase_of(const Scene& scene) {
  switch (scene.grid.basis) {
    case BasisKind::linear:
      return std::make_unique<MaterialPointPhase<BSpline<1>, K>>(scene);
    case BasisKind::quadratic:
      return std::make_unique<MaterialPointPhase<BSpline<2>, K>>(scene);
    case BasisKind::cubic:
      return std::make_unique<MaterialPointPhase<BSpline<3>, K>>(scene);
    case BasisKind::hermite:
      return std::make_unique<MaterialPointPhase<CubicHermite, K>>(scene);
  }
  throw std::logic_error("a basis without an instantiation");
}

}  // namespace stillpoint
