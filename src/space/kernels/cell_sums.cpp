#include "space/kernels/cell_sums.hpp"

namespace stillpoint {

template class MeanDilatation<Kinematics::plane, CellSums<Kinematics::plane>>;
template class MeanDilatation<Kinematics::axisymmetric, CellSums<Kinematics::axisymmetric>>;
template class MeanDilatation<Kinematics::space, CellSums<Kinematics::space>>;

}  // namespace stillpoint
