// phase.dilatation = "cells", "splines": points share their change of volume, those of a cell or of neighbouring ones.
#include <stillpoint/stillpoint.hpp>

#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "largest.hpp"
#include "scenes.hpp"
#include "statics.hpp"

using namespace stillpoint;

namespace {

std::vector<double> wavy(std::size_t n, double scale) {
  std::vector<double> u(n);
  for (std::size_t i = 0; i < n; ++i) u[i] = scale * std::sin(static_cast<double>(i * i + 1));
  return u;
}

std::vector<std::string> free_block(std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"support=[]", "traction=[]", "probe=[]", "damping.c=1.0"});
  return overrides;
}

/// ‖u − u_exact‖/‖u_exact‖ of Lamé's cylinder.
double cylinder_error(double nu, const std::string& dilatation, int cells) {
  const Scene scene =
      scenes::load("cylinder", {fmt::format("constants.nu={}", nu), fmt::format("grid.cells=[{}, 2]", cells),
                                "phase.dilatation=" + dilatation, "solve.method=newton", "stop.residual=1e-7"});
  const Summary summary = run(scene);
  REQUIRE(summary.error);
  return summary.error->u_rel_l2;
}

}  // namespace

TEST_CASE("a thick cylinder of incompressible material does not lock if its cells share their change of volume") {
  for (const double nu : {0.4999, 0.499999}) {
    CAPTURE(nu);
    CHECK(cylinder_error(nu, "points", 8) > 0.5);  // with linear cells of four points
    const double coarse = cylinder_error(nu, "cells", 8), fine = cylinder_error(nu, "cells", 16);
    CHECK(fine < 1e-3);
    CHECK(std::log2(coarse / fine) > 1.9);  // the order of the basis is 2
  }
  // Where nothing locks nothing is lost.
  CHECK(cylinder_error(0.3, "cells", 16) < 1.5 * cylinder_error(0.3, "points", 16));
}

TEST_CASE("the points of a cell have the same pressure rate: a linear body's mean stress is uniform in each cell") {
  const auto scene = scenes::load("block", free_block({"material.rubber.law=linear-elastic", "body.points_per_cell=9",
                                                       "grid.cells=[1, 1]", "phase.dilatation=cells"}));
  const auto phase = make_phase(scene);
  const auto stress = statics::point_stress(*phase, wavy(phase->size(), 0.1));
  Largest off, all;
  for (std::size_t k = 0; k < stress.size(); k += 4) {
    off.take_magnitude(stress[k] + stress[k + 1] - stress[0] - stress[1]);
    all.take_magnitude(stress[k] - stress[0]);
  }
  CHECK(off.value() < 1e-15);
  CHECK(all.value() > 1e-3);  // what is not a change of volume is each point's own
}

TEST_CASE("the forces of averaged points have no resultant and no moment about the deformed body") {
  const std::vector<std::pair<std::string, std::string>> shared = {
      {"linear", "cells"}, {"quadratic", "cells"}, {"quadratic", "splines"}, {"cubic", "splines"}};
  for (const std::string law : {"hencky", "neo-hookean", "drucker-prager"}) {
    for (const auto& [basis, dilatation] : shared) {
      for (const std::string points : {"9", "169"}) {  // 169 do not fit into a block of points
        CAPTURE(law, basis, dilatation, points);
        std::vector<std::string> overrides =
            free_block({"material.rubber.law=" + law, "grid.basis=" + basis, "body.points_per_cell=" + points,
                        "mass.kind=lumped", "phase.dilatation=" + dilatation, "grid.cells=[2, 2]"});
        if (law == "drucker-prager")
          overrides.insert(overrides.end(),
                           {"material.rubber.phi=35", "material.rubber.c=0.1", "phase.max_motion=none"});
        Scene scene = scenes::load("block", overrides);
        const auto phase = make_phase(scene);
        // x of each function as the displacement (x, 0), and y likewise
        const auto coordinate = [&](const char* axis) {
          scene.initial_u = {Expression(axis, {}, "xy"), Expression(axis, {}, "xy")};
          return make_phase(scene)->initial_displacement(0);
        };
        const std::vector<double> x = coordinate("x"), y = coordinate("y");
        const std::vector<double> u = wavy(phase->size(), 0.02), R = statics::internal_force(*phase, u);
        double sum_x = 0, sum_y = 0, moment = 0, scale = 0;
        for (std::size_t i = 0; i < R.size(); i += 2) {
          sum_x += R[i];
          sum_y += R[i + 1];
          moment += (x[i] + u[i]) * R[i + 1] - (y[i] + u[i + 1]) * R[i];
          scale += std::abs(R[i]) + std::abs(R[i + 1]);
        }
        CHECK(std::abs(sum_x) < 1e-13 * scale);
        CHECK(std::abs(sum_y) < 1e-13 * scale);
        CHECK(std::abs(moment) < 1e-12 * scale);  // of fitted coordinates
      }
    }
  }
}

TEST_CASE("a law with a potential keeps it: work done on averaged points around a closed path is nothing") {
  const auto [basis, dilatation] = GENERATE(table<std::string, std::string>(
      {{"linear", "cells"}, {"quadratic", "splines"}, {"cubic", "splines"}, {"hermite", "splines"}}));
  CAPTURE(basis, dilatation);
  const auto scene =
      scenes::load("block", free_block({"material.rubber.law=neo-hookean", "body.points_per_cell=4", "mass.kind=lumped",
                                        "grid.cells=[3, 3]", "grid.basis=" + basis, "phase.dilatation=" + dilatation}));
  const auto phase = make_phase(scene);
  const std::size_t n = phase->size();
  // u = 0.05 (a cos θ + b sin θ): ∮ R·du by the trapezoidal rule, which is exact on a closed path but for rounding
  const std::vector<double> a = wavy(n, 0.05);
  std::vector<double> b(n), u(n);
  for (std::size_t i = 0; i < n; ++i) b[i] = 0.05 * std::cos(static_cast<double>(3 * i * i + 2));
  constexpr int steps = 64;
  double work = 0, scale = 0;
  for (int k = 0; k < steps; ++k) {
    const double angle = 2 * M_PI * k / steps;
    for (std::size_t i = 0; i < n; ++i) u[i] = a[i] * std::cos(angle) + b[i] * std::sin(angle);
    const std::vector<double> R = statics::internal_force(*phase, u);
    double power = 0;
    for (std::size_t i = 0; i < n; ++i) power += R[i] * (b[i] * std::cos(angle) - a[i] * std::sin(angle));
    work += power * 2 * M_PI / steps;
    scale += std::abs(power) * 2 * M_PI / steps;
  }
  REQUIRE(scale > 1e-4);
  CHECK(std::abs(work) < 1e-10 * scale);
}

TEST_CASE(
    "means over splines keep a cubic basis' order and error where nearly incompressible material bears pressure") {
  // A pressure of 2 B k² μ beside shear of the same size, on a square that is held all round; see the scene.
  const auto error = [](const std::string& basis, const std::string& nu, const std::string& dilatation, int cells) {
    const Scene scene =
        scenes::load("ladder/pressed_square", {fmt::format("grid.cells=[{0}, {0}]", cells), "grid.basis=" + basis,
                                               "constants.nu=" + nu, "phase.dilatation=" + dilatation});
    const Summary summary = run(scene);
    REQUIRE(summary.error);
    return summary.error->u_rel_l2;
  };
  for (const std::string basis : {"cubic", "hermite"}) {
    CAPTURE(basis);
    const double coarse = error(basis, "0.4999", "splines", 8), fine = error(basis, "0.4999", "splines", 12);
    CHECK(std::log(coarse / fine) / std::log(1.5) > 3.8);  // of 4
    // No better can it be than where nothing locks and nothing is shared.
    CHECK(fine < 1.25 * error(basis, "0.3", "points", 12));
    // Means over cells have two orders less, and points lock.
    CHECK(error(basis, "0.4999", "cells", 12) > 10 * fine);
    CHECK(error(basis, "0.4999", "points", 12) > 5 * fine);
  }
  // Where the pressure counts as much as the shear, what a mean misses is of the order 2 p in place of 2.
  CHECK(error("cubic", "0.3", "splines", 12) < 0.3 * error("cubic", "0.3", "cells", 12));
  CHECK(error("cubic", "0.3", "splines", 8) > 5 * error("cubic", "0.3", "splines", 12));  // order 4
  CHECK(error("quadratic", "0.4999", "splines", 12) < 1.05 * error("quadratic", "0.3", "points", 12));
}

TEST_CASE("means over splines keep constants and are a projection's equal: self-adjoint, with norm 1") {
  // A uniform change of volume leaves each point with its own; the quadratic form of the forces is then no larger than
  // that of points by themselves, nor smaller than 0, and symmetric.
  const auto phase_of = [](const std::string& dilatation) {
    return make_phase(scenes::load(
        "block",
        free_block({"material.rubber={law='linear-elastic', E=1, nu=0.45, rho=1}", "body.points_per_cell=9",
                    "grid.cells=[5, 4]", "grid.basis=cubic", "mass.kind=lumped", "phase.dilatation=" + dilatation})));
  };
  const auto shared = phase_of("splines"), own = phase_of("points");
  const std::size_t n = own->size();
  Scene scene = scenes::load("block", free_block({"grid.cells=[5, 4]", "grid.basis=cubic", "mass.kind=lumped"}));
  scene.initial_u = {Expression("0.01*x", {}, "xy"), Expression("0.01*y", {}, "xy")};
  const std::vector<double> swelling = make_phase(scene)->initial_displacement(0);
  const auto of_swelling = statics::internal_force(*shared, swelling),
             as_before = statics::internal_force(*own, swelling);
  const auto work = [](const std::vector<double>& R, const std::vector<double>& u) {
    double sum = 0;
    for (std::size_t i = 0; i < u.size(); ++i) sum += R[i] * u[i];
    return sum;
  };
  CHECK(work(of_swelling, swelling) == Approx(work(as_before, swelling)).epsilon(1e-12));
  for (int k = 0; k < 5; ++k) {
    std::vector<double> u(n), w(n);
    for (std::size_t i = 0; i < n; ++i) {
      u[i] = std::sin(static_cast<double>(i * i + 7 * static_cast<std::size_t>(k) + 1));
      w[i] = std::cos(static_cast<double>(3 * i * i + 5 * static_cast<std::size_t>(k)));
    }
    const auto Ru = statics::internal_force(*shared, u), Rw = statics::internal_force(*shared, w);
    CHECK(work(Ru, w) == Approx(work(Rw, u)).epsilon(1e-10));
    CHECK(work(Ru, u) > 0);
    CHECK(work(Ru, u) < work(statics::internal_force(*own, u), u));
  }
}

TEST_CASE("means over splines of a linear basis are those of its cells, to the bit") {
  const auto force = [](const std::string& dilatation) {
    const auto phase = make_phase(scenes::load("block", free_block({"phase.dilatation=" + dilatation})));
    return statics::internal_force(*phase, wavy(phase->size(), 0.01));
  };
  const auto cells = force("cells");
  REQUIRE(!cells.empty());
  CHECK(force("splines") == cells);
  CHECK(force("points") != cells);
}

TEST_CASE("what averaged cells cannot be is refused at its key") {
  using Catch::Matchers::Contains;
  CHECK_THAT(scenes::refusal("block", {"phase.dilatation=cells", "body.state=plane-stress"}),
             Contains("phase.dilatation") && Contains("nothing locks"));
  CHECK_THAT(scenes::refusal("block", {"phase={dilatation='cells', max_motion=0.1, deformation='positions'}",
                                       "material.rubber.law=hencky", "mass.kind=lumped"}),
             Contains("phase.deformation") && Contains("accumulated"));
  CHECK_THAT(scenes::refusal("block", {"phase.dilatation=mean"}),
             Contains("points") && Contains("cells") && Contains("splines"));
}
