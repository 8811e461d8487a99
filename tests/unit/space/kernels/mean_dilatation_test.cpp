// phase.dilatation = "cells": the points of a cell share their change of volume.
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

TEST_CASE("the forces of averaged cells have no resultant and no moment about the deformed body") {
  for (const std::string law : {"hencky", "neo-hookean", "drucker-prager"}) {
    for (const std::string basis : {"linear", "quadratic"}) {
      for (const std::string points : {"9", "169"}) {  // 169 do not fit into a block of points
        CAPTURE(law, basis, points);
        std::vector<std::string> overrides =
            free_block({"material.rubber.law=" + law, "grid.basis=" + basis, "body.points_per_cell=" + points,
                        "mass.kind=lumped", "phase.dilatation=cells", "grid.cells=[2, 2]"});
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

TEST_CASE("a law with a potential keeps it: work done on averaged cells around a closed path is nothing") {
  const auto scene = scenes::load("block", free_block({"material.rubber.law=neo-hookean", "body.points_per_cell=4",
                                                       "grid.cells=[3, 3]", "phase.dilatation=cells"}));
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

TEST_CASE("what averaged cells cannot be is refused at its key") {
  using Catch::Matchers::Contains;
  CHECK_THAT(scenes::refusal("block", {"phase.dilatation=cells", "body.state=plane-stress"}),
             Contains("phase.dilatation") && Contains("nothing locks"));
  CHECK_THAT(scenes::refusal("block", {"phase={dilatation='cells', max_motion=0.1, deformation='positions'}",
                                       "material.rubber.law=hencky", "mass.kind=lumped"}),
             Contains("phase.deformation") && Contains("accumulated"));
  CHECK_THAT(scenes::refusal("block", {"phase.dilatation=mean"}), Contains("points") && Contains("cells"));
}
