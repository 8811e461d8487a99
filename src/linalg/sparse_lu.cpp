// solve() writes into work space of the factor, so one object serves one thread at a time.
#include "linalg/sparse_lu.hpp"

#include <stdexcept>

#include <Eigen/SparseCore>

#include "base/work_apart.hpp"
#include "linalg/lu_factor.hpp"

namespace stillpoint {

struct SparseLu::Impl {
  std::shared_ptr<LuFactor> factor;  // an abandoned factorisation may still use it
  std::size_t n = 0;
  bool regular = false;
};

namespace {

bool factorise(const std::shared_ptr<LuFactor>& factor, std::size_t n) {
  constexpr std::size_t takes_long = 2000;  // unknowns for which a factor takes some hundredths of a second
  if (n < takes_long) return factor->factorise();
  const auto done = std::make_shared<bool>(false);
  work_apart([factor, done] { *done = factor->factorise(); });
  return *done;
}

}  // namespace

SparseLu::SparseLu(const SparseMatrix& A) : impl_(std::make_unique<Impl>()) {
  if (A.rows() != A.cols()) throw std::invalid_argument("LU factor of a matrix that is not square");
  impl_->factor = make_lu_factor(A);
  impl_->n = static_cast<std::size_t>(A.rows());
  impl_->regular = A.rows() == 0 || (A.nonZeros() > 0 && factorise(impl_->factor, impl_->n));
}

SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;
SparseLu::~SparseLu() = default;

bool SparseLu::regular() const { return impl_->regular; }

double SparseLu::pivot_ratio() const {
  if (!regular()) throw std::logic_error("pivot_ratio() of a matrix that is singular");
  return size() > 0 ? impl_->factor->pivot_ratio() : 1;
}

void SparseLu::solve(ConstVec b, Vec x) const {
  if (!regular()) throw std::logic_error("solve() with a matrix that is singular");
  if (b.size() != size() || x.size() != size())
    throw std::invalid_argument("solve(): b or x is not of the factor's size");
  if (size() > 0) impl_->factor->solve(b, x);
}

std::string_view SparseLu::library() { return lu_library(); }
std::size_t SparseLu::size() const { return impl_->n; }
std::size_t SparseLu::bytes() const { return impl_->factor->bytes(); }

}  // namespace stillpoint
