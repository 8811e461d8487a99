#include "solvers/integrators/butcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>

namespace stillpoint {
namespace {

// R(z) = Σ_k r_k z^k with r_0 = 1, r_k = bᵀA^{k−1}1 [Hairer & Wanner, Solving ODEs II, eq. IV.2.9]; (stages + 1).
std::vector<double> stability_polynomial(const ButcherTable& table) {
  const auto stages = static_cast<std::size_t>(table.stages);
  std::vector<double> r = {1}, power(stages, 1.0), next(stages);  // power = A^{k−1} 1
  for (std::size_t k = 1; k <= stages; ++k) {
    r.push_back(std::inner_product(table.b.begin(), table.b.end(), power.begin(), 0.0));
    for (std::size_t i = 0; i < stages; ++i) {
      next[i] = 0;
      for (std::size_t j = 0; j < i; ++j) next[i] += table.A[i * stages + j] * power[j];
    }
    std::swap(power, next);
  }
  while (r.back() == 0) r.pop_back();
  return r;
}

template <class Number>
double modulus(const std::vector<double>& r, Number z) {
  Number R = 0;
  for (std::size_t k = r.size(); k-- > 0;) R = R * z + r[k];
  return std::abs(R);
}

// The nodes c_i = Σ_j a_ij of a consistent table.
std::vector<double> row_sums(const std::vector<double>& A, std::size_t stages) {
  std::vector<double> c(stages, 0.0);
  for (std::size_t i = 0; i < A.size(); ++i) c[i / stages] += A[i];
  return c;
}

ButcherTable make_table(std::string name, int order, std::vector<double> A, std::vector<double> b,
                        int embedded_order = 0, std::vector<double> b_embedded = {}) {
  const std::size_t stages = b.size();
  std::vector<double> c = row_sums(A, stages);
  return {std::move(name), static_cast<int>(stages), order, embedded_order, std::move(A), std::move(b),
          std::move(c),    std::move(b_embedded)};
}

}  // namespace

bool first_same_as_last(const ButcherTable& table) {
  constexpr double rounding = 1e-14;  // coefficients are quotients of integers or decimals of 16 digits
  const int last = table.stages - 1;
  if (last < 1 || std::abs(table.c.back() - 1) > rounding || std::abs(table.b.back()) > rounding) return false;
  for (int j = 0; j < last; ++j) {
    if (std::abs(table.a(last, j) - table.b[static_cast<std::size_t>(j)]) > rounding) return false;
  }
  return true;
}

int effective_stages(const ButcherTable& table) { return table.stages - (first_same_as_last(table) ? 1 : 0); }

AmplificationRadius amplification_of(const ButcherTable& table) {
  return [r = stability_polynomial(table)](double h, double omega, double rate) {
    // λ = −rate/2 ± √((rate/2)² − omega²), no square of which overflows
    const double half_rate = rate / 2, root = std::sqrt(std::abs(half_rate - omega)) * std::sqrt(half_rate + omega);
    if (half_rate < omega) return modulus(r, std::complex<double>(-h * half_rate, h * root));  // the same for both
    const double fast = -(half_rate + root);
    const double slow = fast == 0 ? 0 : omega * omega / fast;  // λ₁ λ₂ = omega², without cancellation
    return std::max(modulus(r, h * fast), modulus(r, h * slow));
  };
}

OscillatorStep oscillator_step_of(const ButcherTable& table) {
  return
      [table, k = std::vector<Oscillators>(table.b.size())](double h, const Damping& local, Oscillators& all) mutable {
        const auto stages = table.b.size();
        const auto add = [](double by, const Oscillators& rates, Oscillators& to) {
          for (std::size_t o = 0; o < to.u.size(); ++o) {
            to.u[o] += by * rates.u[o];
            to.v[o] += by * rates.v[o];
          }
        };
        for (std::size_t i = 0; i < stages; ++i) {
          Oscillators at = all;
          for (std::size_t j = 0; j < i; ++j) add(h * table.A[i * stages + j], k[j], at);
          k[i].u = at.v;
          k[i].v.resize(at.u.size());
          std::ranges::transform(at.u, k[i].v.begin(), std::negate());
          local.add_local(at.v, k[i].v);
        }
        for (std::size_t i = 0; i < stages; ++i) add(h * table.b[i], k[i], all);
      };
}

ButcherTable classical_rk4() {
  // [Kutta 1901; Hairer, Nørsett & Wanner, Solving ODEs I, table II.1.2]
  return make_table("rk4", 4,
                    {0, 0, 0, 0,    //
                     0.5, 0, 0, 0,  //
                     0, 0.5, 0, 0,  //
                     0, 0, 1, 0},   //
                    {1. / 6, 1. / 3, 1. / 3, 1. / 6});
}

ButcherTable sofroniou_spaletta_5_3_4() {
  // [Sofroniou & Spaletta, Construction of explicit Runge–Kutta pairs with stiffness detection, Mathematical and
  // Computer Modelling 40, 2004: the pair 4(3)]
  return make_table("sofroniou-spaletta-5-3-4", 4, {0,        0,         0,        0,        0,   //
                                                    2. / 5,   0,         0,        0,        0,   //
                                                    -3. / 20, 3. / 4,    0,        0,        0,   //
                                                    19. / 44, -15. / 44, 10. / 11, 0,        0,   //
                                                    11. / 72, 25. / 72,  25. / 72, 11. / 72, 0},  //
                    {11. / 72, 25. / 72, 25. / 72, 11. / 72, 0},                                  //
                    3,
                    {1251515. / 8970912, 3710105. / 8970912, 2519695. / 8970912, 61105. / 8970912, 119041. / 747576});
}

ButcherTable jameson_5() {
  // [Jameson, Schmidt & Turkel, AIAA paper 81-1259, 1981; the five-stage coefficients of Jameson 1985]
  return make_table("jameson-5", 2, {0,      0,      0,      0,      0,   //
                                     1. / 4, 0,      0,      0,      0,   //
                                     0,      1. / 6, 0,      0,      0,   //
                                     0,      0,      3. / 8, 0,      0,   //
                                     0,      0,      0,      1. / 2, 0},  //
                    {0, 0, 0, 0, 1});
}

}  // namespace stillpoint
