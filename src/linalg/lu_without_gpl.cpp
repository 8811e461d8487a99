// P R A Q = L U by Eigen, in supernodes [Demmel, Eisenstat, Gilbert, Li and Liu, SIAM J. Matrix Anal. Appl. 20(3),
// 1999], in the order of COLAMD; R divides each row by the sum of its magnitudes. It solves in steps of its own,
// because Eigen's solve() allocates.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseLU>

#include "linalg/lu_factor.hpp"

namespace stillpoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Entry = std::int64_t;  // L and U of a large A have more than 2³¹ of them
using Wide = Eigen::SparseMatrix<double, Eigen::ColMajor, Entry>;

// Eigen's factor, which stores L and U together: a supernode is a few columns with the same rows, whose values are
// dense, with the triangle of U on its diagonal above L.
class Supernodes : public Eigen::SparseLU<Wide, Eigen::COLAMDOrdering<Entry>> {
 public:
  bool no_memory() const { return m_lastError.starts_with("UNABLE TO"); }

  /// min |U_kk|/max |U_kk|.
  double pivot_ratio() const {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (Index s = 0; s < count(); ++s) {
      for (Index k = 0; k < columns(s); ++k) {
        const double pivot = std::abs(diagonal(s)(k, k));
        if (!std::isfinite(pivot)) return 0;
        least = std::min(least, pivot);
        most = std::max(most, pivot);
      }
    }
    return most > 0 ? least / most : 0;
  }

  /// Replaces y by U⁻¹ L⁻¹ y; work: (n).
  void solve_in_place(VectorXd& y, VectorXd& work) const {
    for (Index s = 0; s < count(); ++s) {
      const Index below = rows_below(s);
      auto own = y.segment(first(s), columns(s));
      diagonal(s).template triangularView<Eigen::UnitLower>().solveInPlace(own);
      work.head(below).noalias() = under(s) * own;
      const Entry* const row = m_Lstore.rowIndex() + m_Lstore.rowIndexPtr()[first(s)] + columns(s);
      for (Index k = 0; k < below; ++k) y(row[k]) -= work(k);
    }
    for (Index s = count() - 1; s >= 0; --s) {
      auto own = y.segment(first(s), columns(s));
      diagonal(s).template triangularView<Eigen::Upper>().solveInPlace(own);
      for (Index column = first(s); column < first(s) + columns(s); ++column) {
        for (decltype(m_Ustore)::InnerIterator entry(m_Ustore, column); entry; ++entry)
          y(entry.index()) -= y(column) * entry.value();
      }
    }
  }

  std::size_t bytes() const {
    const auto reals = static_cast<std::size_t>(m_glu.lusup.size() + m_glu.ucol.size() + m_mat.nonZeros());
    const auto integers = static_cast<std::size_t>(m_glu.lsub.size() + m_glu.usub.size() + m_mat.nonZeros());
    return reals * sizeof(double) + integers * sizeof(Entry);
  }

 private:
  using Panel = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

  Index count() const { return m_Lstore.nsuper() + 1; }
  Index first(Index s) const { return m_Lstore.supToCol()[s]; }
  Index columns(Index s) const { return first(s + 1) - first(s); }
  Index rows_below(Index s) const {
    return m_Lstore.rowIndexPtr()[first(s) + 1] - m_Lstore.rowIndexPtr()[first(s)] - columns(s);
  }
  Panel panel(Index s, Index from_row, Index rows) const {
    const Index begin = m_Lstore.colIndexPtr()[first(s)], stride = m_Lstore.colIndexPtr()[first(s) + 1] - begin;
    return {m_Lstore.valuePtr() + begin + from_row, rows, columns(s), Eigen::OuterStride<>(stride)};
  }
  Panel diagonal(Index s) const { return panel(s, 0, columns(s)); }
  Panel under(Index s) const { return panel(s, columns(s), rows_below(s)); }
};

class EigenLu final : public LuFactor {
 public:
  explicit EigenLu(const SparseMatrix& A) : A_(A), scale_(VectorXd::Zero(A.rows())) { A_.makeCompressed(); }

  bool factorise() override {
    for (Index column = 0; column < A_.cols(); ++column) {
      for (SparseMatrix::InnerIterator entry(A_, column); entry; ++entry)
        scale_(entry.row()) += std::abs(entry.value());
    }
    scale_ = scale_.cwiseInverse();
    if (!scale_.allFinite() || !(scale_.array() > 0).all()) return false;  // an empty row, or one that is not finite
    try {
      lu_.compute(Wide(scale_.asDiagonal() * A_));
      for (VectorXd* const vector : {&solution_, &residual_, &permuted_, &work_}) vector->resize(A_.rows());
    } catch (const std::bad_alloc&) {
      fail();
    }
    if (lu_.no_memory()) fail();
    return lu_.info() == Eigen::Success && lu_.pivot_ratio() > 0;
  }

  double pivot_ratio() const override { return lu_.pivot_ratio(); }

  void solve(ConstVec b, Vec x) override {
    constexpr int refinements = 2;
    const Eigen::Map<const VectorXd> B(b.data(), A_.rows());
    residual_ = B;
    solution_.setZero();
    for (int k = 0; k <= refinements; ++k) {
      if (k > 0) residual_ = B, residual_.noalias() -= A_ * solution_;
      if (residual_.isZero(0)) break;
      add_correction();
    }
    Eigen::Map<VectorXd>(x.data(), A_.rows()) = solution_;
  }

  std::size_t bytes() const override {
    const auto n = static_cast<std::size_t>(A_.rows()), entries = static_cast<std::size_t>(A_.nonZeros());
    return lu_.bytes() + entries * (sizeof(double) + sizeof(int)) + n * (5 * sizeof(double) + 8 * sizeof(Entry));
  }

 private:
  // Computes solution += Q U⁻¹ L⁻¹ P R residual.
  void add_correction() {
    residual_.array() *= scale_.array();
    permuted_ = lu_.rowsPermutation() * residual_;
    lu_.solve_in_place(permuted_, work_);
    work_ = lu_.colsPermutation().inverse() * permuted_;
    solution_ += work_;
  }

  [[noreturn]] void fail() const {
    throw std::runtime_error("the LU factor failed on a system of size " + std::to_string(A_.rows()) +
                             ": out of memory");
  }

  SparseMatrix A_;
  VectorXd scale_;  // diagonal of R
  Supernodes lu_;
  VectorXd solution_, residual_, permuted_, work_;  // (n)
};

}  // namespace

std::shared_ptr<LuFactor> make_lu_factor(const SparseMatrix& A) { return std::make_shared<EigenLu>(A); }
std::string_view lu_library() { return "Eigen"; }

}  // namespace stillpoint
