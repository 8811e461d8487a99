#include "space/boundary/way_since_placed.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/throw_scene_error.hpp"
#include "space/kernels/change_of_volume.hpp"
#include "space/points/carried_body.hpp"
#include "space/points/point_order.hpp"
#include "space/points/points_around.hpp"

namespace stillpoint {
namespace {

/// Of one body.
template <Kinematics K>
class Way {
  static constexpr int dim = dimensions(K);

 public:
  /// b: its place among those that are carried on.
  Way(const CarriedBodyOf<K>& carried, std::size_t b, const Grid<dim>& grid)
      : grid_(grid), around_(grid_, placed_, nullptr) {
    std::tie(placed_, u_) = carried.ways_of(b);
    placed_.material_begin = {0, static_cast<int>(placed_.size())};
    PointOrder<dim> order;
    order.sort(placed_, grid);
    std::vector<double> work;
    for (auto& along : u_) order.order().apply(along, work);
  }
  Way(const Way&) = delete;  // its parts know where its points are
  Way& operator=(const Way&) = delete;

  WaySincePlaced<dim> at(const Point<dim>& X) const {
    constexpr double step = 0.1;  // [cells]
    const Point<dim> h = cell_at(X);
    refuse_if_far(X, h);
    WaySincePlaced<dim> at{.u = displacement(X), .area_factor = {1}};
    if constexpr (dim > 1) {
      TensorOf<K> H{};
      for (std::size_t j = 0; j < dim; ++j) {
        Point<dim> ahead = X, behind = X;
        ahead[j] += step * h[j], behind[j] -= step * h[j];
        const Point<dim> u_ahead = displacement(ahead), u_behind = displacement(behind);
        for (std::size_t i = 0; i < dim; ++i) H[dim * i + j] = (u_ahead[i] - u_behind[i]) / (2 * step * h[j]);
      }
      if constexpr (K == Kinematics::axisymmetric) H[dim * dim] = X[0] > 0 ? at.u[0] / X[0] : H[0];
      const TensorOf<K> cofactor = ChangeOfVolume<K>::cofactor(plus_identity<K>(H));
      std::copy_n(cofactor.begin(), dim * dim, at.area_factor.begin());
    }
    return at;
  }

 private:
  Point<dim> cell_at(const Point<dim>& X) const {
    const auto cell = grid_.cell_of(X);
    Point<dim> h;
    for (std::size_t d = 0; d < dim; ++d) {
      const auto& nodes = grid_.axes[d].nodes;
      const auto c = static_cast<std::size_t>(cell[d]);
      h[d] = nodes[c + 1] - nodes[c];
    }
    return h;
  }
  void refuse_if_far(const Point<dim>& X, const Point<dim>& h) const {
    constexpr double furthest = 1.5;  // [cells]
    const Point<dim> nearest = around_.nearest(X).x;
    for (std::size_t d = 0; d < dim; ++d) {
      if (std::abs(nearest[d] - X[d]) <= furthest * h[d]) continue;
      throw_scene_error("initial.from",
                        fmt::format("the other run placed no material point near ({:.6g}), on the border of a body "
                                    "that is loaded or may be touched there; expected bodies of the same shape in both",
                                    fmt::join(X, ", ")));
    }
  }
  Point<dim> displacement(const Point<dim>& X) const {
    Point<dim> u{};
    for (const auto& [point, weight] : around_.fit(X, /*degree=*/2))
      for (std::size_t d = 0; d < dim; ++d) u[d] += weight * u_[d][point.p];
    return u;
  }

  const Grid<dim>& grid_;
  MaterialPoints<dim> placed_;              // where the points were placed
  std::array<std::vector<double>, dim> u_;  // of each of them [m]
  PointsAround<dim> around_;
};

template <Kinematics K>
class Ways final : public WaysSincePlaced<dimensions(K)> {
  static constexpr int dim = dimensions(K);

 public:
  Ways(const Problem& problem, const CarriedBodyOf<K>& carried, const Grid<dim>& grid)
      : problem_(problem), carried_(carried), grid_(grid), of_bodies_(problem.bodies.size()) {}

  std::optional<WaySincePlaced<dim>> at(std::size_t body, const Point<dim>& X) const override {
    const auto b = carried_.find(problem_.bodies[body]);
    if (!b) return std::nullopt;
    if (!of_bodies_[body]) of_bodies_[body] = std::make_unique<const Way<K>>(carried_, *b, grid_);
    return of_bodies_[body]->at(X);
  }
  bool in_place() const override { return carried_.is_in_place(); }

 private:
  const Problem& problem_;
  const CarriedBodyOf<K>& carried_;
  const Grid<dim>& grid_;
  mutable std::vector<std::unique_ptr<const Way<K>>> of_bodies_;  // made on demand
};

}  // namespace

template <Kinematics K>
std::unique_ptr<const WaysSincePlaced<dimensions(K)>> ways_since_placed(const Problem& problem,
                                                                        const CarriedBodyOf<K>& carried,
                                                                        const Grid<dimensions(K)>& grid) {
  return std::make_unique<const Ways<K>>(problem, carried, grid);
}

template std::unique_ptr<const WaysSincePlaced<1>> ways_since_placed(const Problem&,
                                                                     const CarriedBodyOf<Kinematics::line>&,
                                                                     const Grid<1>&);
template std::unique_ptr<const WaysSincePlaced<2>> ways_since_placed(const Problem&,
                                                                     const CarriedBodyOf<Kinematics::plane>&,
                                                                     const Grid<2>&);
template std::unique_ptr<const WaysSincePlaced<2>> ways_since_placed(const Problem&,
                                                                     const CarriedBodyOf<Kinematics::axisymmetric>&,
                                                                     const Grid<2>&);
template std::unique_ptr<const WaysSincePlaced<3>> ways_since_placed(const Problem&,
                                                                     const CarriedBodyOf<Kinematics::space>&,
                                                                     const Grid<3>&);

}  // namespace stillpoint
