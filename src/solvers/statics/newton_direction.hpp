// The direction of a Newton step, K du = Q with the tangent of the laws or with the elastic one.
#pragma once

#include <stillpoint/static_solution.hpp>

#include <optional>
#include <vector>

#include <Eigen/SparseCore>

#include "linalg/linear_map.hpp"
#include "solvers/statics/semidefinite_factor.hpp"
#include "system/static_balance.hpp"

namespace stillpoint {

class NewtonDirection {
 public:
  /// t: the time of the loads [s]; balance: its Q is the right-hand side; report: counts the work. All arguments must
  /// outlive this object.
  NewtonDirection(const SemiDiscrete& system, double t, const NewtonOptions& options, const StaticBalance& balance,
                  StaticReport& report)
      : system_(system), t_(t), options_(options), balance_(balance), report_(report), du_(system.size()) {}

  void begin_load_step() { indefinite_ = false; }
  /// Solves K du = Q at u, with Q as last evaluated at the share s of the loads. from: the state before the last step,
  /// if K is to be Tangents::matrix_ahead(), or empty. False if that cannot be solved.
  bool find(double s, ConstVec u, ConstVec from);
  /// The same with K_e, which is never singular in a body that is held.
  bool find_elastic(ConstVec u);
  /// The direction of the last solution, (n).
  const std::vector<double>& du() const { return du_; }
  /// Whether the K of the last find() was indefinite; false if it was unsymmetric.
  bool indefinite() const { return indefinite_; }
  /// Releases the factor, unless its matrix has come up again: in a linear system the next K is the same.
  void forget_new_factor() {
    if (!is_used_again_) forget_factor();
  }

 private:
  SparseMatrix consistent_matrix(double s, ConstVec u, ConstVec from, const SparseMatrix& of_loads) const;
  bool by_cholesky(const SparseMatrix& K);
  bool by_lu(const SparseMatrix& K);
  bool by_iterations(const LinearMap& K, bool is_symmetric);
  bool looks_symmetric(const LinearMap& K);
  void forget_factor();

  const SemiDiscrete& system_;
  double t_;
  const NewtonOptions& options_;
  const StaticBalance& balance_;
  StaticReport& report_;
  std::vector<double> du_;
  SparseMatrix factorised_;                   // K of the factor
  std::optional<SemidefiniteFactor> factor_;  // kept if the next K may be the same
  bool is_used_again_ = false;                // the last K was the factorised one
  bool semidefinite_ = false;                 // the last factor's K was semidefinite
  bool indefinite_ = false;
};

}  // namespace stillpoint
