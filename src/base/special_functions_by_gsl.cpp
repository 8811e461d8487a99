#include <limits>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <gsl/gsl_sf_bessel.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <gsl/gsl_sf_exp.h>
#include <gsl/gsl_sf_lambert.h>
#include <gsl/gsl_sf_legendre.h>

#include "base/quiet_gsl.hpp"
#include "base/special_functions.hpp"

namespace stillpoint {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// The value of GSL's function(arguments…, &result); on underflow the 0 that GSL gives.
template <class Function, class... Arguments>
double value_of(Function function, Arguments... arguments) {
  const QuietGsl quiet;
  gsl_sf_result result{};
  const int code = function(arguments..., &result);
  return code == GSL_SUCCESS || code == GSL_EUNDRFLW ? result.val : no_value;
}

}  // namespace

double lambert_w(double x) { return value_of(gsl_sf_lambert_W0_e, x); }
double relative_exponential_2(double x) { return value_of(gsl_sf_exprel_2_e, x); }
double elliptic_f(double phi, double k) { return value_of(gsl_sf_ellint_F_e, phi, k, GSL_PREC_DOUBLE); }
double elliptic_e(double phi, double k) { return value_of(gsl_sf_ellint_E_e, phi, k, GSL_PREC_DOUBLE); }
double elliptic_k(double k) { return value_of(gsl_sf_ellint_Kcomp_e, k, GSL_PREC_DOUBLE); }
double bessel_j0(double x) { return value_of(gsl_sf_bessel_J0_e, x); }
double bessel_j1(double x) { return value_of(gsl_sf_bessel_J1_e, x); }
double legendre(int k, double x) { return value_of(gsl_sf_legendre_Pl_e, k, x); }
double student_quantile(double probability, double degrees_of_freedom) {
  return gsl_cdf_tdist_Pinv(probability, degrees_of_freedom);
}

JacobiFunctions jacobi(double u, double k) {
  const QuietGsl quiet;
  double sn = no_value, cn = no_value, dn = no_value;
  if (gsl_sf_elljac_e(u, k * k, &sn, &cn, &dn) != GSL_SUCCESS) return {no_value, no_value};
  return {sn, cn};
}

double zero_between(double a, double b, const std::function<double(double)>& f) {
  const double at_a = f(a), at_b = f(b);
  if (const auto end = zero_at_an_end(a, b, at_a, at_b)) return *end;
  const QuietGsl quiet;
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  if (!solver) throw std::bad_alloc();
  gsl_function function{[](double x, void* of) { return (*static_cast<const std::function<double(double)>*>(of))(x); },
                        const_cast<std::function<double(double)>*>(&f)};
  int code = gsl_root_fsolver_set(solver.get(), &function, a, b);
  constexpr int most = 500;  // Brent's method needs about ten
  constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();
  for (int k = 0; k < most && code == GSL_SUCCESS; ++k) {
    const double low = gsl_root_fsolver_x_lower(solver.get()), high = gsl_root_fsolver_x_upper(solver.get());
    if (low == high || gsl_root_test_interval(low, high, 0, rounding) == GSL_SUCCESS) break;
    code = gsl_root_fsolver_iterate(solver.get());
  }
  if (code != GSL_SUCCESS)
    throw std::domain_error(
        fmt::format("no zero is found between {:g} and {:g}: GSL says {}", a, b, gsl_strerror(code)));
  return gsl_root_fsolver_root(solver.get());
}

}  // namespace stillpoint
