#include "scene/driven_motion.hpp"

#include <algorithm>
#include <array>

namespace stillpoint {
namespace {

template <class Test>
bool any_motion(const Problem& problem, const Test& test) {
  return std::ranges::any_of(problem.supports, [&](const SupportSpec& support) { return test(support.motion); }) ||
         std::ranges::any_of(problem.walls, [&](const WallSpec& wall) { return test(wall.motion); }) ||
         std::ranges::any_of(problem.rigid,
                             [&](const RigidSpec& rigid) {
                               return std::ranges::any_of(rigid.motion, test) ||
                                      std::ranges::any_of(rigid.rotation, test);
                             }) ||
         (problem.load && test(problem.load->displacement));
}

// True if a motion changes between a little before the end and the end, anywhere on a diagonal of the grid.
bool moves_at_end(const Problem& problem, const Expression& motion) {
  if (!motion.uses('t')) return false;
  const double end = problem.stop.time;
  if (!(end > 0)) return true;
  constexpr std::array shares = {0.02, 0.37, 0.71, 0.98};
  constexpr double earlier = 0.99;
  return std::ranges::any_of(shares, [&](double share) {
    std::array<double, 3> x{};
    for (std::size_t d = 0; d < std::min(x.size(), problem.grid.max.size()); ++d)
      x[d] = problem.grid.min[d] + share * (problem.grid.max[d] - problem.grid.min[d]);
    return motion(x, end) != motion(x, earlier * end);
  });
}

}  // namespace

bool is_driven(const Problem& problem) {
  return !problem.solve.is_static() && !problem.stop.wants_equilibrium() &&
         any_motion(problem, [](const Expression& motion) { return motion.uses('t'); });
}

bool is_driven_flow(const Problem& problem) {
  return is_driven(problem) && problem.phase.ends() &&
         any_motion(problem, [&](const Expression& motion) { return moves_at_end(problem, motion); });
}

// A body on its way to rest may be damped as strongly as one likes: where it comes to rest is the same. In a flow local
// damping takes its share of every force that moves material: of one-sided damping with α = 0.05, 0.1, 0.2, 0.5 and 0.7
// it was 0.06, 0.10, 0.19, 1.3 and 6 times what a pile does in the clay that it is pushed into.
double usual_alpha(const Problem& problem) {
  constexpr double to_rest = 0.7, in_flow = 0.05;
  return is_driven_flow(problem) ? in_flow : to_rest;
}

}  // namespace stillpoint
