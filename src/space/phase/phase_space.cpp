#include <stdexcept>

#include "space/kernels/gather_scatter_trilinear.hpp"
#include "space/phase/phase_of_basis.hpp"

namespace stillpoint {

// Of degree two and three a phase would keep 27 and 64 gradients of functions for each point: these want factors.
template <>
std::unique_ptr<LagrangianPhase> make_phase_of<Kinematics::space>(const Scene& scene) {
  if (scene.grid.basis != BasisKind::linear) throw std::logic_error("a basis without an instantiation in space");
  return std::make_unique<MaterialPointPhase<BSpline<1>, Kinematics::space>>(scene);
}

}  // namespace stillpoint
