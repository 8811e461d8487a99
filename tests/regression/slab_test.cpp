// In space a slab of one cell between rollers does what its plane scene does: laws, phases, loads, walls and ways to
// rest, all at once.
#include "slab.hpp"

#include <algorithm>
#include <cmath>

#include "scenes.hpp"

using namespace stillpoint;
using Catch::Matchers::WithinRel;

namespace {

// Two points across it, as in its plane: a slab of one has modes that these points do not feel.
Scene slab_of(const Scene& plane) { return scenes::slab(plane, /*points_across=*/2); }

// A wall's shear has two components in space.
std::string in_space(const Summary& plane, const std::string& wall, const std::string& field) {
  const bool is_floor = plane.probes.at(wall).size() == 2 && wall == "floor";
  return field == "shear" ? is_floor ? "shear.x" : "shear.y" : field;
}

// Of all probes, (the largest difference of a field)/(the largest field of its kind).
double difference(const Summary& plane, const Summary& space) {
  double worst = 0;
  for (const auto& [name, fields] : plane.probes) {
    for (const auto& [field, value] : fields) {
      double scale = 1e-12;  // of what is 0 but for rounding
      for (const auto& [other, magnitude] : fields)
        if (other.front() == field.front()) scale = std::max(scale, std::abs(magnitude));
      const double off = std::abs(scenes::probe(space, name, in_space(plane, name, field)) - value);
      worst = off <= worst * scale ? worst : off / scale;
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("a slab in space moves as its plane scene does, step for step") {
  struct Case {
    std::string name;
    std::vector<std::string> overrides;
  };
  // Under 0.05 of the stiffness: at 0.3 rounding grows into shapes that the plane has not.
  const std::string gently = "traction[0].pressure=0.05", too = "traction[1].pressure=0.05";
  const std::string phases = "phase.max_motion=0.01", points = "phase.quadrature=points";
  const std::vector<Case> cases = {
      {"block", {gently, too}},
      {"block", {gently, too, "material.rubber.law=hencky"}},
      {"block", {gently, too, "material.rubber.law=linear-elastic"}},
      {"block", {gently, too, phases, points, "stop.residual=1e-5"}},
      {"block", {gently, too, phases, points, "stop.residual=1e-5", "phase.transfer=apic"}},
      {"block", {gently, too, phases, points, "stop.residual=1e-5", "phase.transfer=xpic"}},
      {"block", {gently, too, "phase.dilatation=cells", "material.rubber.nu=0.49"}},
      {"block", {gently, too, "mass.kind=consistent"}},
      {"column", {}},
      {"column", {"damping.strategy=kinetic"}},
      {"footing", {"grid.cells=[12,9]"}},
      {"footing_clay", {"grid.cells=[12,8]", "damping.strategy=viscous", "phase.dilatation=points"}},
      {"block_on_wall", {"stop.time=0.1"}},
      {"block_on_wall", {"stop.time=0.1", "constants.mu=0.2"}},
  };
  for (const auto& [name, overrides] : cases) {
    CAPTURE(name, overrides);
    Scene plane = scenes::load(name, overrides);
    Scene once = plane;
    once.stop.steps = 1;
    const Summary start = run(once);
    plane.integrator.step = start.dt / 2;  // which is below the critical one in space too
    if (start.c) plane.damping.c = start.c;
    plane.stop.dwell = 0;  // by omega_1, which is lower in space
    const Summary in_plane = run(plane), in_space = run(slab_of(plane));
    CHECK(in_space.exit_status == 0);
    CHECK(in_space.steps == in_plane.steps);
    CHECK(in_space.phases == in_plane.phases);
    CHECK(difference(in_plane, in_space) < 1e-8);  // rounding, over some hundred steps
  }
}

TEST_CASE("every way to rest finds the plane scene's equilibrium of a slab in space") {
  const Scene plane = scenes::load("block", {"traction[0].pressure=0.05", "traction[1].pressure=0.05"});
  const Summary in_plane = run(plane);
  const auto check = [&](const Scene& scene) {
    const Summary s = run(scene);
    CHECK(s.exit_status == 0);
    CHECK(s.phases == 1);
    CHECK(difference(in_plane, s) < 1e-7);  // of a residual of 1e-10
  };
  for (const std::string method : {"newton", "newton-cg", "cg", "lbfgs"}) {
    CAPTURE(method);
    Scene scene = slab_of(plane);
    scene.damping = {};
    scene.solve.method = method;
    check(scene);
  }
  for (const std::string strategy : {"viscous", "kinetic", "cundall", "adaptive", "auto"}) {
    CAPTURE(strategy);
    Scene scene = slab_of(plane);
    scene.damping = {.strategy = strategy, .c = {}};
    check(scene);
  }
}

TEST_CASE("a slope in space forms behind a wall that moves as it does in the plane") {
  // Undamped: whether a local damping acts at a node whose velocity is 0 but for rounding, rounding says.
  Scene plane = scenes::load("slope", {"grid.cells=[24,13]", "stop.time=0.3", "output.stages=[]",
                                       "damping.strategy=none", "integrator.step=1e-3"});
  ProbeSpec& all = plane.probes.front();
  all.kind = ProbeKind::body;
  all.fields = {"volume", "momentum.x", "momentum.y"};
  const Summary in_plane = run(plane), in_space = run(slab_of(plane));
  CHECK(in_space.phases == in_plane.phases);
  CHECK(in_space.steps == in_plane.steps);
  CHECK(difference(in_plane, in_space) < 1e-6);
  CHECK_THAT(in_space.kinetic_energy, WithinRel(in_plane.kinetic_energy, 1e-6));
}

TEST_CASE("level ground in space is in balance at the start to rounding, and stays as it is") {
  const Summary s = run(slab_of(scenes::load("level_ground")));
  CHECK(s.exit_status == 0);
  CHECK(s.phases == 1);
  CHECK(s.residual < 1e-12);
}
