// A step in the plane: bilinear cells with four points each, 120 × 60 of them.
//
// With the position (ξ, η) of a point in its cell of side s, an increment is u = c + c_x ξ + c_y η + c_xy ξη, so that
//   s ∂u/∂x = c_x + c_xy η,   s ∂u/∂y = c_y + c_xy ξ,
// and the forces at the corners follow from the sums S_x = Σ V P_x/s, S_y and S_xy = Σ V (P_x η + P_y ξ)/s over the
// points of a cell: r_00 = S_xy − S_x − S_y, r_10 = S_x − S_xy, r_01 = S_y − S_xy, r_11 = S_xy.
#include "plane.hpp"

namespace yardsticks {

namespace {

using namespace plane;

class PlaneLinear final : public PlaneBlock {
 public:
  PlaneLinear() : PlaneBlock(1) {}

 private:
  void gather(const Places* places, const double* du, Gradient* H) const override {
    const std::size_t above = stride * grid_.node(0, 1);
    for (std::size_t k = 0; k < pairs; ++k, du += 2 * stride) {
      const Four u_00 = load<Four>(du), u_10 = load<Four>(du + stride);
      const Four u_01 = load<Four>(du + above), u_11 = load<Four>(du + above + stride);
      const Four c_x = per_side * (u_10 - u_00), c_y = per_side * (u_01 - u_00), c_xy = per_side * (u_11 - u_01) - c_x;
      for (int q = 0; q < together; q += lanes, ++H) {
        const Lanes X = load<Lanes>(places[k].xi + q), Y = load<Lanes>(places[k].eta + q);
        const Lanes twist_x = spread<0>(c_xy, q), twist_y = spread<1>(c_xy, q);
        *H = {.xx = spread<0>(c_x, q) + twist_x * Y,
              .xy = spread<0>(c_y, q) + twist_x * X,
              .yx = spread<1>(c_x, q) + twist_y * Y,
              .yy = spread<1>(c_y, q) + twist_y * X};
      }
    }
  }

  void scatter(const Places* places, const Gradient* P, double* R) const override {
    const std::size_t above = stride * grid_.node(0, 1);
    Four before_10{}, before_11{};  // forces at the right corners of the pair before
    for (std::size_t k = 0; k < pairs; ++k, R += 2 * stride) {
      Pair x, y, xy;
      for (int g = 0; g < groups; ++g, ++P) {
        const Lanes X = load<Lanes>(places[k].xi + g * lanes), Y = load<Lanes>(places[k].eta + g * lanes);
        x.x[g] = P->xx;
        x.y[g] = P->yx;
        y.x[g] = P->xy;
        y.y[g] = P->yy;
        xy.x[g] = P->xx * Y + P->xy * X;
        xy.y[g] = P->yx * Y + P->yy * X;
      }
      const Four S_x = x.of_cells(), S_y = y.of_cells(), S_xy = xy.of_cells();
      const Four r_10 = S_x - S_xy, r_01 = S_y - S_xy;
      add(S_xy - S_x - S_y + one_further(before_10, r_10), R);
      add(r_01 + one_further(before_11, S_xy), R + above);
      before_10 = r_10;
      before_11 = S_xy;
    }
    add(one_further(before_10, Four{}), R);
    add(one_further(before_11, Four{}), R + above);
  }
};

}  // namespace

std::unique_ptr<Yardstick> make_plane_linear() { return std::make_unique<PlaneLinear>(); }

}  // namespace yardsticks
