// A step in space: trilinear cells with eight points each, 24 × 24 × 24 of them.
//
// With the position (ξ, η, ζ) of a point in its cell of side s, an increment is
//   u = c + c_x ξ + c_y η + c_z ζ + c_xy ξη + c_yz ηζ + c_zx ζξ + c_xyz ξηζ,
//   s ∂u/∂x = c_x + c_xy η + c_zx ζ + c_xyz ηζ,   …
// and the forces at the corners follow from the sums of a cell's points that have the same places in this as the
// coefficients c. The points of a cell are computed together, as lanes.
#include <array>
#include <utility>
#include <vector>

#include "block.hpp"
#include "lanes.hpp"

namespace yardsticks {

namespace {

constexpr double side = 0.1, per_side = 1 / side;
constexpr std::size_t stride = 4;  // a node's three components and none: a register

struct alignas(64) Places {
  double xi[together], eta[together], zeta[together], volume[together];
};
struct alignas(64) History {
  double stress[6][together];  // xx, yy, zz, xy, yz, zx
  double plastic_strain[together];
};

struct Stress {
  Lanes xx, yy, zz, xy, yz, zx;
};
using Gradient = Lanes[3][3];
struct OfPoints {  // in an std::vector, which holds no arrays
  Gradient of;
};

// σ + W σ − σ W + λ tr(D) I + 2 G D, with D and W the symmetric and the skew part of H.
[[gnu::always_inline]] inline Stress elastic_trial(const Stress& s, const Gradient& H) {
  const Lanes w_xy = 0.5 * (H[0][1] - H[1][0]), w_yz = 0.5 * (H[1][2] - H[2][1]), w_zx = 0.5 * (H[2][0] - H[0][2]);
  const Lanes volumetric = soil::lambda * (H[0][0] + H[1][1] + H[2][2]);
  constexpr double G = soil::shear;
  return {.xx = s.xx + 2 * (w_xy * s.xy - w_zx * s.zx) + volumetric + 2 * G * H[0][0],
          .yy = s.yy + 2 * (w_yz * s.yz - w_xy * s.xy) + volumetric + 2 * G * H[1][1],
          .zz = s.zz + 2 * (w_zx * s.zx - w_yz * s.yz) + volumetric + 2 * G * H[2][2],
          .xy = s.xy + w_xy * (s.yy - s.xx) + w_yz * s.zx - w_zx * s.yz + G * (H[0][1] + H[1][0]),
          .yz = s.yz + w_yz * (s.zz - s.yy) + w_zx * s.xy - w_xy * s.zx + G * (H[1][2] + H[2][1]),
          .zx = s.zx + w_zx * (s.xx - s.zz) + w_xy * s.yz - w_yz * s.xy + G * (H[2][0] + H[0][2])};
}

// Onto the cone √J₂ + η p ≤ 0 along the deviator, after p > 0 is cut to 0.
[[gnu::always_inline]] inline Stress returned(const Stress& trial, Lanes& plastic_strain) {
  const Lanes p_trial = (trial.xx + trial.yy + trial.zz) * (1.0 / 3), p = smaller(p_trial, Lanes{});
  const Lanes xx = trial.xx - p_trial, yy = trial.yy - p_trial, zz = trial.zz - p_trial;
  const Lanes root_J2 = square_root(0.5 * (xx * xx + yy * yy + zz * zz) + trial.xy * trial.xy + trial.yz * trial.yz +
                                    trial.zx * trial.zx);
  const Lanes after = smaller(root_J2, -soil::eta * p), scale = after / (root_J2 + soil::tiny);
  plastic_strain += (root_J2 - after) * (1 / soil::shear);
  return {xx * scale + p, yy * scale + p, zz * scale + p, trial.xy * scale, trial.yz * scale, trial.zx * scale};
}

// V P/s of the points q … q + lanes − 1 of a cell, in place of H, and their history.
[[gnu::always_inline]] inline void respond(const Places& places, const History& before, int q, History& next,
                                           Gradient& H) {
  const auto& from = before.stress;
  Lanes plastic_strain = load<Lanes>(before.plastic_strain + q);
  const Stress s =
      returned(elastic_trial({load<Lanes>(from[0] + q), load<Lanes>(from[1] + q), load<Lanes>(from[2] + q),
                              load<Lanes>(from[3] + q), load<Lanes>(from[4] + q), load<Lanes>(from[5] + q)},
                             H),
               plastic_strain);
  store(s.xx, next.stress[0] + q);
  store(s.yy, next.stress[1] + q);
  store(s.zz, next.stress[2] + q);
  store(s.xy, next.stress[3] + q);
  store(s.yz, next.stress[4] + q);
  store(s.zx, next.stress[5] + q);
  store(plastic_strain, next.plastic_strain + q);

  // P = σ cof f, f = I + H
  const Lanes f_xx = 1 + H[0][0], f_yy = 1 + H[1][1], f_zz = 1 + H[2][2];
  const Gradient cof = {
      {f_yy * f_zz - H[1][2] * H[2][1], H[1][2] * H[2][0] - H[1][0] * f_zz, H[1][0] * H[2][1] - f_yy * H[2][0]},
      {H[0][2] * H[2][1] - H[0][1] * f_zz, f_xx * f_zz - H[0][2] * H[2][0], H[0][1] * H[2][0] - f_xx * H[2][1]},
      {H[0][1] * H[1][2] - H[0][2] * f_yy, H[0][2] * H[1][0] - f_xx * H[1][2], f_xx * f_yy - H[0][1] * H[1][0]}};
  const Lanes sigma[3][3] = {{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}};
  const Lanes volume = per_side * load<Lanes>(places.volume + q);
  for (int d = 0; d < 3; ++d)
    for (int axis = 0; axis < 3; ++axis)
      H[d][axis] = volume * (sigma[d][0] * cof[0][axis] + sigma[d][1] * cof[1][axis] + sigma[d][2] * cof[2][axis]);
}

class Space final : public Block {
 public:
  explicit Space(int cells)
      : Block({.dim = 3, .degree = 1, .cells = {cells, cells, cells}, .side = side, .stride = stride}),
        places_(grid_.cell_count()),
        committed_(grid_.cell_count()),
        trial_(grid_.cell_count()),
        row_(static_cast<std::size_t>(groups * cells)) {
    fill();
    const std::size_t to_y = stride * grid_.node(0, 1, 0), to_z = stride * grid_.node(0, 0, 1);
    corner_ = {0, stride, to_y, to_y + stride, to_z, to_z + stride, to_z + to_y, to_z + to_y + stride};
  }
  std::size_t bytes_per_point() const override { return (sizeof(Places) + 3 * sizeof(History)) / together; }

 private:
  // A row of cells at a time: what is between its gather, law and scatter stays in the first-level cache, and each of
  // the three is a short loop, so that a processor has several cells in work and waits for no root or quotient.
  void forces() override {
    const auto cells = static_cast<std::size_t>(grid_.cells[0]);
    std::size_t first = 0;
    for (int k = 0; k < grid_.cells[2]; ++k) {
      for (int j = 0; j < grid_.cells[1]; ++j, first += cells) {
        const std::size_t node = stride * grid_.node(0, j, k);
        for (std::size_t c = 0; c < cells; ++c)
          gather(places_[first + c], du_.data() + node + stride * c, &row_[groups * c]);
        for (std::size_t c = 0; c < cells; ++c) {
          for (int g = 0; g < groups; ++g) {
            Gradient& of = row_[groups * c + static_cast<std::size_t>(g)].of;
            respond(places_[first + c], committed_[first + c], g * lanes, trial_[first + c], of);
          }
        }
        for (std::size_t c = 0; c < cells; ++c)
          scatter(places_[first + c], &row_[groups * c], R_.data() + node + stride * c);
      }
    }
  }

  // H of a cell's points; du: at its lowest corner.
  [[gnu::always_inline]] void gather(const Places& places, const double* du, OfPoints* points) const {
    const auto at = [&](std::size_t a) __attribute__((always_inline)) { return load<Four>(du + corner_[a]); };
    const Four u_000 = at(0), u_100 = at(1), u_010 = at(2), u_110 = at(3);
    const Four u_001 = at(4), u_101 = at(5), u_011 = at(6), u_111 = at(7);
    const Four c_x = per_side * (u_100 - u_000), c_y = per_side * (u_010 - u_000), c_z = per_side * (u_001 - u_000);
    const Four c_xy = per_side * (u_110 - u_010) - c_x, c_yz = per_side * (u_011 - u_001) - c_y,
               c_zx = per_side * (u_101 - u_001) - c_x;
    const Four c_xyz = per_side * (u_111 - u_011 - u_101 + u_001) - c_xy;
    for (int g = 0; g < groups; ++g) {
      const int q = g * lanes;
      const Lanes X = load<Lanes>(places.xi + q), Y = load<Lanes>(places.eta + q), Z = load<Lanes>(places.zeta + q);
      const Lanes XY = X * Y, YZ = Y * Z, ZX = Z * X;
      Gradient& H = points[g].of;
      for (int d = 0; d < 3; ++d) {
        H[d][0] = c_x[d] + c_xy[d] * Y + c_zx[d] * Z + c_xyz[d] * YZ;
        H[d][1] = c_y[d] + c_xy[d] * X + c_yz[d] * Z + c_xyz[d] * ZX;
        H[d][2] = c_z[d] + c_zx[d] * X + c_yz[d] * Y + c_xyz[d] * XY;
      }
    }
  }

  // Forces of a cell's points with V P/s; R: at its lowest corner.
  [[gnu::always_inline]] void scatter(const Places& places, const OfPoints* points, double* R) const {
    Lanes of_x[3]{}, of_y[3]{}, of_z[3]{}, of_xy[3]{}, of_yz[3]{}, of_zx[3]{}, of_xyz[3]{};
    for (int g = 0; g < groups; ++g) {
      const int q = g * lanes;
      const Lanes X = load<Lanes>(places.xi + q), Y = load<Lanes>(places.eta + q), Z = load<Lanes>(places.zeta + q);
      const Lanes XY = X * Y, YZ = Y * Z, ZX = Z * X;
      for (int d = 0; d < 3; ++d) {
        const Lanes P_x = points[g].of[d][0], P_y = points[g].of[d][1], P_z = points[g].of[d][2];
        of_x[d] += P_x;
        of_y[d] += P_y;
        of_z[d] += P_z;
        of_xy[d] += P_x * Y + P_y * X;
        of_yz[d] += P_y * Z + P_z * Y;
        of_zx[d] += P_z * X + P_x * Z;
        of_xyz[d] += P_x * YZ + P_y * ZX + P_z * XY;
      }
    }
    const auto sum = [](const Lanes(&of)[3]) __attribute__((always_inline)) { return sums(of[0], of[1], of[2]); };
    const Four s_x = sum(of_x), s_y = sum(of_y), s_z = sum(of_z);
    const Four s_xy = sum(of_xy), s_yz = sum(of_yz), s_zx = sum(of_zx), s_xyz = sum(of_xyz);
    const auto add = [&](std::size_t a, const Four& force) __attribute__((always_inline)) {
      store(load<Four>(R + corner_[a]) + force, R + corner_[a]);
    };
    const Four x_y = s_xy - s_xyz, y_z = s_yz - s_xyz, z_x = s_zx - s_xyz;
    add(0, x_y + s_zx - s_x - s_y + s_yz - s_z);
    add(1, s_x - s_xy - z_x);
    add(2, s_y - s_xy - y_z);
    add(3, x_y);
    add(4, s_z - s_zx - y_z);
    add(5, z_x);
    add(6, y_z);
    add(7, s_xyz);
  }

  void commit() override { std::swap(committed_, trial_); }

  PointState point(std::size_t cell, int q) const override {
    const Places& places = places_[cell];
    const History& history = committed_[cell];
    PointState state{.place = {places.xi[q], places.eta[q], places.zeta[q]},
                     .volume = places.volume[q],
                     .stress = {},
                     .plastic_strain = history.plastic_strain[q]};
    for (std::size_t c = 0; c < 6; ++c) state.stress[c] = history.stress[c][q];
    return state;
  }
  void set_point(std::size_t cell, int q, const PointState& state) override {
    Places& places = places_[cell];
    places.xi[q] = state.place[0];
    places.eta[q] = state.place[1];
    places.zeta[q] = state.place[2];
    places.volume[q] = state.volume;
    for (std::size_t c = 0; c < 6; ++c) committed_[cell].stress[c][q] = state.stress[c];
    committed_[cell].plastic_strain[q] = state.plastic_strain;
  }

  std::vector<Places> places_;
  std::vector<History> committed_, trial_;
  std::vector<OfPoints> row_;          // H, and then V P/s, of a row of cells
  std::array<std::size_t, 8> corner_;  // from a cell's lowest corner
};

}  // namespace

std::unique_ptr<Yardstick> make_space() { return std::make_unique<Space>(24); }

}  // namespace yardsticks
