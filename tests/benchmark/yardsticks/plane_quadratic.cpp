// A step in the plane with quadratic B-splines: cells with four points and nine functions each, 120 × 60 of them.
//
// In a cell a displacement is the polynomial Σ c_mn ξᵐ ηⁿ, m, n ≤ 2. Along an axis, the coefficients of u₀ N₀ + u₁ N₁ +
// u₂ N₂ are
//   c₀ = (u₀ + u₁)/2,   c₁ = u₁ − u₀,   c₂ = (u₀ + u₂)/2 − u₁,
// so that each point needs its position alone: with its nine gradients stored, 144 B a point, a step took 1.35 times as
// long.
// The forces are the transpose: sums over the points of a cell, S_mn = Σ V P · ∇(ξᵐ ηⁿ), are spread over the functions
// along an axis by
//   r₀ = (S₀ + S₂)/2 − S₁,   r₁ = S₀/2 + S₁ − S₂,   r₂ = S₂/2.
#include "plane.hpp"

namespace yardsticks {

namespace {

using namespace plane;

struct Three {
  Four of[3];
};
[[gnu::always_inline]] inline Three coefficients(const Four& u_0, const Four& u_1, const Four& u_2) {
  return {{0.5 * (u_0 + u_1), u_1 - u_0, 0.5 * (u_0 + u_2) - u_1}};
}
[[gnu::always_inline]] inline Three forces_of(const Four& S_0, const Four& S_1, const Four& S_2) {
  const Four half = 0.5 * S_2;
  return {{0.5 * S_0 - S_1 + half, 0.5 * S_0 + S_1 - S_2, half}};
}

class PlaneQuadratic final : public PlaneBlock {
 public:
  PlaneQuadratic() : PlaneBlock(2) {}

 private:
  void gather(const Places* places, const double* du, Gradient* H) const override {
    const std::size_t row = stride * grid_.node(0, 1);
    for (std::size_t k = 0; k < pairs; ++k, du += 2 * stride) {
      Three along_x[3], c[3];  // c[n].of[m]
      for (std::size_t b = 0; b < 3; ++b) {
        const double* of_row = du + b * row;
        along_x[b] = coefficients(load<Four>(of_row), load<Four>(of_row + stride), load<Four>(of_row + 2 * stride));
      }
      for (int m = 0; m < 3; ++m) {
        const Three of_m = coefficients(along_x[0].of[m], along_x[1].of[m], along_x[2].of[m]);
        for (int n = 0; n < 3; ++n) c[n].of[m] = per_side * of_m.of[n];
      }
      for (int q = 0; q < together; q += lanes, ++H) {
        const Lanes X = load<Lanes>(places[k].xi + q), Y = load<Lanes>(places[k].eta + q);
        gradient<0>(c, X, Y, q, H->xx, H->xy);
        gradient<1>(c, X, Y, q, H->yx, H->yy);
      }
    }
  }

  // ∂/∂ξ = c_10 + c_11 η + c_12 η² + 2 ξ (c_20 + c_21 η + c_22 η²) of component i, and ∂/∂η likewise.
  template <int i>
  [[gnu::always_inline]] static void gradient(const Three (&c)[3], const Lanes& X, const Lanes& Y, int q, Lanes& by_x,
                                              Lanes& by_y) {
    const auto at = [&](int m, int n) __attribute__((always_inline)) { return spread<i>(c[n].of[m], q); };
    const Lanes c_11 = at(1, 1), c_12 = at(1, 2), c_21 = at(2, 1), c_22 = at(2, 2);
    by_x = at(1, 0) + Y * (c_11 + Y * c_12) + (X + X) * (at(2, 0) + Y * (c_21 + Y * c_22));
    by_y = at(0, 1) + X * (c_11 + X * c_21) + (Y + Y) * (at(0, 2) + X * (c_12 + X * c_22));
  }

  void scatter(const Places* places, const Gradient* P, double* R) const override {
    const std::size_t row = stride * grid_.node(0, 1);
    Three before[3]{};  // forces of the pair before, of its functions [b].of[a]
    for (std::size_t k = 0; k < pairs; ++k, R += 2 * stride) {
      Pair S[3][3];  // [n][m], without the first
      for (int g = 0; g < groups; ++g, ++P) {
        const Lanes X = load<Lanes>(places[k].xi + g * lanes), Y = load<Lanes>(places[k].eta + g * lanes);
        add_to_sums(P->xx, P->xy, X, Y, g, &Pair::x, S);
        add_to_sums(P->yx, P->yy, X, Y, g, &Pair::y, S);
      }
      Three along_x[3], now[3];
      for (int n = 0; n < 3; ++n)
        along_x[n] = forces_of(n == 0 ? Four{} : S[n][0].of_cells(), S[n][1].of_cells(), S[n][2].of_cells());
      for (int a = 0; a < 3; ++a) {
        const Three of_a = forces_of(along_x[0].of[a], along_x[1].of[a], along_x[2].of[a]);
        for (int b = 0; b < 3; ++b) now[b].of[a] = of_a.of[b];
      }
      for (std::size_t b = 0; b < 3; ++b) {
        add(now[b].of[0] + one_further(before[b].of[1], now[b].of[1]) + before[b].of[2], R + b * row);
        before[b] = now[b];
      }
    }
    for (std::size_t b = 0; b < 3; ++b) add(one_further(before[b].of[1], Four{}) + before[b].of[2], R + b * row);
  }

  // P · ∇(ξᵐ ηⁿ) of the points of group g, for a component of P.
  [[gnu::always_inline]] static void add_to_sums(const Lanes& P_x, const Lanes& P_y, const Lanes& X, const Lanes& Y,
                                                 int g, Lanes (Pair::*component)[groups], Pair (&S)[3][3]) {
    const auto set = [&](int m, int n, const Lanes& of) __attribute__((always_inline)) {
      (S[n][m].*component)[g] = of;
    };
    const Lanes x_X = P_x * (X + X), y_Y = P_y * (Y + Y), XX = X * X, YY = Y * Y;
    set(1, 0, P_x);
    set(0, 1, P_y);
    set(2, 0, x_X);
    set(0, 2, y_Y);
    set(1, 1, P_x * Y + P_y * X);
    set(2, 1, x_X * Y + P_y * XX);
    set(1, 2, P_x * YY + y_Y * X);
    set(2, 2, x_X * YY + y_Y * XX);
  }
};

}  // namespace

std::unique_ptr<Yardstick> make_plane_quadratic() { return std::make_unique<PlaneQuadratic>(); }

}  // namespace yardsticks
