#include "scene/driven_motion.hpp"

#include <algorithm>
#include <array>

namespace stillpoint {
namespace {

template <class Test>
bool any_motion(const Scene& scene, const Test& test) {
  return std::ranges::any_of(scene.supports, [&](const SupportSpec& support) { return test(support.motion); }) ||
         std::ranges::any_of(scene.walls, [&](const WallSpec& wall) { return test(wall.motion); }) ||
         (scene.load && test(scene.load->displacement));
}

// Whether a motion is another one at the end than a little earlier, anywhere on a diagonal of the grid.
bool moves_at_end(const Scene& scene, const Expression& motion) {
  if (!motion.uses('t')) return false;
  const double end = scene.stop.time;
  if (!(end > 0)) return true;
  constexpr std::array shares = {0.02, 0.37, 0.71, 0.98};
  constexpr double earlier = 0.99;
  return std::ranges::any_of(shares, [&](double share) {
    std::array<double, 3> x{};
    for (std::size_t d = 0; d < std::min(x.size(), scene.grid.max.size()); ++d)
      x[d] = scene.grid.min[d] + share * (scene.grid.max[d] - scene.grid.min[d]);
    return motion(x, end) != motion(x, earlier * end);
  });
}

}  // namespace

bool is_driven(const Scene& scene) {
  return !scene.solve.is_static() && !scene.stop.wants_equilibrium() &&
         any_motion(scene, [](const Expression& motion) { return motion.uses('t'); });
}

bool is_driven_flow(const Scene& scene) {
  return is_driven(scene) && (scene.phase.max_motion || scene.phase.max_strain) &&
         any_motion(scene, [&](const Expression& motion) { return moves_at_end(scene, motion); });
}

// A body on its way to rest may be damped as strongly as one likes: where it comes to rest is the same. In a flow local
// damping takes its share of every force that moves material: of one-sided damping with α = 0.05, 0.1, 0.2, 0.5 and 0.7
// it was 0.06, 0.10, 0.19, 1.3 and 6 times what a pile does in the clay that it is pushed into.
double usual_alpha(const Scene& scene) {
  constexpr double to_rest = 0.7, in_flow = 0.05;
  return is_driven_flow(scene) ? in_flow : to_rest;
}

}  // namespace stillpoint
