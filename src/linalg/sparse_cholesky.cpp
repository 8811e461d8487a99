// A = L Lᵀ by CHOLMOD [Chen, Davis, Hager, Rajamanickam, ACM TOMS 35(3), 2008, algorithm 887].
// The C API itself: cholmod_solve2 keeps its workspaces from call to call, Eigen's wrapper allocates on each solve.
// solve() writes into those workspaces, so one object serves one thread at a time.
#include "linalg/sparse_cholesky.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>
#include <suitesparse/cholmod.h>

#include "base/stop_request.hpp"
#include "base/work_apart.hpp"
#include "linalg/one_blas_thread.hpp"

namespace stillpoint {
namespace {

// CHOLMOD's views of memory that stays ours. It reads them only, but its structs have no const.
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

// Owns every CHOLMOD object of one factorisation; its address never changes.
struct Factor {
  Factor() {
    cholmod_start(&common);
    common.print = 0;  // a matrix that is not positive definite is an answer, not a message
    common.quick_return_if_not_posdef = 1;
    common.supernodal = CHOLMOD_AUTO;  // simplicial if there is little work per entry of L: bands, small systems
    common.final_asis = 0;
    common.final_ll = 1;  // L Lᵀ, not L D Lᵀ, which would go through with a negative D
    common.final_super = 1;
    common.final_pack = common.final_monotonic = 1;
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;
  ~Factor() {
    cholmod_free_dense(&X, &common);
    cholmod_free_dense(&Y, &common);
    cholmod_free_dense(&E, &common);
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }

  void factorise(const SparseMatrix& A) {
    const OneBlasThread same_bits;
    n = static_cast<std::size_t>(A.rows());
    cholmod_sparse view = lower_triangle_of(A);
    L = cholmod_analyze(&view, &common);
    check("analyze");
    cholmod_factorize(&view, L, &common);
    check("factorize");
    // A NaN passes CHOLMOD's own test d ≤ 0; its condition estimate (min L_ii/max L_ii)² is 0 then.
    positive_definite = L->minor == n && cholmod_rcond(L, &common) > 0;
    check("rcond");
  }

  void solve(ConstVec b, Vec x) {
    std::optional<OneBlasThread> same_bits;  // of a supernodal factor: to set it takes longer than a small solve
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

  // The one check of CHOLMOD's status: errors are negative, CHOLMOD_NOT_POSDEF and other warnings positive.
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
  bool positive_definite = false;
};

void factorise(const std::shared_ptr<Factor>& factor, const SparseMatrix& A) {
  constexpr Eigen::Index takes_long = 5000;  // unknowns, some hundredths of a second
  if (A.rows() < takes_long || !may_be_stopped()) return factor->factorise(A);
  work_apart([factor, own = std::make_shared<const SparseMatrix>(A)] { factor->factorise(*own); });
}

}  // namespace

struct SparseCholesky::Impl {
  std::shared_ptr<Factor> factor = std::make_shared<Factor>();  // its factorisation may be left to itself
};

SparseCholesky::SparseCholesky(const SparseMatrix& A) : impl_(std::make_unique<Impl>()) {
  if (A.rows() != A.cols()) throw std::invalid_argument("Cholesky factor of a matrix that is not square");
  if (A.rows() == 0) {
    impl_->factor->positive_definite = true;
    return;
  }
  if (A.isCompressed()) {
    factorise(impl_->factor, A);
  } else {
    SparseMatrix compressed = A;
    compressed.makeCompressed();
    factorise(impl_->factor, compressed);
  }
  if (positive_definite()) {  // a first solve makes the workspaces
    std::vector<double> zero(size(), 0.0);
    solve(zero, zero);
  }
}

SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;
SparseCholesky::~SparseCholesky() = default;

bool SparseCholesky::positive_definite() const { return impl_->factor->positive_definite; }

void SparseCholesky::solve(ConstVec b, Vec x) const {
  if (!positive_definite()) throw std::logic_error("solve() with a matrix that is not positive definite");
  if (b.size() != size() || x.size() != size())
    throw std::invalid_argument("solve(): b or x is not of the factor's size");
  if (size() > 0) impl_->factor->solve(b, x);
}

std::size_t SparseCholesky::size() const { return impl_->factor->n; }
std::size_t SparseCholesky::bytes() const { return impl_->factor->common.memory_inuse; }

}  // namespace stillpoint
