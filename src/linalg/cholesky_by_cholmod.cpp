// A = L Lᵀ by CHOLMOD [Chen, Davis, Hager, Rajamanickam, ACM TOMS 35(3), 2008, algorithm 887].
// It calls the C API itself, because cholmod_solve2 keeps its workspaces between calls, while Eigen's wrapper allocates
// on each solve.
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include <Eigen/SparseCore>
#include <suitesparse/cholmod.h>

#include "linalg/cholesky_factor.hpp"
#include "linalg/one_blas_thread.hpp"

namespace stillpoint {
namespace {

// CHOLMOD's views of memory that the caller owns. It only reads them, but its structs have no const.
cholmod_sparse lower_triangle_of(const SparseMatrix& A) {
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(A.rows());
  view.ncol = static_cast<std::size_t>(A.cols());
  view.nzmax = static_cast<std::size_t>(A.nonZeros());
  view.p = const_cast<int*>(A.outerIndexPtr());
  view.i = const_cast<int*>(A.innerIndexPtr());
  view.x = const_cast<double*>(A.valuePtr());
  view.stype = -1;  // symmetric, the lower triangle is read
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

cholmod_dense column(ConstVec b) {
  cholmod_dense view{};
  view.nrow = view.nzmax = view.d = b.size();
  view.ncol = 1;
  view.x = const_cast<double*>(b.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

// Owns all CHOLMOD objects of one factorisation.
class CholmodFactor final : public CholeskyFactor {
 public:
  CholmodFactor() {
    cholmod_start(&common);
    common.print = 0;  // a matrix that is not positive definite is an answer, not a message
    common.quick_return_if_not_posdef = 1;
    common.supernodal = CHOLMOD_AUTO;  // simplicial if there is little work per entry of L: bands, small systems
    common.final_asis = 0;
    common.final_ll = 1;  // L Lᵀ, not L D Lᵀ, which would accept a negative D
    common.final_super = 1;
    common.final_pack = common.final_monotonic = 1;
  }
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;
  ~CholmodFactor() override {
    cholmod_free_dense(&X, &common);
    cholmod_free_dense(&Y, &common);
    cholmod_free_dense(&E, &common);
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }

  bool factorise(const SparseMatrix& A) override {
    const OneBlasThread same_bits;
    n = static_cast<std::size_t>(A.rows());
    cholmod_sparse view = lower_triangle_of(A);
    L = cholmod_analyze(&view, &common);
    check("analyze");
    cholmod_factorize(&view, L, &common);
    check("factorize");
    // A NaN passes CHOLMOD's own test d ≤ 0; its condition estimate (min L_ii/max L_ii)² is then 0.
    ratio = cholmod_rcond(L, &common);
    const bool positive_definite = L->minor == n && ratio > 0;
    check("rcond");
    return positive_definite;
  }

  double pivot_ratio() const override { return ratio; }

  void solve(ConstVec b, Vec x) override {
    std::optional<OneBlasThread> same_bits;  // for a supernodal factor only: setting it takes longer than a small solve
    if (L->is_super) same_bits.emplace();
    cholmod_dense B = column(b);
    if (Y && !L->is_super) {  // a simplicial solve asks for Y (4 × n), but leaves the header at (1 × n): allocated anew
                              // if left
      Y->nrow = Y->d = Y->nzmax / n;
      Y->ncol = n;
    }
    cholmod_solve2(CHOLMOD_A, L, &B, nullptr, &X, nullptr, &Y, &E, &common);
    check("solve2");
    std::copy_n(static_cast<const double*>(X->x), n, x.begin());
  }

  std::size_t bytes() const override { return common.memory_inuse; }

 private:
  // All CHOLMOD statuses are checked here: errors are negative, CHOLMOD_NOT_POSDEF and other warnings positive.
  void check(const char* step) const {
    if (common.status >= CHOLMOD_OK) return;
    const char* why = common.status == CHOLMOD_OUT_OF_MEMORY ? "out of memory"
                      : common.status == CHOLMOD_TOO_LARGE   ? "problem too large"
                                                             : "internal error";
    throw std::runtime_error("CHOLMOD's " + std::string(step) + " failed on a system of size " + std::to_string(n) +
                             ": " + why);
  }

  cholmod_common common{};
  cholmod_factor* L = nullptr;
  cholmod_dense *X = nullptr, *Y = nullptr, *E = nullptr;  // result and workspaces of cholmod_solve2
  std::size_t n = 0;
  double ratio = 0;  // pivot ratio of the factor
};

}  // namespace

std::shared_ptr<CholeskyFactor> make_cholesky_factor() { return std::make_shared<CholmodFactor>(); }
std::string_view cholesky_library() { return "CHOLMOD"; }

}  // namespace stillpoint
