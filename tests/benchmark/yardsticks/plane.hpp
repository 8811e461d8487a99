// What steps in the plane have in common: points, and the law in plane strain. Two cells side by side, with four points
// each, are computed together, as eight lanes of which the first four are the points of the left one.
#pragma once

#include <utility>
#include <vector>

#include "block.hpp"
#include "lanes.hpp"

namespace yardsticks::plane {

constexpr double side = 0.05, per_side = 1 / side;
constexpr std::size_t stride = 2;

struct alignas(64) Places {
  double xi[together], eta[together], volume[together];
};
struct alignas(64) History {
  double stress[4][together];  // xx, yy, zz, xy
  double plastic_strain[together];
};

struct Gradient {
  Lanes xx, xy, yx, yy;
};

/// V P/s of the increment with gradient H, V/s being `volume`, for the points q … q + lanes − 1 of a pair of cells.
[[gnu::always_inline]] inline Gradient respond(const Gradient& H, const Lanes& volume, const History& before, int q,
                                               History& next) {
  const Lanes s_xx = load<Lanes>(before.stress[0] + q), s_yy = load<Lanes>(before.stress[1] + q),
              s_zz = load<Lanes>(before.stress[2] + q), s_xy = load<Lanes>(before.stress[3] + q);

  // σ + W σ − σ W + λ tr(D) I + 2 G D, with D and W the symmetric and the skew part of H
  constexpr double G = soil::shear;
  const Lanes w = 0.5 * (H.xy - H.yx), turned = 2 * w * s_xy, volumetric = soil::lambda * (H.xx + H.yy);
  Lanes xx = s_xx + turned + volumetric + 2 * G * H.xx;
  Lanes yy = s_yy - turned + volumetric + 2 * G * H.yy;
  Lanes zz = s_zz + volumetric;
  Lanes xy = s_xy + w * (s_yy - s_xx) + G * (H.xy + H.yx);

  // Onto the cone √J₂ + η p ≤ 0 along the deviator, after p > 0 is cut to 0
  const Lanes p_trial = (xx + yy + zz) * (1.0 / 3), p = smaller(p_trial, Lanes{});
  xx -= p_trial;
  yy -= p_trial;
  zz -= p_trial;
  const Lanes root_J2 = square_root(0.5 * (xx * xx + yy * yy + zz * zz) + xy * xy);
  const Lanes after = smaller(root_J2, -soil::eta * p), scale = after / (root_J2 + soil::tiny);
  xx = xx * scale + p;
  yy = yy * scale + p;
  zz = zz * scale + p;
  xy = xy * scale;
  store(xx, next.stress[0] + q);
  store(yy, next.stress[1] + q);
  store(zz, next.stress[2] + q);
  store(xy, next.stress[3] + q);
  store(load<Lanes>(before.plastic_strain + q) + (root_J2 - after) * (1 / G), next.plastic_strain + q);

  // P = σ cof f, f = I + H
  const Lanes f_xx = 1 + H.xx, f_yy = 1 + H.yy;
  return {.xx = volume * (xx * f_yy - xy * H.xy),
          .xy = volume * (xy * f_xx - xx * H.yx),
          .yx = volume * (xy * f_yy - yy * H.xy),
          .yy = volume * (yy * f_xx - xy * H.yx)};
}

/// Component i of the left and of the right cell, {left x, left y, right x, right y}, at their points q …
template <int i>
[[gnu::always_inline]] inline Lanes spread(const Four& of_cells, [[maybe_unused]] int q) {
#if defined(__AVX512F__)
  return __builtin_shufflevector(of_cells, of_cells, i, i, i, i, i + 2, i + 2, i + 2, i + 2);
#else
  return q < together / 2 ? __builtin_shufflevector(of_cells, of_cells, i, i, i, i)
                          : __builtin_shufflevector(of_cells, of_cells, i + 2, i + 2, i + 2, i + 2);
#endif
}

/// A component x and y of each point of two cells, which are summed over the points of each.
struct Pair {
  Lanes x[groups], y[groups];

  /// {left x, left y, right x, right y}
  [[gnu::always_inline]] Four of_cells() const {
#if defined(__AVX512F__)
    const Lanes two = __builtin_shufflevector(x[0], y[0], 0, 8, 2, 10, 4, 12, 6, 14) +
                      __builtin_shufflevector(x[0], y[0], 1, 9, 3, 11, 5, 13, 7, 15);
    return __builtin_shufflevector(two, two, 0, 1, 4, 5) + __builtin_shufflevector(two, two, 2, 3, 6, 7);
#else
    const Lanes left =
        __builtin_shufflevector(x[0], y[0], 0, 4, 2, 6) + __builtin_shufflevector(x[0], y[0], 1, 5, 3, 7);
    const Lanes right =
        __builtin_shufflevector(x[1], y[1], 0, 4, 2, 6) + __builtin_shufflevector(x[1], y[1], 1, 5, 3, 7);
    return __builtin_shufflevector(left, right, 0, 1, 4, 5) + __builtin_shufflevector(left, right, 2, 3, 6, 7);
#endif
  }
};

/// The forces of a row of functions, as pairs of cells add to them from left to right: functions 0, 1 of the left cell
/// are 1 past those of the right one.
[[gnu::always_inline]] inline Four one_further(const Four& before, const Four& now) {
  return __builtin_shufflevector(before, now, 2, 3, 4, 5);
}
[[gnu::always_inline]] inline void add(const Four& force, double* R) { store(load<Four>(R) + force, R); }

/// A block of 120 × 60 cells. A row of them is taken at a time: what is between its gather, law and scatter stays in
/// the first-level cache, and each of the three is a short loop, so that a processor has several cells in work and
/// waits for no root or quotient.
class PlaneBlock : public Block {
 public:
  std::size_t bytes_per_point() const final { return (sizeof(Places) + 3 * sizeof(History)) / together; }

 protected:
  static constexpr std::size_t pairs = 60;  // in a row

  explicit PlaneBlock(int degree)
      : Block({.dim = 2, .degree = degree, .cells = {2 * pairs, 60, 1}, .side = side, .stride = stride}),
        places_(grid_.cell_count() / 2),
        committed_(places_.size()),
        trial_(places_.size()),
        row_(groups * pairs) {
    fill();
  }

  /// Of a row of pairs of cells, whose places and lowest node's numbers are these: H of their points, by the increment.
  virtual void gather(const Places* places, const double* du, Gradient* H) const = 0;
  /// Adds the forces of their points to R.
  virtual void scatter(const Places* places, const Gradient* P, double* R) const = 0;

 private:
  void forces() final {
    for (int j = 0; j < grid_.cells[1]; ++j) {
      const std::size_t node = stride * grid_.node(0, j), first = static_cast<std::size_t>(j) * pairs;
      const Places* const places = &places_[first];
      gather(places, du_.data() + node, row_.data());
      for (std::size_t k = 0; k < pairs; ++k) {
        for (int g = 0; g < groups; ++g) {
          Gradient& of_points = row_[groups * k + static_cast<std::size_t>(g)];
          const int q = g * lanes;
          of_points = respond(of_points, per_side * load<Lanes>(places[k].volume + q), committed_[first + k], q,
                              trial_[first + k]);
        }
      }
      scatter(places, row_.data(), R_.data() + node);
    }
  }
  void commit() final { std::swap(committed_, trial_); }

  PointState point(std::size_t cell, int of_cell) const final {
    const std::size_t pair = cell / 2, q = cell % 2 * 4 + static_cast<std::size_t>(of_cell);
    const Places& places = places_[pair];
    const History& history = committed_[pair];
    PointState state{.place = {places.xi[q], places.eta[q], 0},
                     .volume = places.volume[q],
                     .stress = {},
                     .plastic_strain = history.plastic_strain[q]};
    for (std::size_t c = 0; c < 4; ++c) state.stress[c] = history.stress[c][q];
    return state;
  }
  void set_point(std::size_t cell, int of_cell, const PointState& state) final {
    const std::size_t pair = cell / 2, q = cell % 2 * 4 + static_cast<std::size_t>(of_cell);
    places_[pair].xi[q] = state.place[0];
    places_[pair].eta[q] = state.place[1];
    places_[pair].volume[q] = state.volume;
    for (std::size_t c = 0; c < 4; ++c) committed_[pair].stress[c][q] = state.stress[c];
    committed_[pair].plastic_strain[q] = state.plastic_strain;
  }

  std::vector<Places> places_;  // of pairs of cells, as the next two
  std::vector<History> committed_, trial_;
  std::vector<Gradient> row_;  // H, and then V P/s, of a row
};

}  // namespace yardsticks::plane
