#include "linalg/lanczos.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>

#include "base/parallel_loop.hpp"
#include "base/stop_request.hpp"

namespace stillpoint {
namespace {

using Eigensystem = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

Eigensystem eigensystem(const std::vector<double>& alpha, const std::vector<double>& beta) {
  const auto m = static_cast<Eigen::Index>(alpha.size());
  const Eigen::Map<const Eigen::VectorXd> diagonal(alpha.data(), m), off_diagonal(beta.data(), m - 1);
  Eigensystem T;
  T.computeFromTridiagonal(diagonal, off_diagonal);
  return T;
}

// The eigenvalue at one end of T, with the one next to it for the gap; beta: the β_m that belongs to T's next row.
Lanczos::Largest at_end(const Eigensystem& T, double beta, Eigen::Index end, Eigen::Index next) {
  const Eigen::Index m = T.eigenvalues().size();
  const double theta = T.eigenvalues()(end), r = beta * std::abs(T.eigenvectors()(m - 1, end));
  const double gap = m > 1 ? std::abs(theta - T.eigenvalues()(next)) : 0;
  return {.theta = theta, .missing = r, .error = r < gap ? r * r / gap : r};
}

}  // namespace

Lanczos::Lanczos(LinearMap apply_A, LinearMap solve_B, Vector b, bool keeps_vectors)
    : apply_A_(std::move(apply_A)),
      solve_B_(std::move(solve_B)),
      w_(std::move(b)),
      last_w_(VectorSpace().make(w_.size())),
      q_(VectorSpace().make(w_.size())),
      Aq_(VectorSpace().make(w_.size())),
      keeps_vectors_(keeps_vectors) {
  solve_B_(w_.span(), q_.span());
  const double norm = std::sqrt(dot(q_, w_));
  finite_ = std::isfinite(norm);
  exhausted_ = !(norm > 0);
  divide(norm);
}

// Divides q and w by the norm.
void Lanczos::divide(double norm) {
  for_each_index(q_.size(), [=, q = q_.span().data(), w = w_.span().data()](std::size_t i) {
    q[i] /= norm;
    w[i] /= norm;
  });
}

bool Lanczos::step() {
  if (exhausted_ || !finite_) return false;
  heed_stop_request();
  const double last_beta = beta_.empty() ? 0 : beta_.back();
  if (keeps_vectors_) all_.emplace_back(q_.span().begin(), q_.span().end());
  apply_A_(q_.span(), Aq_.span());
  const double alpha = dot(q_, Aq_);
  for_each_index(q_.size(), [=, next = last_w_.span().data(), w = w_.span().data(), Aq = Aq_.span().data()](
                                std::size_t i) { next[i] = Aq[i] - (alpha * w[i] + last_beta * next[i]); });
  std::swap(w_, last_w_);
  solve_B_(w_.span(), q_.span());
  const double square = dot(q_, w_), beta = std::sqrt(std::max(0.0, square));
  alpha_.push_back(alpha);
  beta_.push_back(beta);
  finite_ = std::isfinite(alpha) && std::isfinite(square);
  if (!finite_) return false;
  constexpr double rounding = 1e-12;
  bound_ = std::max(bound_, std::abs(alpha) + last_beta + beta);
  exhausted_ = beta <= rounding * bound_;
  if (!exhausted_) divide(beta);
  return true;
}

Lanczos::Largest Lanczos::largest() const {
  const Eigensystem T = eigensystem(alpha_, beta_);
  const Eigen::Index m = T.eigenvalues().size();
  return at_end(T, beta_.back(), m - 1, m - 2);
}

Lanczos::Largest Lanczos::smallest() const { return at_end(eigensystem(alpha_, beta_), beta_.back(), 0, 1); }

double Lanczos::residual() const {
  double product = 1, pivot = 0;
  for (std::size_t j = 0; j < alpha_.size(); ++j) {
    pivot = j == 0 ? alpha_[0] : alpha_[j] - beta_[j - 1] * beta_[j - 1] / pivot;
    if (!(pivot > 0)) return std::numeric_limits<double>::infinity();
    product *= beta_[j] / pivot;
  }
  return product;
}

std::vector<double> Lanczos::vector() const {
  const Eigensystem T = eigensystem(alpha_, beta_);
  const Eigen::VectorXd s = T.eigenvectors().rightCols(1);
  std::vector<double> x(q_.size(), 0.0);
  for (std::size_t j = 0; j < all_.size(); ++j) {
    for_each_index(x.size(), [x = x.data(), q = all_[j].data(), s_j = s(static_cast<Eigen::Index>(j))](std::size_t i) {
      x[i] += s_j * q[i];
    });
  }
  return x;
}

}  // namespace stillpoint
