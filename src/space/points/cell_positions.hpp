// The positions of the material points in a cell.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "geometry/gauss_rule.hpp"

namespace stillpoint {

/// The positions of n points in [−1, 1], ascending: those of Gauss–Legendre, or the middles of n equal parts.
inline std::vector<double> line_positions(Placement placement, int n) {
  const auto count = static_cast<std::size_t>(n);
  if (placement == Placement::gauss) return GaussRule(-1, 1, count).at;
  std::vector<double> xi(count);
  for (int k = 0; k < n; ++k) xi[static_cast<std::size_t>(k)] = (2.0 * k + 1) / n - 1;
  return xi;
}

/// The largest shift of each of these positions that stays within half the distance to its neighbours and between −1
/// and 1: for uniform positions half their spacing.
inline std::vector<double> line_room(const std::vector<double>& xi) {
  std::vector<double> room;
  for (std::size_t k = 0; k < xi.size(); ++k) {
    const double below = k == 0 ? xi[k] + 1 : (xi[k] - xi[k - 1]) / 2;
    const double above = k + 1 == xi.size() ? 1 - xi[k] : (xi[k + 1] - xi[k]) / 2;
    room.push_back(std::min(below, above));
  }
  return room;
}

/// The positions of the points of one cell in the cube [−1, 1]^Dim, the first coordinate running fastest.
template <int Dim>
class CellPositions {
 public:
  explicit CellPositions(const BodySpec& body)
      : random_(body.placement == Placement::random),
        jitter_(body.jitter),
        generator_(body.seed == 0 ? seed_of_zero : static_cast<std::uint32_t>(body.seed)) {
    int count = 1;
    for (int d = 0; d < Dim; ++d) count *= body.points_per_cell[static_cast<std::size_t>(d)];
    pattern_.resize(Dim, count);
    room_.resize(Dim, count);
    int stride = 1;
    for (int d = 0; d < Dim; ++d) {
      const int n = body.points_per_cell[static_cast<std::size_t>(d)];
      const std::vector<double> line = line_positions(body.placement, n), room = line_room(line);
      for (int p = 0; p < count; ++p) {
        const auto k = static_cast<std::size_t>(p / stride % n);
        pattern_(d, p) = line[k];
        room_(d, p) = room[k];
      }
      stride *= n;
    }
    xi_ = pattern_;
  }

  /// Whether every cell has different positions.
  bool vary() const { return random_ || jitter_ > 0; }

  /// The positions of the next cell, (Dim × count); called once a cell, in order.
  const Eigen::MatrixXd& next() {
    if (!vary()) return xi_;
    for (Eigen::Index p = 0; p < xi_.cols(); ++p) {
      for (int d = 0; d < Dim; ++d) {
        const double r = 2 * share() - 1;
        xi_(d, p) = random_ ? r : pattern_(d, p) + jitter_ * room_(d, p) * r;
      }
    }
    if (Dim == 1) std::sort(xi_.data(), xi_.data() + xi_.cols());  // points are numbered in order of position
    return xi_;
  }

 private:
  static constexpr std::uint32_t seed_of_zero = 4357;  // GSL's value, whose random numbers these are

  // A random number, uniform in (0, 1).
  double share() {
    constexpr double range = 4294967296.0;  // 2³²
    std::uint_fast32_t drawn = 0;
    while (drawn == 0) drawn = generator_();
    return static_cast<double>(drawn) / range;
  }

  bool random_;
  double jitter_;
  std::mt19937 generator_;
  Eigen::MatrixXd pattern_, room_, xi_;
};

}  // namespace stillpoint
