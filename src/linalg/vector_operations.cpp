#include "linalg/vector_operations.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/parallel_loop.hpp"
#include "linalg/sundials.hpp"

namespace stillpoint {
namespace {

double* entries(N_Vector v) { return NV_DATA_S(v); }
std::size_t length(N_Vector v) { return static_cast<std::size_t>(NV_LENGTH_S(v)); }

// --- entry by entry ---
// Arguments may be the same vector. Factors of ±1 need no case of their own: the product is exact, and the speed is
// limited by memory.

// z = a x + b y
void linear_sum(sunrealtype a, N_Vector x_vector, sunrealtype b, N_Vector y_vector, N_Vector z_vector) {
  const double *x = entries(x_vector), *y = entries(y_vector);
  double* z = entries(z_vector);
  for_each_index(length(z_vector), [=](std::size_t i) { z[i] = a * x[i] + b * y[i]; });
}

void set_constant(sunrealtype c, N_Vector z_vector) {
  double* z = entries(z_vector);
  for_each_index(length(z_vector), [=](std::size_t i) { z[i] = c; });
}

// z = c x
void scale(sunrealtype c, N_Vector x_vector, N_Vector z_vector) {
  const double* x = entries(x_vector);
  double* z = entries(z_vector);
  if (c == 1 && x == z) return;
  for_each_index(length(z_vector), [=](std::size_t i) { z[i] = c * x[i]; });
}

// z_i = x_i y_i
void multiply(N_Vector x_vector, N_Vector y_vector, N_Vector z_vector) {
  const double *x = entries(x_vector), *y = entries(y_vector);
  double* z = entries(z_vector);
  for_each_index(length(z_vector), [=](std::size_t i) { z[i] = x[i] * y[i]; });
}

// z_i = x_i / y_i
void divide(N_Vector x_vector, N_Vector y_vector, N_Vector z_vector) {
  const double *x = entries(x_vector), *y = entries(y_vector);
  double* z = entries(z_vector);
  for_each_index(length(z_vector), [=](std::size_t i) { z[i] = x[i] / y[i]; });
}

void absolute(N_Vector x_vector, N_Vector z_vector) {
  const double* x = entries(x_vector);
  double* z = entries(z_vector);
  for_each_index(length(z_vector), [=](std::size_t i) { z[i] = std::abs(x[i]); });
}

void invert(N_Vector x_vector, N_Vector z_vector) {
  const double* x = entries(x_vector);
  double* z = entries(z_vector);
  for_each_index(length(z_vector), [=](std::size_t i) { z[i] = 1 / x[i]; });
}

void add_constant(N_Vector x_vector, sunrealtype b, N_Vector z_vector) {
  const double* x = entries(x_vector);
  double* z = entries(z_vector);
  for_each_index(length(z_vector), [=](std::size_t i) { z[i] = x[i] + b; });
}

// --- reductions ---

sunrealtype dot_product(N_Vector x_vector, N_Vector y_vector) {
  const double *x = entries(x_vector), *y = entries(y_vector);
  return sum_over(length(x_vector), [=](std::size_t i) { return x[i] * y[i]; });
}

// max |x_i|. Without its sign bit a double orders like an integer of the same bits, and NaN comes after infinity, so
// that NaN survives.
sunrealtype max_norm_of(N_Vector x_vector) {
  const double* x = entries(x_vector);
  constexpr std::int64_t without_sign = INT64_MAX;
  const auto magnitude = [=](std::size_t i) { return std::bit_cast<std::int64_t>(x[i]) & without_sign; };
  const auto larger = [](std::int64_t a, std::int64_t b) { return a > b ? a : b; };
  return std::bit_cast<double>(reduce(length(x_vector), std::int64_t{0}, magnitude, larger));
}

// Σ (x_i w_i)²
sunrealtype weighted_square_sum(N_Vector x_vector, N_Vector w_vector) {
  const double *x = entries(x_vector), *w = entries(w_vector);
  return sum_over(length(x_vector), [=](std::size_t i) { return x[i] * w[i] * (x[i] * w[i]); });
}

sunrealtype weighted_rms_norm(N_Vector x, N_Vector w) {
  return std::sqrt(weighted_square_sum(x, w) / static_cast<double>(length(x)));
}

sunrealtype weighted_l2_norm(N_Vector x, N_Vector w) { return std::sqrt(weighted_square_sum(x, w)); }

sunrealtype l1_norm(N_Vector x_vector) {
  const double* x = entries(x_vector);
  return sum_over(length(x_vector), [=](std::size_t i) { return std::abs(x[i]); });
}

sunrealtype minimum(N_Vector x_vector) {
  const double* x = entries(x_vector);
  return reduce(
      length(x_vector), static_cast<double>(SUN_BIG_REAL), [=](std::size_t i) { return x[i]; },
      [](double a, double b) { return b < a ? b : a; });
}

// --- several vectors in one pass, as in a Runge–Kutta stage ---

constexpr std::size_t most_terms = 16;  // terms of one pass: Fehlberg's 13 stages and y, with some to spare

struct Terms {
  std::array<double, most_terms> factor;
  std::array<const double*, most_terms> entry;
};

// z = Σ_{k<N} c_k x_k, with each entry read and written once
template <std::size_t... k>
void combine_terms(std::size_t n, const Terms& terms, double* z, std::index_sequence<k...>) {
  const std::array<double, sizeof...(k)> c = {terms.factor[k]...};
  const std::array<const double*, sizeof...(k)> x = {terms.entry[k]...};
  for_each_index(n, [=](std::size_t i) { z[i] = (... + (c[k] * x[k][i])); });
}

using CombineTerms = void (*)(std::size_t, const Terms&, double*);

template <std::size_t... N>
constexpr std::array<CombineTerms, sizeof...(N)> combine_tables(std::index_sequence<N...>) {
  return {[](std::size_t n, const Terms& terms, double* z) {
    combine_terms(n, terms, z, std::make_index_sequence<N + 1>{});
  }...};
}
constexpr auto combine_up_to = combine_tables(std::make_index_sequence<most_terms>{});

// z = Σ c_k X_k; z may be X_0. Terms with c_k = 0 are left out: half of a large Butcher table is empty.
int linear_combination(int count, sunrealtype* c, N_Vector* X, N_Vector z_vector) {
  double* z = entries(z_vector);
  const std::size_t n = length(z_vector);
  Terms terms;
  std::size_t used = 0;
  bool begun = false;
  for (int k = 0; k < count; ++k) {
    if (c[k] == 0) continue;
    if (used == most_terms) {
      combine_up_to[used - 1](n, terms, z);
      terms.factor[0] = 1;
      terms.entry[0] = z;
      used = 1;
    }
    terms.factor[used] = c[k];
    terms.entry[used] = entries(X[k]);
    ++used;
    begun = true;
  }
  if (begun) {
    combine_up_to[used - 1](n, terms, z);
  } else {
    set_constant(0, z_vector);
  }
  return 0;
}

// Z_k = a_k x + Y_k
int scale_add_multi(int count, sunrealtype* a, N_Vector x, N_Vector* Y, N_Vector* Z) {
  for (int k = 0; k < count; ++k) linear_sum(a[k], x, 1, Y[k], Z[k]);
  return 0;
}

// x·Y_k, equal to dot_product() to the bit
int dot_product_multi(int count, N_Vector x_vector, N_Vector* Y, sunrealtype* products) {
  constexpr int most = 8;  // products of one pass
  const double* x = entries(x_vector);
  for (int done = 0; done < count; done += most) {
    const int now = std::min(most, count - done);
    std::array<const double*, most> y{};
    for (int k = 0; k < now; ++k) y[static_cast<std::size_t>(k)] = entries(Y[done + k]);
    const auto sums = sum_each<most>(static_cast<std::size_t>(now), length(x_vector),
                                     [x, y](std::size_t k, std::size_t i) { return x[i] * y[k][i]; });
    std::copy_n(sums.begin(), now, products + done);
  }
  return 0;
}

}  // namespace

void use_fast_operations(NVectorHandle serial) {
  _generic_N_Vector_Ops& ops = *serial->ops;
  ops.nvlinearsum = linear_sum;
  ops.nvconst = set_constant;
  ops.nvscale = scale;
  ops.nvprod = multiply;
  ops.nvdiv = divide;
  ops.nvabs = absolute;
  ops.nvinv = invert;
  ops.nvaddconst = add_constant;
  ops.nvdotprod = ops.nvdotprodlocal = dot_product;
  ops.nvmaxnorm = ops.nvmaxnormlocal = max_norm_of;
  ops.nvwrmsnorm = weighted_rms_norm;
  ops.nvwl2norm = weighted_l2_norm;
  ops.nvwsqrsumlocal = weighted_square_sum;
  ops.nvl1norm = ops.nvl1normlocal = l1_norm;
  ops.nvmin = ops.nvminlocal = minimum;
  ops.nvlinearcombination = linear_combination;
  ops.nvscaleaddmulti = scale_add_multi;
  ops.nvdotprodmulti = ops.nvdotprodmultilocal = dot_product_multi;
}

bool same_kind(const Vector& a, const Vector& b) { return N_VGetVectorID(a.handle()) == N_VGetVectorID(b.handle()); }

void copy(const Vector& from, Vector& to) { N_VScale(1, from.handle(), to.handle()); }

bool has_fast_operations(NVectorHandle any) { return any->ops->nvlinearcombination == linear_combination; }

}  // namespace stillpoint
