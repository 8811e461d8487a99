// make_phase_of_domains() for one kinematics: the choice of the basis where points stand for domains.
#pragma once

#include <stdexcept>

#include "space/grid/domain_basis.hpp"
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
std::unique_ptr<LagrangianPhase> make_phase_of_domains(const Scene& scene) {
  switch (scene.grid.basis) {
    case BasisKind::linear:
      return std::make_unique<MaterialPointPhase<DomainBSpline<1>, K>>(scene);
    case BasisKind::quadratic:
      return std::make_unique<MaterialPointPhase<DomainBSpline<2>, K>>(scene);
    case BasisKind::cubic:
      return std::make_unique<MaterialPointPhase<DomainBSpline<3>, K>>(scene);
    case BasisKind::hermite:
      break;
  }
  throw std::logic_error("a basis without domains");
}

}  // namespace stillpoint
