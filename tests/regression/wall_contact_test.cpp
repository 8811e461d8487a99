// Walls that push a block and never pull it, with and without friction: problems/block_on_wall.toml.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "driven.hpp"
#include "largest.hpp"
#include "scenes.hpp"
#include "slab.hpp"
#include "statics.hpp"

using namespace stillpoint;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double gravity = 9.81, block_weight = 1000 * 0.5 * gravity;  // ρ A g [N/m]

Scene block_on_wall(const std::vector<std::string>& overrides) { return scenes::load("block_on_wall", overrides); }

/// The block pushed from the left by a wall with this motion, floating.
Scene pushed_by_wall(const std::string& motion, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.end(),
                   {"wall=[{name='ram', face='left', motion='" + motion + "'}]", "body_force={value=[0, 0]}"});
  return block_on_wall(overrides);
}

}  // namespace

TEST_CASE("a wall bears the weight of what rests on it") {
  driven::Motion motion(block_on_wall({"constants.theta=0"}));
  motion.run_to(0.5);
  CHECK_THAT(motion.wall().normal, WithinRel(block_weight, 1e-9));
  CHECK_THAT(motion.wall().shear[0], WithinAbs(0, 1e-9 * block_weight));
}

TEST_CASE("a wall never pulls: a block that is drawn away from it falls freely, and the wall feels exactly nothing") {
  driven::Motion motion(block_on_wall({"body_force.value=[0, 9.81]", "damping={strategy='none'}"}));
  Largest largest;
  int steps = 0;
  motion.run_to(0.1, [&] {
    if (++steps == 1) return;
    largest.take_magnitude(motion.wall().normal);
    largest.take_magnitude(motion.wall().shear[0]);
  });
  CHECK(largest.value() == 0);
  CAPTURE(motion.mean_velocity(1) / (gravity * 0.1) - 1);
  // The wall holds its nodes, an eighth of the block, until it finds at the end of the first step that they pull.
  CHECK_THAT(motion.mean_velocity(1), WithinRel(gravity * 0.1, 0.005));
}

TEST_CASE("a block stays on a slope that is flatter than its friction, which bears the slope's share of the weight") {
  for (const std::string friction : {"0.5", "rough"}) {
    CAPTURE(friction);
    driven::Motion motion(block_on_wall({"wall[0].friction=" + friction}));
    motion.run_to(0.5);
    CHECK_THAT(motion.wall().normal, WithinRel(block_weight * std::cos(0.4), 1e-9));
    CHECK_THAT(motion.wall().shear[0], WithinRel(block_weight * std::sin(0.4), 1e-9));
    CHECK(largest_magnitude(motion.v()) < 1e-9);
    CHECK(largest_magnitude(motion.u()) < 0.01);
  }
}

TEST_CASE("a block slides down a slope that is steeper than its friction with a = g (sin theta - mu cos theta)") {
  for (const double mu : {0.0, 0.2, 0.35}) {
    CAPTURE(mu);
    driven::Motion motion(block_on_wall({"constants.mu=" + std::to_string(mu), "damping={strategy='none'}"}));
    motion.run_to(0.5);
    // Nothing damps the waves that the sudden weight sends through it: while it is slow, nodes stick now and then, or
    // leave the wall for a moment.
    const double friction = gravity * mu * std::cos(0.4) * 0.5, expected = gravity * std::sin(0.4) * 0.5 - friction;
    CAPTURE((expected - motion.mean_velocity(0)) / friction);
    CHECK_THAT(motion.mean_velocity(0), WithinAbs(expected, 0.07 * friction + 1e-9));
  }
}

TEST_CASE("a damped block that slides in space, however slowly, bears its friction at every instant to two per cent") {
  constexpr double mu = 0.3;
  for (const char* c : {"20", "200", "2000"}) {
    for (const char* method : {"leapfrog", "symplectic-euler", "erk:rk4"}) {
      CAPTURE(c, method);
      Scene scene = scenes::slab(block_on_wall({"wall[0].friction=0.3", std::string("damping.c=") + c,
                                                std::string("integrator.method=") + method, "grid.cells=[16, 4]"}),
                                 2);
      scene.supports.clear();
      scene.grid.cells.back() = 4;
      driven::Motion motion(scene);
      double least = mu, most = 0;
      motion.run_to(0.3, [&] {
        if (motion.t() < 0.1) return;
        const WallReaction wall = motion.wall();
        const double share = std::hypot(wall.shear[0], wall.shear[1]) / wall.normal;
        least = std::min(least, share), most = std::max(most, share);
      });
      CHECK(least >= 0.98 * mu);  // 0.65 where the way of the last step counts
      CHECK(most <= mu * (1 + 1e-12));
      CHECK(motion.mean_velocity(0) > 0);
    }
  }
}

TEST_CASE("a rough wall holds a block on a slope on which any less friction lets it slide") {
  const auto speed = [](const std::string& friction) {
    driven::Motion motion(block_on_wall({"constants.theta=pi/4", "wall[0].friction=" + friction}));
    motion.run_to(0.5);
    return motion.mean_velocity(0);
  };
  CHECK_THAT(speed("rough"), WithinAbs(0, 1e-9));
  CHECK(speed("0.8") > 0.01);  // against viscous damping, v → g (sin θ − μ cos θ)/c = 0.014 by and by
}

TEST_CASE("a block that slides through many phases is slowed by the same friction") {
  const Summary s =
      run(block_on_wall({"constants.mu=0.2", "damping={strategy='none'}", "phase.max_motion=0.3", "stop.time=0.4"}));
  CHECK(s.phases > 3);
  const double expected = gravity * (std::sin(0.4) - 0.2 * std::cos(0.4)) * 0.4;
  CAPTURE(scenes::probe(s, "middle", "v.x") / expected - 1);
  CHECK_THAT(scenes::probe(s, "middle", "v.x"), WithinRel(expected, 0.05));
}

TEST_CASE("a wall that moves pushes a block at its own speed, with the force that the damping takes") {
  driven::Motion motion(pushed_by_wall("0.1*t"));
  motion.run_to(0.5);
  for (std::size_t i = 0; i < motion.v().size(); i += 2) CHECK_THAT(motion.v()[i], WithinAbs(0.1, 1e-6));
  CHECK_THAT(motion.wall().normal, WithinRel(100 * 500 * 0.1, 1e-5));  // c m w
  CHECK_THAT(motion.wall().power, WithinRel(100 * 500 * 0.1 * 0.1, 1e-5));
}

TEST_CASE("a block that was pushed flies on when the wall stops, and the wall feels exactly nothing of it") {
  driven::Motion motion(pushed_by_wall("t<0.1 ? 5*t^2 : 0.05 + 0*t", {"damping={strategy='none'}"}));
  motion.run_to(0.2);
  CHECK_THAT(motion.mean_velocity(0), WithinRel(1.0, 0.05));  // 10 t, and what the wave in it carries
  Largest largest;
  motion.run_to(0.3, [&] { largest.take_magnitude(motion.wall().normal); });
  CHECK(largest.value() == 0);
}

TEST_CASE("a wall that speeds up at once takes its nodes along, wherever in a step the kink falls") {
  for (const std::string kink : {"0.05", "0.0502", "0.0504", "0.0507"}) {
    for (const std::string scaling : {"1", "25"}) {
      CAPTURE(kink, scaling);
      driven::Motion motion(pushed_by_wall("0.1*t + 0.2*max(0, t - " + kink + ")", {"mass.scaling=" + scaling}));
      motion.run_to(0.2);
      const double place = 0.1 * 0.2 + 0.2 * (0.2 - std::stod(kink));
      for (std::size_t k = 0; k < motion.u().size(); k += 2 * 9) {
        CHECK_THAT(motion.u()[k], WithinAbs(place, 1e-9));
        CHECK_THAT(motion.v()[k], WithinAbs(0.3, 1e-9));
      }
    }
  }
}

TEST_CASE("local damping does not slow what a wall drives: its nodes follow the wall's acceleration exactly") {
  for (const std::string strategy : {"one-sided", "cundall"}) {
    CAPTURE(strategy);
    driven::Motion motion(pushed_by_wall("0.5*4*t^2", {"damping={strategy='" + strategy + "', alpha=0.7}"}));
    motion.run_to(0.3);
    // The wall stands at 2 t², and the left face's nodes, the first of each row of nine, with it.
    int nodes = 0;
    const double rounding = 1e-6;  // of the motion's numerical second derivative
    for (std::size_t k = 0; k < motion.u().size(); k += 2 * 9) {
      CHECK_THAT(motion.u()[k], WithinAbs(2 * 0.3 * 0.3, rounding));
      CHECK_THAT(motion.v()[k], WithinAbs(4 * 0.3, rounding));
      ++nodes;
    }
    CHECK(nodes == 5);
    CHECK(motion.mean_velocity(0) > 0.9 * 4 * 0.3);
  }
}
