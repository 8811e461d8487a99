// Static equilibrium R(u) = F(t) without any motion, by Newton's method and conjugate gradients: the reference that
// relaxation is measured against.
#pragma once

#include <stillpoint/semi_discrete.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// The solver of K du = Q. automatic: CHOLMOD if K is symmetric and positive definite, UMFPACK otherwise; an
/// equilibrium whose K is symmetric but indefinite is refused as unstable, unless accept_unstable. cholesky: takes the
/// symmetric part of K. iterative: conjugate gradients if K is symmetric, GMRES otherwise, without a factor.
enum class LinearSolver { automatic, cholesky, lu, iterative };

struct NewtonOptions {
  double tolerance = 1e-10;  // limit of ‖F − R‖/‖F‖
  double near_enough = 0;  // a larger limit of ‖F − R‖/‖F‖, which is enough once an iteration reduces it by less
                           // than a tenth
  int max_iterations = 25;      // Newton iterations in a load step
  int load_steps = 1;           // initial number: a step is halved if it fails, doubled if it is easy
  bool sets_out_small = false;  // an undisplaced body is loaded by a 256th of a load step first, and then by twice as
                                // much each time: contact with friction remembers in how small a step it closed
  double max_load_step = 1;     // largest share of the load in a step, so that a path is followed closely
  double min_load_step = 1e-3;  // smallest share of the load in a step: a shorter step that fails is the end
  double symmetry = 1e-12;      // K is symmetric if ‖K − Kᵀ‖ ≤ this ‖K‖ (Frobenius)
  int max_cg_iterations = 0;    // iterations of an iterative solver in a Newton iteration; 0: 10 n
  LinearSolver solver = LinearSolver::automatic;
  /// The preconditioner of an iterative solver: B r, B ≈ K⁻¹ symmetric positive definite; empty: that by diag M.
  std::function<void(ConstVec r, Vec Br)> preconditioner{};
  bool assembles = false;        // assembles K for an iterative solver: quicker than the laws at every product, if
                                 // memory suffices
  bool accept_unstable = false;  // accepts an unstable equilibrium if there is no stable one on the path that load
                                 // steps follow
  /// Called at the start, s = 0, and at the equilibrium of each load step, with R and u, (n), and the reactions of the
  /// supports, (supports); empty: nobody asks.
  std::function<void(double s, ConstVec R, ConstVec reactions, ConstVec u)> at_equilibrium{};
  /// Describes the fault of the options; empty if there is none.
  std::string validate() const;
};

struct ConjugateGradientOptions {
  double tolerance = 1e-10;  // limit of ‖F − R‖/‖F‖
  int max_iterations = 0;    // 0: 10 n
  std::string validate() const;
};

/// A step from one load factor s to another, which it reached if it converged.
struct LoadStep {
  double from = 0, to = 1;
  bool converged = false;
  std::vector<double> residuals;  // ‖F_s − R‖/‖F‖ at the start of the step and after each iteration
};

struct StaticReport {
  bool converged = false;
  std::string reason;  // the inequality that ended the solution
  double residual = 0;  // ‖F − R‖/‖F‖ over the free degrees of freedom; relative to the reactions' norm if F = 0
  double load_factor = 0;            // the s in equilibrium: 0 the state at the start, 1 the full load
  std::vector<LoadStep> load_steps;  // all load steps, including failed ones
  int iterations = 0;                // iterations of Newton's method, or of conjugate gradients alone
  int cholesky_factorisations = 0, lu_factorisations = 0;
  int elastic_iterations = 0;  // iterations with the elastic tangent, where the consistent one failed
  long force_evaluations = 0;  // evaluations of R(u)
  long tangent_products = 0;   // products K du, by iterative solvers
  double wall_s = 0;
  std::size_t factor_bytes = 0;  // memory of the largest factor
};

/// Newton's method on Q(u) = F_s(u) − R(u) = 0, K du = Q with the consistent tangent K = ∂R/∂u − s ∂F/∂u:
///   F_s = (1 − s) R(u₀) + s F(t, u),   s from 0 to 1 in load steps,
/// each committed if history_dependent(). u, (n): u₀ at the start, in the end the last equilibrium. A step du is halved
/// while ‖Q(u + λ du)‖ > (1 − 10⁻⁴ λ) ‖Q(u)‖ [Kelley 1995, §8.1] or u + λ du is inadmissible; if that leads to three
/// short steps in a row or to none, in a body without history, the load step is begun again with full ones and
/// Tangents::matrix_ahead() in the place of K. Iterative solvers solve K du = Q to min(0.1, ‖Q‖/‖F‖), which keeps the
/// order 2 [Dembo, Eisenstat and Steihaug 1982]. A matrix K equal to that of the previous iteration, as in a linear
/// system, is not factorised again. Everything happens at t: supports have their positions of that time from the first
/// load step on, and a viscous law flows in the first one, for the time since the last commit. Throws
/// std::invalid_argument on bad options and if the system has contact, which has no tangent here.
StaticReport newton(SemiDiscrete& system, double t, Vec u, const NewtonOptions& options = {});

/// Conjugate gradients on K (u' − u) = F − R(u), matrix-free, preconditioned with the diagonal of M: for a linear
/// system, or one so weakly nonlinear that the iteration converges to its solution. u, (n): the start, then the answer.
/// Nothing is committed. Throws as newton().
StaticReport conjugate_gradients(const SemiDiscrete& system, double t, Vec u,
                                 const ConjugateGradientOptions& options = {});

}  // namespace stillpoint
