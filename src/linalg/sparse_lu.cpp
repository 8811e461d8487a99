// P R A Q = L U by UMFPACK [Davis, ACM TOMS 30(2), 2004, algorithm 832].
// The C API itself: its wsolve takes the work space, Eigen's wrapper allocates on each solve.
// solve() writes into that space, so one object serves one thread at a time.
#include "linalg/sparse_lu.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/SparseCore>
#include <suitesparse/umfpack.h>

#include "base/work_apart.hpp"
#include "linalg/one_blas_thread.hpp"

namespace stillpoint {
namespace {

struct LuFactor {
  explicit LuFactor(const SparseMatrix& matrix)
      : A(matrix), n(static_cast<std::size_t>(A.rows())), integers(n), reals(5 * n), solution(n) {
    A.makeCompressed();
    umfpack_di_defaults(control.data());
  }
  LuFactor(const LuFactor&) = delete;
  LuFactor& operator=(const LuFactor&) = delete;
  ~LuFactor() { umfpack_di_free_numeric(&numeric); }

  void factorise() {
    const OneBlasThread same_bits;
    regular = n == 0;
    if (A.nonZeros() == 0) return;  // an argument that is missing, to UMFPACK
    const int rows = static_cast<int>(n), *begin = A.outerIndexPtr(), *row = A.innerIndexPtr();
    void* symbolic = nullptr;
    const int analysed =
        umfpack_di_symbolic(rows, rows, begin, row, A.valuePtr(), &symbolic, control.data(), info.data());
    if (analysed != UMFPACK_OK) umfpack_di_free_symbolic(&symbolic);
    check(analysed, "symbolic");
    const int factorised =
        umfpack_di_numeric(begin, row, A.valuePtr(), symbolic, &numeric, control.data(), info.data());
    umfpack_di_free_symbolic(&symbolic);
    check(factorised, "numeric");
    regular = factorised == UMFPACK_OK && info[UMFPACK_RCOND] > 0 && std::isfinite(info[UMFPACK_RCOND]);
  }

  void solve(ConstVec b, Vec x) {
    const OneBlasThread same_bits;
    check(umfpack_di_wsolve(UMFPACK_A, A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), solution.data(), b.data(),
                            numeric, control.data(), nullptr, integers.data(), reals.data()),
          "wsolve");
    std::ranges::copy(solution, x.begin());
  }

  // The one check of UMFPACK's status: errors are negative, a singular matrix and other warnings positive.
  void check(int status, const char* step) const {
    if (status >= UMFPACK_OK) return;
    const char* why = status == UMFPACK_ERROR_out_of_memory ? "out of memory" : "internal error";
    throw std::runtime_error("UMFPACK's " + std::string(step) + " failed on a system of size " + std::to_string(n) +
                             ": " + why);
  }

  std::size_t bytes() const {
    const auto nonzeros = static_cast<std::size_t>(A.nonZeros());
    return static_cast<std::size_t>(info[UMFPACK_NUMERIC_SIZE] * info[UMFPACK_SIZE_OF_UNIT]) +
           nonzeros * (sizeof(double) + sizeof(int)) + n * (6 * sizeof(double) + 2 * sizeof(int));
  }

  SparseMatrix A;
  std::size_t n;
  std::array<double, UMFPACK_CONTROL> control{};
  std::array<double, UMFPACK_INFO> info{};
  void* numeric = nullptr;
  bool regular = false;
  std::vector<int> integers;            // Wi of wsolve
  std::vector<double> reals, solution;  // its W; and x, which must not be b
};

void factorise(const std::shared_ptr<LuFactor>& factor) {
  constexpr std::size_t takes_long = 2000;  // unknowns, some hundredths of a second
  if (factor->n < takes_long) return factor->factorise();
  work_apart([factor] { factor->factorise(); });
}

}  // namespace

struct SparseLu::Impl {
  explicit Impl(const SparseMatrix& A) : factor(std::make_shared<LuFactor>(A)) {}
  std::shared_ptr<LuFactor> factor;  // its factorisation may be left to itself
};

SparseLu::SparseLu(const SparseMatrix& A) {
  if (A.rows() != A.cols()) throw std::invalid_argument("LU factor of a matrix that is not square");
  impl_ = std::make_unique<Impl>(A);
  factorise(impl_->factor);
}

SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;
SparseLu::~SparseLu() = default;

bool SparseLu::regular() const { return impl_->factor->regular; }

void SparseLu::solve(ConstVec b, Vec x) const {
  if (!regular()) throw std::logic_error("solve() with a matrix that is singular");
  if (b.size() != size() || x.size() != size())
    throw std::invalid_argument("solve(): b or x is not of the factor's size");
  if (size() > 0) impl_->factor->solve(b, x);
}

std::size_t SparseLu::size() const { return impl_->factor->n; }
std::size_t SparseLu::bytes() const { return impl_->factor->bytes(); }

}  // namespace stillpoint
