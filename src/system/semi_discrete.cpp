#include <stillpoint/semi_discrete.hpp>

#include <Eigen/SparseCore>
#include <fmt/format.h>

namespace stillpoint {

SparseMatrix Tangents::matrix_ahead(double t, ConstVec u, ConstVec /*from*/) const {
  return matrix(Tangent::consistent, t, u);
}

SparseMatrix Tangents::of_loads(double /*t*/, ConstVec u) const {
  const auto n = static_cast<Eigen::Index>(u.size());
  return SparseMatrix(n, n);
}

std::string Diagnosis::refusal(TrialState& /*trial*/) const {
  return "a deformation that is no motion of the body, or a stress that is not finite";
}

PlaceInBody Diagnosis::of_unknown(std::size_t k) const { return {.what = fmt::format("degree of freedom {}", k + 1)}; }

const Diagnosis& SemiDiscrete::diagnosis() const {
  static const Diagnosis knows_no_positions;
  return knows_no_positions;
}

}  // namespace stillpoint
