#include "linalg/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace stillpoint {
namespace {

double dot(ConstVec x, ConstVec y) { return std::inner_product(x.begin(), x.end(), y.begin(), 0.0); }
double norm(ConstVec x) { return std::sqrt(dot(x, x)); }

}  // namespace

ConjugateGradientResult conjugate_gradients(const LinearMap& A, ConstVec D, ConstVec b, Vec x, double tolerance,
                                            int max_iterations, const std::function<void(double)>& each) {
  const std::size_t n = b.size();
  std::vector<double> r(b.begin(), b.end()), z(n), p(n, 0.0), Ap(n);
  std::ranges::fill(x, 0.0);
  const double enough = tolerance * norm(b);
  ConjugateGradientResult result;
  double rz_before = 0;
  while (!(result.converged = norm(r) <= enough) && result.iterations < max_iterations) {
    for (std::size_t i = 0; i < n; ++i) z[i] = r[i] / D[i];
    const double rz = dot(r, z), beta = result.iterations > 0 ? rz / rz_before : 0;
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
    A(p, Ap);
    ++result.iterations;
    const double curvature = dot(p, Ap);
    if (!(curvature > 0)) {
      result.indefinite = true;
      return result;
    }
    const double alpha = rz / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * Ap[i];
    }
    rz_before = rz;
    if (each) each(norm(r));
  }
  return result;
}

}  // namespace stillpoint
