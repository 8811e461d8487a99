#include <stillpoint/material_points.hpp>
#include <stillpoint/moment_fit.hpp>

#include <algorithm>
#include <limits>
#include <memory>

#include <gsl/gsl_integration.h>
#include <gsl/gsl_rng.h>

namespace stillpoint {
namespace {

// Places of n points in [−1, 1], by rule.
std::vector<double> axis_places(Placement placement, int n) {
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

// Places of one cell's points in the cube [−1, 1]^Dim, (Dim × count); asked once a cell, since random ones differ.
template <int Dim>
class CellPlaces {
 public:
  explicit CellPlaces(const BodySpec& body)
      : random_(body.placement == Placement::random), rng_(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free) {
    gsl_rng_set(rng_.get(), body.seed);
    int count = 1;
    for (int d = 0; d < Dim; ++d) count *= body.points_per_cell[static_cast<std::size_t>(d)];
    xi_.resize(Dim, count);
    int stride = 1;
    for (int d = 0; d < Dim; ++d) {
      const int n = body.points_per_cell[static_cast<std::size_t>(d)];
      const std::vector<double> axis = axis_places(body.placement, n);
      for (int p = 0; p < count; ++p) xi_(d, p) = axis[static_cast<std::size_t>(p / stride % n)];
      stride *= n;
    }
  }
  const Eigen::MatrixXd& next() {
    if (random_) {
      for (Eigen::Index p = 0; p < xi_.cols(); ++p) {
        for (int d = 0; d < Dim; ++d) xi_(d, p) = 2 * gsl_rng_uniform_pos(rng_.get()) - 1;
      }
      if (Dim == 1) std::sort(xi_.data(), xi_.data() + xi_.cols());  // points are numbered in order of place
    }
    return xi_;
  }

 private:
  bool random_;
  std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> rng_;
  Eigen::MatrixXd xi_;
};

}  // namespace

template <int Dim>
PlacedBody<Dim> place_body(const BodySpec& body, const Grid<Dim>& grid, double density, StressState) {
  PlacedBody<Dim> placed;
  MaterialPoints<Dim>& points = placed.points;
  CellPlaces<Dim> places(body);
  MomentFit fit;
  bool fitted = false;
  placed.quadrature.degree = std::numeric_limits<int>::max();

  for (int number = 0; number < grid.cells(); ++number) {
    // The part of the cell that the body's box covers; slivers of rounding are none.
    const auto cell = grid.cell_at(number);
    Point<Dim> low, high;
    double size = 1, smallest_share = 1;
    bool covered = true;
    for (int d = 0; d < Dim; ++d) {
      const double a = grid.axes[d].nodes[cell[d]], b = grid.axes[d].nodes[cell[d] + 1];
      low[d] = std::max(a, body.min[d]);
      high[d] = std::min(b, body.max[d]);
      const double share = (high[d] - low[d]) / (b - a);
      covered = covered && share > 1e-12;
      if (share > 0) smallest_share = std::min(smallest_share, share);
      size *= high[d] - low[d];
    }
    if (!covered) continue;
    placed.quadrature.smallest_share = std::min(placed.quadrature.smallest_share, smallest_share);

    const Eigen::MatrixXd& xi = places.next();
    if (!fitted || body.placement == Placement::random) {
      fit = body.volumes == VolumeRule::consistent ? fit_moments(xi) : equal_weights(xi);
      fitted = true;
    }
    placed.quadrature.degree = std::min(placed.quadrature.degree, fit.degree);
    placed.quadrature.cells_limited_by_sign += fit.limited_by_sign ? 1 : 0;

    points.cell.push_back(number);
    points.cell_begin.push_back(static_cast<int>(points.size()));
    for (Eigen::Index p = 0; p < xi.cols(); ++p) {
      for (int d = 0; d < Dim; ++d) points.x[d].push_back(low[d] + 0.5 * (1 + xi(d, p)) * (high[d] - low[d]));
      points.volume.push_back(fit.weights(p) * size * body.area);
      points.mass.push_back(points.volume.back() * density);
    }
  }
  points.cell_begin.push_back(static_cast<int>(points.size()));
  return placed;
}

template PlacedBody<1> place_body<1>(const BodySpec&, const Grid<1>&, double, StressState);
template PlacedBody<2> place_body<2>(const BodySpec&, const Grid<2>&, double, StressState);

}  // namespace stillpoint
