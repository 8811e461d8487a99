// The bodies of a [[contact]], and what messages call them.
#pragma once

#include <stillpoint/problem.hpp>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace stillpoint {

/// The numbers of the bodies that a contact names; that of one which is not there in the present stage is the number of
/// bodies.
std::pair<std::size_t, std::size_t> bodies_of(const Problem& problem, const ContactSpec& contact);
/// Whether both are there.
bool are_there(const Problem& problem, const ContactSpec& contact);
/// Whether the scene lets two bodies, by their numbers, move apart from each other.
bool have_contact(const Problem& problem, std::size_t a, std::size_t b);
/// The bodies that a position lies in or on the border of, as far as their borders are known.
std::vector<std::size_t> bodies_at(const Problem& problem, std::span<const double> x);
/// "'block'", or "body[1]" if it has no name.
std::string name_of_body(const Problem& problem, std::size_t k);

}  // namespace stillpoint
