// solve() writes into work space of the factor, so one object serves one thread at a time.
#include "linalg/sparse_cholesky.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>

#include "base/stop_request.hpp"
#include "base/work_apart.hpp"
#include "linalg/cholesky_factor.hpp"

namespace stillpoint {

struct SparseCholesky::Impl {
  std::shared_ptr<CholeskyFactor> factor = make_cholesky_factor();  // an abandoned factorisation may still use it
  std::size_t n = 0;
  bool positive_definite = false;
};

namespace {

bool factorise(const std::shared_ptr<CholeskyFactor>& factor, const SparseMatrix& A) {
  constexpr Eigen::Index takes_long = 5000;  // unknowns for which a factor takes some hundredths of a second
  if (A.rows() < takes_long || !may_be_stopped()) return factor->factorise(A);
  const auto done = std::make_shared<bool>(false);
  work_apart([factor, done, own = std::make_shared<const SparseMatrix>(A)] { *done = factor->factorise(*own); });
  return *done;
}

}  // namespace

SparseCholesky::SparseCholesky(const SparseMatrix& A) : impl_(std::make_unique<Impl>()) {
  if (A.rows() != A.cols()) throw std::invalid_argument("Cholesky factor of a matrix that is not square");
  impl_->n = static_cast<std::size_t>(A.rows());
  if (A.rows() == 0) {
    impl_->positive_definite = true;
    return;
  }
  if (A.nonZeros() == 0) return;  // as of ground that has no strength yet; the libraries take no empty matrix
  if (A.isCompressed()) {
    impl_->positive_definite = factorise(impl_->factor, A);
  } else {
    SparseMatrix compressed = A;
    compressed.makeCompressed();
    impl_->positive_definite = factorise(impl_->factor, compressed);
  }
  if (positive_definite()) {  // a first solve allocates the workspaces
    std::vector<double> zero(size(), 0.0);
    solve(zero, zero);
  }
}

SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;
SparseCholesky::~SparseCholesky() = default;

bool SparseCholesky::positive_definite() const { return impl_->positive_definite; }

double SparseCholesky::pivot_ratio() const {
  if (!positive_definite()) throw std::logic_error("pivot_ratio() of a matrix that is not positive definite");
  return size() > 0 ? impl_->factor->pivot_ratio() : 1;
}

void SparseCholesky::solve(ConstVec b, Vec x) const {
  if (!positive_definite()) throw std::logic_error("solve() with a matrix that is not positive definite");
  if (b.size() != size() || x.size() != size())
    throw std::invalid_argument("solve(): b or x is not of the factor's size");
  if (size() > 0) impl_->factor->solve(b, x);
}

std::string_view SparseCholesky::library() { return cholesky_library(); }
std::size_t SparseCholesky::size() const { return impl_->n; }
std::size_t SparseCholesky::bytes() const { return impl_->factor->bytes(); }

}  // namespace stillpoint
