// The bodies of a [[contact]].
#pragma once

#include <stillpoint/problem.hpp>

#include <utility>

namespace stillpoint {

/// The numbers of the bodies that a contact names; that of one which is not there in the present stage is the number of
/// bodies.
std::pair<std::size_t, std::size_t> bodies_of(const Problem& problem, const ContactSpec& contact);
/// Whether both are there.
bool are_there(const Problem& problem, const ContactSpec& contact);
/// Whether the scene lets two bodies, by their numbers, move apart from each other.
bool have_contact(const Problem& problem, std::size_t a, std::size_t b);

}  // namespace stillpoint
