// Loads that move with the body from phase to phase, class by class: the deformation is given, nothing is solved.
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "largest.hpp"
#include "space/boundary/boundary_conditions.hpp"
#include "space/grid/domain_basis.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/points/body.hpp"

using namespace stillpoint;
using Catch::Matchers::WithinAbs;
using stillpoint::test::free_block;

namespace {

struct Matrix {
  double xx, xy, yx, yy;
  Point<2> operator*(const Point<2>& a) const { return {xx * a[0] + xy * a[1], yx * a[0] + yy * a[1]}; }
  Matrix operator*(const Matrix& b) const {
    return {xx * b.xx + xy * b.yx, xx * b.xy + xy * b.yy, yx * b.xx + yy * b.yx, yx * b.xy + yy * b.yy};
  }
  Matrix cofactor() const { return {yy, -yx, -xy, xx}; }
};
Matrix rotation(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)};
}

struct Resultant {
  Point<2> force{};
  double moment = 0;  // about the origin

  void add(const Point<2>& at, const Point<2>& f) {
    for (std::size_t i = 0; i < 2; ++i) force[i] += f[i];
    moment += at[0] * f[1] - at[1] * f[0];
  }
};

/// The block [0.5, 1.75] × [0.25, 0.75] m of free_block() in cells of 0.25 m, with its loads.
template <AxisBasis B, Kinematics K>
class LoadedBlock {
  using Basis = TensorBasis<B, 2>;

 public:
  explicit LoadedBlock(Scene scene)
      : scene_(std::move(scene)),
        grid_(grid_at<2>(scene_, 0)),
        body_(make_body<K>(scene_, grid_, true)),
        loads_(make_boundary_conditions<K>(scene_, grid_, 1)) {
    begin_phase();
  }

  /// Each position goes to where(x), which is affine, and the next phase begins.
  void deform(const std::function<Point<2>(const Point<2>&)>& where) {
    const Point<2> origin = where({0, 0}), along_x = where({1, 0}), along_y = where({0, 1});
    const double det =
        (along_x[0] - origin[0]) * (along_y[1] - origin[1]) - (along_y[0] - origin[0]) * (along_x[1] - origin[1]);
    std::vector<double> u;
    for (int f = 0; f < Basis::count(grid_); ++f) {
      const Point<2> at = greville(f), to = where(at);
      for (std::size_t i = 0; i < 2; ++i) u.push_back(to[i] - at[i]);
    }
    for (const auto& load : loads_) load->end_phase(u.data());
    for (std::size_t p = 0; p < body_.points.size(); ++p) {
      const Point<2> to = where(body_.points.position(p));
      for (std::size_t i = 0; i < 2; ++i) body_.points.x[i][p] = to[i];
      body_.points.volume[p] *= det;
      for (std::size_t c = 0; B::window > 1 && c < 4; ++c) {
        const Point<2> corner = where({body_.points.corner[2 * c][p], body_.points.corner[2 * c + 1][p]});
        for (std::size_t i = 0; i < 2; ++i) body_.points.corner[2 * c + i][p] = corner[i];
      }
    }
    order_.sort(body_.points, grid_);
    begin_phase();
  }

  /// Of Σ_p V_p σ ∇N_ip with the same first row of σ everywhere and the nodal forces along x, over the largest of
  /// these.
  double imbalance(double stress_xx, double stress_xy) const {
    std::vector<double> F = constant_force_;
    for (const auto& load : loads_) load->add_load(parts(), 0, F);
    for (std::size_t k = 0; k < F.size(); ++k) {
      if (dofs_->free[k] % 2 == 1) F[k] = 0;
    }
    const double scale = largest_magnitude(F);
    for (std::size_t k = 0; k < body_.points.cells(); ++k) {
      for (std::size_t p = body_.points.begin(k); p < body_.points.end(k); ++p) {
        const double* dN = weights_.dN(k, p);
        for (int a = 0; a < Basis::per_cell; ++a) {
          const int dof = dofs_->number[static_cast<std::size_t>(2 * weights_.function(k, a))];
          const double force = stress_xx * dN[a] + stress_xy * dN[Basis::per_cell + a];
          F[static_cast<std::size_t>(dof)] -= body_.points.volume[p] * force;
        }
      }
    }
    return largest_magnitude(F) / scale;
  }

  /// Of the nodal forces: Σ F_i and Σ ξ_i × F_i.
  Resultant resultant() const {
    std::vector<double> F = constant_force_;
    const std::vector<double> u(held_size_, 0.0);
    for (const auto& load : loads_) load->add_load(parts(), 0, F);
    for (const auto& load : loads_) load->add_following_force(parts(), 0, u.data(), F);
    Resultant sum;
    for (std::size_t k = 0; k < F.size(); k += 2) sum.add(greville(dofs_->free[k] / 2), {F[k], F[k + 1]});
    return sum;
  }

 private:
  // Σ_i N_i(x) ξ_i = x: the mean of the p knots inside a function's support.
  Point<2> greville(int function) const {
    Point<2> at{};
    for (int d = 0; d < 2; ++d) {
      const Axis& axis = grid_.axes[static_cast<std::size_t>(d)];
      const int i = Basis::index_along(grid_, function, d);
      for (int k = 1; k <= B::degree; ++k) {
        const int node = std::clamp(i + k - B::degree, 0, axis.cells());
        at[static_cast<std::size_t>(d)] += axis.nodes[static_cast<std::size_t>(node)] / B::degree;
      }
    }
    return at;
  }
  void begin_phase() {
    weights_.rebuild(grid_, body_.points);
    const auto functions = static_cast<std::size_t>(Basis::count(grid_));
    std::vector<char> reached(functions, 0);
    for (std::size_t k = 0; k < body_.points.cells(); ++k) {
      for (int a = 0; a < Basis::per_cell; ++a) reached[static_cast<std::size_t>(weights_.function(k, a))] = 1;
    }
    held_size_ = 2 * functions;
    held_ = HeldUnknowns(held_size_, 0);
    dofs_.emplace(reached, 2, std::vector<int>{});
    node_mass_.assign(functions, 1);
    mass_.emplace(Mass::lumped(std::vector<double>(dofs_->size(), 1)));
    constant_force_.assign(dofs_->size(), 0);
    for (const auto& load : loads_) load->begin_phase(parts(), constant_force_);
  }
  PhaseParts<2> parts() const {
    return {grid_, functions_, body_.points, weights_, held_, *dofs_, node_mass_, *mass_, false};
  }

  const Scene scene_;
  Grid<2> grid_;
  const FunctionsOfBasis<B, 2> functions_{grid_};
  Body<K> body_;
  BoundaryConditions<2> loads_;
  PointOrder<2> order_;
  PointWeights<B, K> weights_;
  HeldUnknowns held_;
  std::size_t held_size_ = 0;
  std::optional<DegreesOfFreedom> dofs_;
  std::vector<double> node_mass_, constant_force_;
  std::optional<Mass> mass_;
};

Scene loaded(const std::string& points_per_cell, std::vector<std::string> loads) {
  loads.insert(loads.begin(), {"grid={min=[-1, -1.5], max=[3.5, 2.5], cells=[18, 16]}",
                               "body.points_per_cell=" + points_per_cell, "phase.max_motion=0.5"});
  return free_block(loads);
}

void check_equal(const Resultant& is, const Resultant& given) {
  CHECK_THAT(is.force[0], WithinAbs(given.force[0], 1e-12));
  CHECK_THAT(is.force[1], WithinAbs(given.force[1], 1e-12));
  CHECK_THAT(is.moment, WithinAbs(given.moment, 1e-12));
}

/// Stretched to 1.8 times its length in 40 phases, then turned once round in 50. check(F): in each of them.
template <AxisBasis B>
void stretch_and_turn(LoadedBlock<B, Kinematics::plane>& block, const std::function<void(const Matrix& F)>& check) {
  const Point<2> centre = {1.125, 0.5};
  Matrix F{1, 0, 0, 1};
  for (int phase = 0; phase < 90; ++phase) {
    CAPTURE(B::degree, phase);
    check(F);
    const Matrix f = phase < 40 ? Matrix{1.015, 0, 0, 0.995} : rotation(7.2);
    F = f * F;
    block.deform([&](const Point<2>& x) {
      const Point<2> turned = f * Point<2>{x[0] - centre[0], x[1] - centre[1]};
      return Point<2>{centre[0] + turned[0], centre[1] + turned[1]};
    });
  }
}
template <AxisBasis B>
std::string quadrature() {
  return B::window > 1 ? "phase.quadrature=domains" : "phase.quadrature=points";
}

/// A block under q along its right and left face that has been stretched by λ, sheared and shifted by shares of a cell.
template <AxisBasis B>
double largest_imbalance(const std::string& points_per_cell, double shear) {
  constexpr double q = 0.7;
  Largest largest;
  for (const double stretch : {0.4, 0.75, 1.0, 1.33, 1.7}) {
    for (int tenths = 0; tenths < 10; ++tenths) {
      LoadedBlock<B, Kinematics::plane> block(
          loaded(points_per_cell,
                 {quadrature<B>(), "traction=[{face='right', value=[0.7, 0]}, {face='left', value=[-0.7, 0]}]"}));
      block.deform([&](const Point<2>& x) {
        return Point<2>{stretch * x[0] + 0.025 * tenths, x[1] + shear * x[0] - 0.01 * tenths};
      });
      // σ = P Fᵀ/det F with P_xx = q alone, F = [λ 0; γ 1]: σ_xx = q, σ_xy = γ q/λ
      largest.take(block.imbalance(q, shear * q / stretch));
    }
  }
  return largest.value();
}

/// Where a position of the undeformed block is.
Point<2> image(const Matrix& F, const Point<2>& X) {
  const Point<2> moved = F * Point<2>{X[0] - 1.125, X[1] - 0.5};
  return {1.125 + moved[0], 0.5 + moved[1]};
}

template <AxisBasis B>
void check_dead_loads(const std::string& points_per_cell) {
  LoadedBlock<B, Kinematics::plane> block(
      loaded(points_per_cell,
             {quadrature<B>(), "traction=[{face='top', value=[0.2, -0.3]}, {face='right', value=['0.7*(1 + t)', 0.1]}]",
              "force=[{at=[0.6, 0.3], value=[0.4, '-0.9 - t']}, {at=[0.5, 0.75], value=[0, 1]}]"}));
  stretch_and_turn<B>(block, [&](const Matrix& F) {
    Resultant given;
    given.add(image(F, {1.125, 0.75}), {1.25 * 0.2, -1.25 * 0.3});
    given.add(image(F, {1.75, 0.5}), {0.5 * 0.7, 0.5 * 0.1});
    given.add(image(F, {0.6, 0.3}), {0.4, -0.9});
    given.add(image(F, {0.5, 0.75}), {0, 1});
    check_equal(block.resultant(), given);
  });
}

template <AxisBasis B>
void check_pressure(const std::string& points_per_cell) {
  LoadedBlock<B, Kinematics::plane> block(
      loaded(points_per_cell, {quadrature<B>(), "traction=[{face='right', pressure=0.3}]"}));
  stretch_and_turn<B>(block, [&](const Matrix& F) {
    const Point<2> area = F.cofactor() * Point<2>{0.5, 0};
    Resultant given;
    given.add(image(F, {1.75, 0.5}), {-0.3 * area[0], -0.3 * area[1]});
    check_equal(block.resultant(), given);
  });
}

}  // namespace

TEST_CASE("through phases the force and the moment of tractions and point forces are those given, to 1e-12") {
  for (const char* points : {"1", "4"}) {  // with one point a cell the stretched surface is often in a cell without any
    CAPTURE(points);
    check_dead_loads<BSpline<1>>(points);
    check_dead_loads<BSpline<2>>(points);
    check_dead_loads<BSpline<3>>(points);
    check_dead_loads<DomainBSpline<1>>(points);
    check_dead_loads<DomainBSpline<2>>(points);
    check_dead_loads<DomainBSpline<3>>(points);
  }
}

TEST_CASE("a deformed block is in equilibrium with its tractions wherever it cuts the cells, if points are domains") {
  for (const char* points : {"4", "9"}) {
    for (const double shear : {0.0, 0.1, -0.2}) {
      CAPTURE(points, shear);
      CHECK(largest_imbalance<DomainBSpline<1>>(points, shear) < 1e-12);
      CHECK(largest_imbalance<DomainBSpline<2>>(points, shear) < 1e-12);
      CHECK(largest_imbalance<DomainBSpline<3>>(points, shear) < 1e-12);
    }
    // At points alone the sums are off by that much of the largest nodal force: what domains are for.
    CHECK(largest_imbalance<BSpline<2>>(points, 0) > 0.05);
  }
}

TEST_CASE("through phases the force and the moment of a pressure are those on the deformed face, to 1e-12") {
  for (const char* points : {"1", "4"}) {
    CAPTURE(points);
    check_pressure<BSpline<1>>(points);
    check_pressure<BSpline<2>>(points);
    check_pressure<BSpline<3>>(points);
    check_pressure<DomainBSpline<1>>(points);
    check_pressure<DomainBSpline<2>>(points);
    check_pressure<DomainBSpline<3>>(points);
  }
}

TEST_CASE("through phases a ring bears a traction on its undeformed area and a pressure on its present one") {
  const auto check = []<AxisBasis B>(B) {
    const auto axial = [](const std::string& load) {
      LoadedBlock<B, Kinematics::axisymmetric> block(
          loaded("1", {"body.state=axisymmetric", "traction=[{face='top', " + load + "}]",
                       "grid={min=[0, -1.5], max=[3.5, 2.5], cells=[14, 16]}"}));
      for (int phase = 0; phase < 40; ++phase)
        block.deform([](const Point<2>& x) { return Point<2>{1.012 * x[0], 1.01 * x[1]}; });
      return block.resultant().force[1];
    };
    const double area = std::numbers::pi * (1.75 * 1.75 - 0.5 * 0.5), stretch = std::pow(1.012, 40);
    CHECK(axial("value=[0, 0.3]") == Approx(0.3 * area).epsilon(1e-12));
    CHECK(axial("pressure=0.3") == Approx(-0.3 * area * stretch * stretch).epsilon(1e-12));
  };
  check(BSpline<1>{});
  check(BSpline<2>{});
  check(BSpline<3>{});
}
