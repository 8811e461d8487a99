// No axis of space is preferred: a scene whose axes are named anew has the same answer.
#include <algorithm>
#include <cmath>

#include "driven.hpp"
#include "scenes.hpp"
#include "slab.hpp"

using namespace stillpoint;
using Catch::Matchers::WithinRel;

namespace {

constexpr int next_axis(int axis) { return (axis + 1) % 3; }
Face next_face(Face face) { return static_cast<Face>((static_cast<int>(face) + 2) % 6); }

template <class T>
void turn(std::vector<T>& components) {
  if (components.size() == 3) std::ranges::rotate(components, components.end() - 1);
}

/// x becomes y, y becomes z and z becomes x. Of formulas of t alone.
Scene turned(Scene scene) {
  turn(scene.grid.min);
  turn(scene.grid.max);
  turn(scene.grid.cells);
  for (BodySpec& body : scene.bodies) {
    std::vector<double> low = body.min, high = body.max;
    turn(low);
    turn(high);
    body.min = low;
    body.max = high;
    turn(body.points_per_cell);
  }
  for (SupportSpec& support : scene.supports) {
    if (support.face) support.face = next_face(*support.face);
    support.component.become(next_axis(support.component));
  }
  for (TractionSpec& traction : scene.tractions) {
    traction.face = next_face(traction.face.value());
    turn(traction.value);
  }
  for (WallSpec& wall : scene.walls) wall.face = next_face(wall.face);
  turn(scene.body_force);
  for (ProbeSpec& probe : scene.probes) {
    turn(probe.at);
    for (std::string& field : probe.fields) {
      if (field.size() != 3) throw std::logic_error("a field that does not turn: " + field);
      field.back() = static_cast<char>('x' + next_axis(field.back() - 'x'));
    }
  }
  return scene;
}

std::vector<double> values_of(const Summary& s, const std::string& probe) {
  std::vector<double> values;
  for (const auto& [field, value] : s.probes.at(probe)) values.push_back(value);
  return values;
}

}  // namespace

TEST_CASE("a block on a wall with friction slides alike along every axis of space") {
  const std::vector<std::string> sliding = {"stop.time=0.1", "constants.mu=0.2", "integrator.step=5e-5"};
  Scene scene = scenes::slab(scenes::load("block_on_wall", sliding), 2);
  const std::vector<double> first = values_of(run(scene), "middle");
  for (int turns = 1; turns < 3; ++turns) {
    CAPTURE(turns);
    scene = turned(scene);
    const std::vector<double> now = values_of(run(scene), "middle");
    for (std::size_t k = 0; k < now.size(); ++k) CHECK_THAT(now[k], WithinRel(first[k], 1e-9));
  }
}

TEST_CASE("a block under pressure on two faces is pressed alike along every axis of space, in phases too") {
  for (const std::string motion : {"none", "0.01"}) {
    CAPTURE(motion);
    std::vector<std::string> set = {"traction[0].pressure=0.05", "traction[1].pressure=0.02", "stop.residual=1e-8",
                                    "probe[0].fields=['u.x', 'u.y']", "phase.max_motion=" + motion};
    if (motion != "none") set.emplace_back("phase.quadrature=points");
    Scene scene = scenes::slab(scenes::load("block", set), 2);
    const std::vector<double> first = values_of(run(scene), "corner");
    for (int turns = 1; turns < 3; ++turns) {
      CAPTURE(turns);
      scene = turned(scene);
      const std::vector<double> now = values_of(run(scene), "corner");
      for (std::size_t k = 0; k < now.size(); ++k) CHECK_THAT(now[k], WithinRel(first[k], 1e-6));
    }
  }
}

TEST_CASE("a block slides down a slope along the diagonal of a wall in space with a = g (sin theta - mu cos theta)") {
  constexpr double g = 9.81, theta = 0.4;
  for (const double mu : {0.0, 0.2, 0.5}) {  // tan theta = 0.42: the last one stays
    CAPTURE(mu);
    Scene scene = scenes::slab(scenes::load("block_on_wall", {"damping={strategy='none'}"}), 2);
    scene.supports.clear();
    scene.grid.max = {3, 1, 3};
    scene.grid.cells = {12, 4, 12};
    scene.bodies[0].max = {1, 0.5, 1};
    scene.walls[0].friction = mu;
    scene.probes.clear();
    const double along = g * std::sin(theta) / std::sqrt(2);
    scene.body_force = {Expression(along), Expression(-g * std::cos(theta)), Expression(along)};
    driven::Motion motion(scene);
    motion.run_to(0.5);
    const double friction = mu * g * std::cos(theta) * 0.5,
                 expected = std::max(0.0, g * std::sin(theta) * 0.5 - friction);
    const std::vector<double> v = motion.mean_velocity();
    CAPTURE(v, expected);
    CHECK(std::abs(v[0] - v[2]) < 1e-3);  // nodes that stick now and then go by rounding
    // Waves of the sudden weight, which nothing damps, lift nodes off the wall for moments.
    CHECK(std::abs(std::hypot(v[0], v[2]) - expected) < 0.1 * friction + 1e-9);
    const WallReaction wall = motion.wall();
    CHECK(std::hypot(wall.shear[0], wall.shear[1]) <= mu * wall.normal * (1 + 1e-12) + 1e-9);
  }
}
