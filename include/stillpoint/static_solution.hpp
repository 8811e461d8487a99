// Static equilibrium R(u) = F(t) without any motion: Newton's method and conjugate gradients, the reference that
// relaxation is measured against.
#pragma once

#include <stillpoint/semi_discrete.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// How K du = Q is solved. automatic: by CHOLMOD if K is symmetric and positive definite, by UMFPACK otherwise, and
/// an equilibrium whose K is symmetric but indefinite is refused as unstable, unless accept_unstable.
/// cholesky: with the symmetric part of K. iterative: by conjugate gradients if K is symmetric, by GMRES otherwise,
/// without a factor.
enum class LinearSolver { automatic, cholesky, lu, iterative };

struct NewtonOptions {
  double tolerance = 1e-10;     // of ‖F − R‖/‖F‖
  double near_enough = 0;       // of the same, above it: will do where an iteration does not make it a tenth smaller
  int max_iterations = 25;      // in a load step
  int load_steps = 1;           // to begin with: halved if one fails, doubled if it is easy
  double max_load_step = 1;     // share of the load, so that a path is followed closely
  double min_load_step = 1e-3;  // share of the load: a shorter step that fails is the end
  double symmetry = 1e-12;      // K is symmetric if ‖K − Kᵀ‖ ≤ this ‖K‖ (Frobenius)
  int max_cg_iterations = 0;    // of an iterative solver, in a Newton iteration; 0: 10 n
  LinearSolver solver = LinearSolver::automatic;
  /// Of an iterative solver: B r, B ≈ K⁻¹ symmetric positive definite; none: that of diag M.
  std::function<void(ConstVec r, Vec Br)> preconditioner{};
  bool assembles = false;        // K for an iterative solver: quicker than the laws at every product, if there is room
  bool accept_unstable = false;  // if there is no stable equilibrium on the way that load steps follow
  /// Says what is wrong, or nothing.
  std::string validate() const;
};

struct ConjugateGradientOptions {
  double tolerance = 1e-10;  // of ‖F − R‖/‖F‖
  int max_iterations = 0;    // 0: 10 n
  std::string validate() const;
};

/// From one load factor s to another, which it reached if it converged.
struct LoadStep {
  double from = 0, to = 1;
  bool converged = false;
  std::vector<double> residuals;  // ‖F_s − R‖/‖F‖ at its start and after each iteration
};

struct StaticReport {
  bool converged = false;
  std::string reason;      // the inequality that ended it
  double residual = 0;     // ‖F − R‖/‖F‖ over the free degrees of freedom; of the reactions' norm if F = 0
  double load_factor = 0;  // s in equilibrium: 0 the state at the start, 1 the full load
  std::vector<LoadStep> load_steps;  // failed ones as well
  int iterations = 0;                // of Newton's method, or of conjugate gradients alone
  int cholesky_factorisations = 0, lu_factorisations = 0;
  int elastic_iterations = 0;  // that took the elastic tangent, the consistent one being of no use
  long force_evaluations = 0;  // R(u)
  long tangent_products = 0;   // K du, of iterative solvers
  double wall_s = 0;
  std::size_t factor_bytes = 0;  // of the largest factor
};

/// Newton's method on Q(u) = F_s(u) − R(u) = 0, K du = Q with the consistent tangent K = ∂R/∂u − s ∂F/∂u:
///   F_s = (1 − s) R(u₀) + s F(t, u),   s from 0 to 1 in load steps,
/// each committed if history_dependent(). u, (n): u₀ at the start, in the end the last equilibrium. A step du is
/// halved while ‖Q(u + λ du)‖ > (1 − 10⁻⁴ λ) ‖Q(u)‖ [Kelley 1995, §8.1] or u + λ du is inadmissible; if that comes
/// down to three short steps in a row, in a body without history, the load step is begun again with full ones.
/// Iterative solvers take K du = Q to min(0.1, ‖Q‖/‖F‖), which keeps the order 2 [Dembo, Eisenstat and Steihaug
/// 1982]. A matrix K that is that of the iteration before, as in a linear system, is not factorised again. Everything
/// happens at t: supports are where they then are from the first load step on, and a viscous law
/// flows in the first one, for the time since the last commit. Throws std::invalid_argument on bad options and if
/// the system has contact, which has no tangent here.
StaticReport newton(SemiDiscrete& system, double t, Vec u, const NewtonOptions& options = {});

/// Conjugate gradients on K (u' − u) = F − R(u), matrix-free, preconditioned with the diagonal of M: for a linear
/// system, or one so little nonlinear that it is met on the way. u, (n): the start, then the answer. Nothing is
/// committed. Throws as newton().
StaticReport conjugate_gradients(const SemiDiscrete& system, double t, Vec u,
                                 const ConjugateGradientOptions& options = {});

}  // namespace stillpoint
