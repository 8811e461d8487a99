// The pattern in which material points lie in a cell.
#pragma once

#include <stillpoint/scene.hpp>

#include <algorithm>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_rng.h>

namespace stillpoint {

/// Places of n points in [−1, 1], ascending: Gauss-Legendre's, or in the middles of n equal parts.
inline std::vector<double> line_positions(Placement placement, int n) {
  std::vector<double> xi(static_cast<std::size_t>(n));
  if (placement == Placement::gauss) {
    const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> table(
        gsl_integration_glfixed_table_alloc(xi.size()), gsl_integration_glfixed_table_free);
    for (std::size_t k = 0; k < xi.size(); ++k) {
      double weight = 0;
      gsl_integration_glfixed_point(-1, 1, k, &xi[k], &weight, table.get());
    }
  } else {
    for (int k = 0; k < n; ++k) xi[static_cast<std::size_t>(k)] = (2.0 * k + 1) / n - 1;
  }
  return xi;
}

/// How far each of these positions may move without coming nearer to a neighbour's than half the way, or past −1 or 1:
/// half the spacing of uniform positions.
inline std::vector<double> line_room(const std::vector<double>& xi) {
  std::vector<double> room;
  for (std::size_t k = 0; k < xi.size(); ++k) {
    const double below = k == 0 ? xi[k] + 1 : (xi[k] - xi[k - 1]) / 2;
    const double above = k + 1 == xi.size() ? 1 - xi[k] : (xi[k + 1] - xi[k]) / 2;
    room.push_back(std::min(below, above));
  }
  return room;
}

/// Places of one cell's points in the cube [−1, 1]^Dim, the first coordinate running fastest.
template <int Dim>
class CellPositions {
 public:
  explicit CellPositions(const BodySpec& body)
      : random_(body.placement == Placement::random),
        jitter_(body.jitter),
        rng_(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free) {
    gsl_rng_set(rng_.get(), body.seed);
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

  /// Whether every cell has positions of its own.
  bool vary() const { return random_ || jitter_ > 0; }

  /// (Dim × count); asked once a cell, in order.
  const Eigen::MatrixXd& next() {
    if (!vary()) return xi_;
    for (Eigen::Index p = 0; p < xi_.cols(); ++p) {
      for (int d = 0; d < Dim; ++d) {
        const double r = 2 * gsl_rng_uniform_pos(rng_.get()) - 1;
        xi_(d, p) = random_ ? r : pattern_(d, p) + jitter_ * room_(d, p) * r;
      }
    }
    if (Dim == 1) std::sort(xi_.data(), xi_.data() + xi_.cols());  // points are numbered in order of position
    return xi_;
  }

 private:
  bool random_;
  double jitter_;
  std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> rng_;
  Eigen::MatrixXd pattern_, room_, xi_;
};

}  // namespace stillpoint
