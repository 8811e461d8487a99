#include "space/grid/sliver_extension.hpp"

#include <Eigen/LU>

namespace stillpoint {

template <int n>
SmallMatrix<n> solved(const SmallMatrix<n>& A, const SmallMatrix<n>& B) {
  return A.partialPivLu().solve(B);
}

template SmallMatrix<2> solved<2>(const SmallMatrix<2>&, const SmallMatrix<2>&);
template SmallMatrix<3> solved<3>(const SmallMatrix<3>&, const SmallMatrix<3>&);
template SmallMatrix<4> solved<4>(const SmallMatrix<4>&, const SmallMatrix<4>&);

}  // namespace stillpoint
