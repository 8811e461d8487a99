#include "linalg/krylov.hpp"

#include <stillpoint/vector.hpp>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include "base/parallel_loop.hpp"
#include "base/stop_request.hpp"
#include "linalg/sundials.hpp"

namespace stillpoint {

IterativeResult conjugate_gradients(const LinearMap& A, const LinearMap& B, ConstVec b, Vec x, double tolerance,
                                    int max_iterations, const std::function<void(double)>& each) {
  const std::size_t n = b.size();
  const VectorSpace vectors;
  Vector r = vectors.make(n), z = vectors.make(n), p = vectors.make(n), Ap = vectors.make(n);
  double *r_i = r.span().data(), *z_i = z.span().data(), *p_i = p.span().data();
  const double* Ap_i = Ap.span().data();
  std::ranges::copy(b, r_i);
  std::ranges::fill(x, 0.0);
  const double enough = tolerance * norm(r);
  IterativeResult result;
  double rz_before = 0;
  while (!(result.converged = norm(r) <= enough) && result.iterations < max_iterations) {
    B(r.span(), z.span());
    const double rz = dot(r, z), beta = result.iterations > 0 ? rz / rz_before : 0;
    for_each_index(n, [=](std::size_t i) { p_i[i] = z_i[i] + beta * p_i[i]; });
    heed_stop_request();
    A(p.span(), Ap.span());
    ++result.iterations;
    const double curvature = dot(p, Ap);
    if (!(curvature > 0)) {
      result.indefinite = true;
      return result;
    }
    const double alpha = rz / curvature;
    for_each_index(n, [=](std::size_t i) {
      x[i] += alpha * p_i[i];
      r_i[i] -= alpha * Ap_i[i];
    });
    rz_before = rz;
    if (each) each(norm(r));
  }
  return result;
}

LinearMap division_by(ConstVec D) {
  return [D](ConstVec x, Vec y) { for_each_index(y.size(), [=](std::size_t i) { y[i] = x[i] / D[i]; }); };
}

namespace {

constexpr int directions = 60;

// The data with which SUNDIALS calls back.
struct Operators {
  const LinearMap &A, &B;
  std::size_t n;
  int products = 0;
  std::exception_ptr exception{};  // kept, as it cannot cross C, and thrown again on this side

  // Returns 0 for done, −1 if an exception was thrown.
  int call(const LinearMap& map, N_Vector x, N_Vector y) noexcept {
    try {
      heed_stop_request();
      map(ConstVec(N_VGetArrayPointer(x), n), Vec(N_VGetArrayPointer(y), n));
      return 0;
    } catch (...) {
      exception = std::current_exception();
      return -1;
    }
  }
};

int multiply(void* self, N_Vector x, N_Vector Ax) noexcept {
  auto& operators = *static_cast<Operators*>(self);
  ++operators.products;
  return operators.call(operators.A, x, Ax);
}
int precondition(void* self, N_Vector r, N_Vector Br, sunrealtype /*tolerance*/, int /*side*/) noexcept {
  auto& operators = *static_cast<Operators*>(self);
  return operators.call(operators.B, r, Br);
}

struct Free {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};

}  // namespace

IterativeResult gmres(const LinearMap& A, const LinearMap& B, ConstVec b, Vec x, double tolerance, int max_iterations) {
  const VectorSpace vectors;
  Vector solution = vectors.make(b.size()), right_hand_side = vectors.make(b.size());
  std::ranges::copy(b, right_hand_side.span().begin());
  const std::unique_ptr<_generic_SUNLinearSolver, Free> solver(SUNLinSol_SPGMR(
      solution.handle(), SUN_PREC_RIGHT, directions, static_cast<SUNContext>(vectors.sundials_context())));
  if (!solver) throw std::bad_alloc();
  Operators operators{.A = A, .B = B, .n = b.size()};
  const auto check = [](int code, const char* call) {
    if (code != 0) throw std::runtime_error(fmt::format("SUNDIALS: {} failed with code {}", call, code));
  };
  check(SUNLinSol_SPGMRSetMaxRestarts(solver.get(), std::max(0, max_iterations / directions - 1)), "SetMaxRestarts");
  check(SUNLinSolSetATimes(solver.get(), &operators, multiply), "SetATimes");
  check(SUNLinSolSetPreconditioner(solver.get(), &operators, nullptr, precondition), "SetPreconditioner");
  check(SUNLinSolInitialize(solver.get()), "Initialize");
  check(SUNLinSolSetZeroGuess(solver.get(), 1), "SetZeroGuess");
  const int code = SUNLinSolSolve(solver.get(), nullptr, solution.handle(), right_hand_side.handle(),
                                  tolerance * norm(right_hand_side));
  if (operators.exception) std::rethrow_exception(std::exchange(operators.exception, nullptr));
  std::ranges::copy(std::as_const(solution).span(), x.begin());
  return {.iterations = operators.products, .converged = code == 0};
}

}  // namespace stillpoint
