// P R A Q = L U by UMFPACK [Davis, ACM TOMS 30(2), 2004, algorithm 832].
// It calls the C API itself, because UMFPACK's wsolve takes a given work space, while Eigen's wrapper allocates on each
// solve.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/SparseCore>
#include <suitesparse/umfpack.h>

#include "linalg/lu_factor.hpp"
#include "linalg/one_blas_thread.hpp"

namespace stillpoint {
namespace {

class UmfpackFactor final : public LuFactor {
 public:
  explicit UmfpackFactor(const SparseMatrix& matrix)
      : A(matrix), n(static_cast<std::size_t>(A.rows())), integers(n), reals(5 * n), solution(n) {
    A.makeCompressed();
    umfpack_di_defaults(control.data());
  }
  UmfpackFactor(const UmfpackFactor&) = delete;
  UmfpackFactor& operator=(const UmfpackFactor&) = delete;
  ~UmfpackFactor() override { umfpack_di_free_numeric(&numeric); }

  bool factorise() override {
    const OneBlasThread same_bits;
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
    return factorised == UMFPACK_OK && info[UMFPACK_RCOND] > 0 && std::isfinite(info[UMFPACK_RCOND]);
  }

  double pivot_ratio() const override { return info[UMFPACK_RCOND]; }

  void solve(ConstVec b, Vec x) override {
    const OneBlasThread same_bits;
    check(umfpack_di_wsolve(UMFPACK_A, A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), solution.data(), b.data(),
                            numeric, control.data(), nullptr, integers.data(), reals.data()),
          "wsolve");
    std::ranges::copy(solution, x.begin());
  }

  std::size_t bytes() const override {
    const auto nonzeros = static_cast<std::size_t>(A.nonZeros());
    return static_cast<std::size_t>(info[UMFPACK_NUMERIC_SIZE] * info[UMFPACK_SIZE_OF_UNIT]) +
           nonzeros * (sizeof(double) + sizeof(int)) + n * (6 * sizeof(double) + 2 * sizeof(int));
  }

 private:
  // All UMFPACK statuses are checked here: errors are negative, a singular matrix and other warnings positive.
  void check(int status, const char* step) const {
    if (status >= UMFPACK_OK) return;
    const char* why = status == UMFPACK_ERROR_out_of_memory ? "out of memory" : "internal error";
    throw std::runtime_error("UMFPACK's " + std::string(step) + " failed on a system of size " + std::to_string(n) +
                             ": " + why);
  }

  SparseMatrix A;
  std::size_t n;
  std::array<double, UMFPACK_CONTROL> control{};
  std::array<double, UMFPACK_INFO> info{};
  void* numeric = nullptr;
  std::vector<int> integers;            // work space Wi of wsolve
  std::vector<double> reals, solution;  // work space W of wsolve; x, which must not be b
};

}  // namespace

std::shared_ptr<LuFactor> make_lu_factor(const SparseMatrix& A) { return std::make_shared<UmfpackFactor>(A); }
std::string_view lu_library() { return "UMFPACK"; }

}  // namespace stillpoint
