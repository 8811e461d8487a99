#include "scene/contact_bodies.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/body_depth.hpp"

namespace stillpoint {

std::pair<std::size_t, std::size_t> bodies_of(const Problem& problem, const ContactSpec& contact) {
  const auto number = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(problem.bodies, name, &BodySpec::name) - problem.bodies.begin());
  };
  return {number(contact.bodies[0]), number(contact.bodies[1])};
}

bool are_there(const Problem& problem, const ContactSpec& contact) {
  const auto [a, b] = bodies_of(problem, contact);
  return std::max(a, b) < problem.bodies.size();
}

bool have_contact(const Problem& problem, std::size_t a, std::size_t b) {
  return std::ranges::any_of(problem.contacts, [&](const ContactSpec& contact) {
    return contact.bodies.size() == 2 &&
           std::ranges::is_permutation(contact.bodies, std::vector{problem.bodies[a].name, problem.bodies[b].name});
  });
}

// By the corners of a little box around the position as well.
std::vector<std::size_t> bodies_at(const Problem& problem, std::span<const double> x) {
  constexpr double rounding = 1e-9;  // of the grid
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    const BodyDepth body(problem.bodies[k]);
    bool is_there = body.is_known() && body.contains(x);
    for (unsigned corner = 0; body.is_known() && !is_there && corner < 1u << x.size(); ++corner) {
      std::vector<double> beside(x.begin(), x.end());
      for (std::size_t d = 0; d < x.size(); ++d)
        beside[d] += (corner >> d & 1u ? rounding : -rounding) * (problem.grid.max[d] - problem.grid.min[d]);
      is_there = body.contains(beside);
    }
    if (is_there) found.push_back(k);
  }
  return found;
}

std::string name_of_body(const Problem& problem, std::size_t k) {
  return problem.bodies[k].name.empty() ? fmt::format("body[{}]", k) : in_quotes(problem.bodies[k].name);
}

}  // namespace stillpoint
