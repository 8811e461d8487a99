#include "linalg/gmres.hpp"

#include <stillpoint/vector.hpp>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include "base/stop_request.hpp"
#include "linalg/sundials.hpp"

namespace stillpoint {
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
