#include "linalg/conjugate_gradients.hpp"

#include <stillpoint/vector.hpp>

#include <algorithm>

#include "base/parallel_loop.hpp"
#include "base/stop_request.hpp"

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

}  // namespace stillpoint
