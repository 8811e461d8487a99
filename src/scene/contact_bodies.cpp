#include "scene/contact_bodies.hpp"

#include <algorithm>

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

}  // namespace stillpoint
