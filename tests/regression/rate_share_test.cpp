// What a body that is driven bears by its material, and what damping and inertia add to that.
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "says.hpp"
#include "scenes.hpp"

using namespace stillpoint;
using stillpoint::test::says;

namespace {

// A stiff pile pushed 0.4 m into clay, coarse.
const std::string pile = R"(
dim = 2
[grid]
min = [0, 0]
max = [4, 6]
cells = [16, 24]
[[body]]
max = [4, 4]
material = "soil"
[[body]]
polygon = [[0, 4], [0.25, 4.25], [0.25, 5.5], [0, 5.5]]
material = "pile"
[material.soil]
law = "drucker-prager"
E = 1e7
nu = 0.3
rho = 1800
c = 10e3
[material.pile]
law = "hencky"
E = 1e9
nu = 0.2
rho = 2500
[[support]]
face = "bottom"
[[support]]
face = "left"
kind = "roller"
[[support]]
face = "right"
kind = "roller"
[[support]]
name = "head"
at = [0.125, 5.5]
component = "y"
u = "-0.1*t"
stiffness = 1e8
[phase]
dilatation = "cells"
[damping]
strategy = "one-sided"
[stop]
time = 4
residual = 0
)";

// Clay between smooth walls, of which the right one moves in.
const std::string press = R"(
dim = 2
[grid]
min = [0, 0]
max = [2, 2]
cells = [8, 8]
follow = "press"
[body]
max = [2, 1]
material = "soil"
state = "plane-strain"
points_per_cell = 4
[material.soil]
law = "drucker-prager"
E = 1e7
nu = 0.3
rho = 1800
c = 10e3
[mass]
kind = "lumped"
[phase]
max_motion = 0.1
[[support]]
face = "bottom"
kind = "roller"
[[wall]]
name = "back"
face = "left"
[[wall]]
name = "press"
face = "right"
motion = "-0.1*t"
[damping]
strategy = "one-sided"
alpha = 0.7
[stop]
time = 2
residual = 0
)";

const std::string told = "damping and inertia took";

Summary end_of(const std::string& scene, const std::vector<std::string>& set) {
  const Summary s = run(load_scene("driven.toml", scene, set), {.threads = 1});
  CAPTURE(set, s.reason);
  CHECK(s.exit_status == 0);
  return s;
}
double share(const Summary& s) { return s.rate_share.value_or(std::numeric_limits<double>::quiet_NaN()); }
// Of all work, per metre of the way and of the pile's width, over s_u.
double bearing(const Summary& s) { return *s.external_work / (0.4 * 0.25 * 10e3); }

}  // namespace

TEST_CASE("a pile bears the same by its material whatever the local damping, once the rate share is taken off") {
  const Summary undamped = end_of(pile, {"damping.strategy=none"});
  CHECK(share(undamped) < 0.05);
  CHECK_FALSE(says(undamped, told));
  double last = 0;
  for (const char* damping :
       {"damping.alpha=0.1", "damping.alpha=0.3", "damping.alpha=0.7", "damping={strategy='cundall', alpha=0.7}"}) {
    const Summary s = end_of(pile, {damping});
    CAPTURE(damping, share(s), bearing(s));
    CHECK(share(s) > 0.05);
    CHECK(says(s, told));
    CHECK(share(s) > last);  // the more, the more is damped
    last = share(s);
    // Of the others flow is a little different: 15 %, of forces that differ by a factor of five and more.
    CHECK(bearing(s) * (1 - share(s)) == Approx(bearing(undamped)).epsilon(0.15));
  }
  CHECK(last > 0.6);
}

TEST_CASE("by default local damping takes a tenth of what drives a flow at most, at half the speed and at twice it") {
  for (const char* u : {"-0.05*t", "-0.1*t", "-0.2*t"}) {
    for (const char* strategy : {"one-sided", "cundall", "combined"}) {
      const Summary s = end_of(
          pile, {fmt::format("support[3].u={}", u), fmt::format("damping.strategy={}", strategy), "stop.time=2"});
      CAPTURE(u, strategy);
      CHECK(share(s) < 0.15);
    }
  }
}

TEST_CASE("the share is that of viscous damping and of walls as well, and grows with the speed") {
  const Summary slow = end_of(press, {"wall[1].motion=-0.02*t", "stop.time=4"}),
                fast = end_of(press, {"wall[1].motion=-1*t", "stop.time=0.2"});
  CAPTURE(share(slow), share(fast));
  CHECK(share(slow) < share(fast));
  CHECK(share(fast) > 0.05);
  CHECK(says(fast, told));
  const Summary thick = end_of(press, {"damping={strategy='viscous', c=200}"}),
                thin = end_of(press, {"damping={strategy='viscous', c=1}"});
  CAPTURE(share(thick), share(thin));
  CHECK(share(thick) > 2 * share(thin));  // of two hundred times the damping: it is a share, of 1 at most
}

TEST_CASE(
    "there is no share where nothing drives, or where equilibrium is asked for, and damping stays as it is there") {
  CHECK_FALSE(end_of(press, {"wall[1].motion=0", "stop.residual=1e-6", "body_force.value=[0,-10]"}).rate_share);
  CHECK_FALSE(end_of(press, {"wall[1].motion=-0.01*min(t,1)", "stop.residual=1e-5", "stop.time=100"}).rate_share);
  const auto alpha = [](const std::vector<std::string>& set) {
    return load_scene("driven.toml", pile, set).damping.alpha;
  };
  CHECK(alpha({}) == 0.05);
  CHECK(alpha({"damping.alpha=0.4"}) == 0.4);
  CHECK(alpha({"stop.residual=1e-6"}) == 0.7);
  CHECK(alpha({"phase.max_motion=none"}) == 0.7);
  CHECK(alpha({"support[3].u=-0.1*min(t,2)"}) == 0.7);
  CHECK(alpha({"support[3].u=-0.1"}) == 0.7);
}
