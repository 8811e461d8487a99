// The only file that calls PETSc: compiled into a module of its own, which multigrid.cpp loads when it is needed.

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>
#include <fmt/format.h>
#include <petsc.h>

#include "linalg/multigrid.hpp"

namespace stillpoint {
namespace {

// PETSc may not be called by several threads at once, and its error handler is shared by all.
std::mutex petsc;
std::string first_message;

PetscErrorCode remember(MPI_Comm, int, const char* function, const char*, PetscErrorCode code, PetscErrorType type,
                        const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL)
    first_message = fmt::format("{} in {}", message ? message : "no message", function ? function : "PETSc");
  return code;
}

void check(PetscErrorCode code) {
  if (code != 0) throw std::runtime_error(fmt::format("PETSc fails: {} (error {})", first_message, code));
}

// PETSc runs in one process, however that was started: without these settings OpenMPI looks for networks and a
// launcher, a third of a second, and makes folders for temporary files that all such processes share, which the first
// of them to end takes from the others. Values that the user has set are kept.
void start_petsc() {
  static const bool started = [] {
    constexpr int keep = 0;
    setenv("OMPI_MCA_ess_singleton_isolated", "1", keep);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", keep);
    setenv("OMPI_MCA_btl", "self", keep);
    setenv("OMPI_MCA_pml", "ob1", keep);
    check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));  // the program has its own
    check(PetscOptionsSetValue(nullptr, "-skip_petscrc", "true"));       // results depend on the scene alone
    check(PetscInitializeNoArguments());
    check(PetscPushErrorHandler(remember, nullptr));
    std::atexit([] { PetscFinalize(); });
    return true;
  }();
  static_cast<void>(started);
}

class Gamg final : public Multigrid {
 public:
  Gamg(const SparseMatrix& K, const NodalLayout& layout) : layout_(layout) {
    const std::scoped_lock lock(petsc);
    start_petsc();
    make_matrix(K);
    check(PCCreate(PETSC_COMM_SELF, &cycle_));
    check(PCSetOptionsPrefix(cycle_, "stillpoint_"));
    check(PCSetType(cycle_, PCGAMG));
    check(PCGAMGSetType(cycle_, PCGAMGAGG));
    set_options();
    check(PCSetFromOptions(cycle_));
    check(PCSetOperators(cycle_, K_, K_));
    check(PCSetCoordinates(cycle_, layout.dim, static_cast<PetscInt>(layout.nodes()), layout_.positions.data()));
    check(PCSetUp(cycle_));
  }
  ~Gamg() override {
    const std::scoped_lock lock(petsc);
    PCDestroy(&cycle_);
    MatDestroy(&K_);
    VecDestroy(&x_);
    VecDestroy(&b_);
  }
  Gamg(const Gamg&) = delete;
  Gamg& operator=(const Gamg&) = delete;

  void apply(ConstVec b, Vec x) const override {
    const std::scoped_lock lock(petsc);
    double *to = nullptr, *from = nullptr;
    check(VecGetArrayWrite(b_, &to));
    for (std::size_t k = 0; k < row_.size(); ++k) to[row_[k]] = b[k];  // the other rows stay 0
    check(VecRestoreArrayWrite(b_, &to));
    check(PCApply(cycle_, b_, x_));
    check(VecGetArray(x_, &from));
    for (std::size_t k = 0; k < row_.size(); ++k) x[k] = from[row_[k]];
    check(VecRestoreArray(x_, &from));
  }

  int levels() const override {
    PetscInt levels = 0;
    PCMGGetLevels(cycle_, &levels);
    return static_cast<int>(levels);
  }
  std::size_t bytes() const override {
    double total = 0;
    for (PetscInt level = 0; level < levels(); ++level) {
      KSP smoother = nullptr;
      Mat A = nullptr, P = nullptr;
      if (PCMGGetSmoother(cycle_, level, &smoother) != 0 || KSPGetOperators(smoother, &A, nullptr) != 0) continue;
      total += memory_of(A);
      if (level > 0 && PCMGGetInterpolation(cycle_, level, &P) == 0) total += memory_of(P);
    }
    return static_cast<std::size_t>(total);
  }

 private:
  // Memory of a matrix stored by rows, with a value and a column for each entry [bytes].
  static double memory_of(Mat A) {
    MatInfo info{};
    PetscInt rows = 0;
    if (MatGetInfo(A, MAT_LOCAL, &info) != 0 || MatGetLocalSize(A, &rows, nullptr) != 0) return 0;
    return std::max(info.nz_allocated, info.nz_used) * (sizeof(PetscScalar) + sizeof(PetscInt)) +
           rows * sizeof(PetscInt);
  }

  // Smoothing is by Chebyshev polynomials of degree 3 over Jacobi: no product is quicker than with 2 or 4, and it needs
  // 15 iterations where those need 17 and 14. There is no threshold on strong coupling: with one of 0.001 to 0.1 a body
  // with an inclusion 10⁶ times as stiff takes 40 iterations in place of 25, and others as many as without.
  void set_options() {
    const auto set = [](const char* name, const char* value) { check(PetscOptionsSetValue(nullptr, name, value)); };
    set("-stillpoint_pc_gamg_threshold", "0");
    set("-stillpoint_pc_gamg_agg_nsmooths", "1");
    set("-matptap_via", "rap");  // halves the time for coarse levels in space
    set("-stillpoint_mg_levels_ksp_type", "chebyshev");
    set("-stillpoint_mg_levels_pc_type", "jacobi");
    set("-stillpoint_mg_levels_ksp_max_it", "3");
  }

  // K with all components of each node: a held component has a row of its own, of the size of the others.
  void make_matrix(const SparseMatrix& K) {
    const auto dim = static_cast<std::size_t>(layout_.dim);
    row_.resize(layout_.node.size());
    for (std::size_t k = 0; k < row_.size(); ++k) row_[k] = layout_.dim * layout_.node[k] + layout_.component[k];
    rows_ = static_cast<PetscInt>(dim * layout_.nodes());
    fill(K);
    wrap();
    check(MatCreateVecs(K_, &x_, &b_));
    check(VecZeroEntries(b_));
  }

  void fill(const SparseMatrix& K) {
    begin_.assign(static_cast<std::size_t>(rows_) + 1, 0);
    column_.clear();
    value_.clear();
    column_.reserve(static_cast<std::size_t>(K.nonZeros()));
    value_.reserve(static_cast<std::size_t>(K.nonZeros()));
    double scale = 0;
    for (Eigen::Index k = 0; k < K.outerSize(); ++k) scale += K.coeff(k, k);
    scale /= static_cast<double>(std::max<Eigen::Index>(K.outerSize(), 1));
    std::size_t k = 0;
    for (PetscInt row = 0; row < rows_; ++row) {
      if (k < row_.size() && row_[k] == row) {
        for (SparseMatrix::InnerIterator entry(K, static_cast<Eigen::Index>(k)); entry; ++entry) {
          column_.push_back(row_[static_cast<std::size_t>(entry.row())]);
          value_.push_back(entry.value());
        }
        ++k;
      } else {
        column_.push_back(row);
        value_.push_back(scale);
      }
      begin_[static_cast<std::size_t>(row) + 1] = static_cast<PetscInt>(column_.size());
    }
  }
  void wrap() {
    check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, rows_, rows_, begin_.data(), column_.data(), value_.data(), &K_));
    check(MatSetBlockSize(K_, layout_.dim));
    check(MatSetOption(K_, MAT_SPD, PETSC_TRUE));
  }

  NodalLayout layout_;
  std::vector<PetscInt> row_;  // row of each unknown
  PetscInt rows_ = 0;
  std::vector<PetscInt> begin_, column_;  // arrays of K_, which reads them in place
  std::vector<double> value_;
  Mat K_ = nullptr;
  PC cycle_ = nullptr;
  ::Vec x_ = nullptr, b_ = nullptr;
};

}  // namespace
}  // namespace stillpoint

extern "C" stillpoint::Multigrid* stillpoint_make_gamg(const stillpoint::SparseMatrix& K,
                                                       const stillpoint::NodalLayout& layout) {
  return new stillpoint::Gamg(K, layout);
}
