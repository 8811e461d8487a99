#include "linalg/lanczos.hpp"

#include <algorithm>
#include <cmath>
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

}  // namespace

Lanczos::Lanczos(LinearMap apply_A, LinearMap apply_B, LinearMap solve_B, Vector x, bool keeps_vectors)
    : apply_A_(std::move(apply_A)),
      apply_B_(std::move(apply_B)),
      solve_B_(std::move(solve_B)),
      q_(std::move(x)),
      last_q_(VectorSpace().make(q_.size())),
      Aq_(VectorSpace().make(q_.size())),
      z_(VectorSpace().make(q_.size())),
      Bz_(VectorSpace().make(q_.size())),
      keeps_vectors_(keeps_vectors) {
  apply_B_(q_.span(), Bz_.span());
  const double norm = std::sqrt(dot(q_, Bz_));
  finite_ = std::isfinite(norm);
  exhausted_ = !(norm > 0);
  for_each_index(q_.size(), [=, q = q_.span().data()](std::size_t i) { q[i] /= norm; });
}

bool Lanczos::step() {
  if (exhausted_ || !finite_) return false;
  heed_stop_request();
  const std::size_t n = q_.size();
  const double last_beta = beta_.empty() ? 0 : beta_.back();
  if (keeps_vectors_) all_.emplace_back(q_.span().begin(), q_.span().end());
  apply_A_(q_.span(), Aq_.span());
  const double alpha = dot(q_, Aq_);
  solve_B_(Aq_.span(), z_.span());
  for_each_index(n, [=, z = z_.span().data(), q = q_.span().data(), last_q = last_q_.span().data()](std::size_t i) {
    z[i] -= alpha * q[i] + last_beta * last_q[i];
  });
  apply_B_(z_.span(), Bz_.span());
  const double square = dot(z_, Bz_), beta = std::sqrt(std::max(0.0, square));
  alpha_.push_back(alpha);
  beta_.push_back(beta);
  finite_ = std::isfinite(alpha) && std::isfinite(square);
  if (!finite_) return false;
  constexpr double rounding = 1e-12;
  bound_ = std::max(bound_, std::abs(alpha) + last_beta + beta);
  exhausted_ = beta <= rounding * bound_;
  if (exhausted_) return true;
  std::swap(last_q_, q_);
  for_each_index(n, [=, q = q_.span().data(), z = z_.span().data()](std::size_t i) { q[i] = z[i] / beta; });
  return true;
}

Lanczos::Largest Lanczos::largest() const {
  const Eigensystem T = eigensystem(alpha_, beta_);
  const Eigen::Index m = T.eigenvalues().size();
  const double theta = T.eigenvalues()(m - 1), r = beta_.back() * std::abs(T.eigenvectors()(m - 1, m - 1));
  const double gap = m > 1 ? theta - T.eigenvalues()(m - 2) : 0;
  return {.theta = theta, .missing = r, .error = r < gap ? r * r / gap : r};
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
