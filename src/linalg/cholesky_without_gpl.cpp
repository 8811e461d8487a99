// P A Pᵀ = L Lᵀ by Eigen, row by row [Davis, ACM TOMS 31(4), 2005, algorithm 849], in an order of minimum degree.
// It solves in steps of its own, because Eigen's solve() allocates.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include "linalg/cholesky_factor.hpp"

namespace stillpoint {
namespace {

using Entry = std::int64_t;  // L of a large A has more than 2³¹ of them
using Wide = Eigen::SparseMatrix<double, Eigen::ColMajor, Entry>;

class EigenCholesky final : public CholeskyFactor {
 public:
  bool factorise(const SparseMatrix& A) override {
    n_ = A.rows();
    try {
      llt_.compute(Wide(A));
      work_.resize(n_);
    } catch (const std::bad_alloc&) {
      throw std::runtime_error("the Cholesky factor failed on a system of size " + std::to_string(n_) +
                               ": out of memory");
    }
    return llt_.info() == Eigen::Success && pivots_are_finite();
  }

  double pivot_ratio() const override {
    const Wide& L = factor();
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (Eigen::Index k = 0; k < n_; ++k) {
      const double pivot = L.valuePtr()[L.outerIndexPtr()[k]];
      least = std::min(least, pivot);
      most = std::max(most, pivot);
    }
    return least / most * (least / most);
  }

  void solve(ConstVec b, Vec x) override {
    const Eigen::Map<const Eigen::VectorXd> B(b.data(), n_);
    work_ = llt_.permutationP() * B;
    llt_.matrixL().solveInPlace(work_);
    llt_.matrixU().solveInPlace(work_);
    Eigen::Map<Eigen::VectorXd>(x.data(), n_) = llt_.permutationPinv() * work_;
  }

  std::size_t bytes() const override {
    if (n_ == 0) return 0;
    const auto n = static_cast<std::size_t>(n_);
    const auto entries = static_cast<std::size_t>(factor().nonZeros());
    return entries * (sizeof(double) + sizeof(Entry)) + n * (sizeof(double) + 5 * sizeof(Entry));
  }

 private:
  // The factor L itself; matrixL() is a view of it.
  const Wide& factor() const { return llt_.matrixL().nestedExpression(); }

  // A NaN passes Eigen's own test d ≤ 0. The first entry of a column is L_kk.
  bool pivots_are_finite() const {
    const Wide& L = factor();
    for (Eigen::Index k = 0; k < n_; ++k) {
      if (!std::isfinite(L.valuePtr()[L.outerIndexPtr()[k]])) return false;
    }
    return true;
  }

  Eigen::SimplicialLLT<Wide, Eigen::Lower, Eigen::AMDOrdering<Entry>> llt_;
  Eigen::VectorXd work_;  // (n)
  Eigen::Index n_ = 0;
};

}  // namespace

std::shared_ptr<CholeskyFactor> make_cholesky_factor() { return std::make_shared<EigenCholesky>(); }
std::string_view cholesky_library() { return "Eigen"; }

}  // namespace stillpoint
