// What a problem that leaves it open takes for its phases.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// The materials of the bodies, each once; without those whose law is not for this stress state.
std::vector<const MaterialSpec*> materials_in_use(const Problem& problem, const Catalogue& catalogue);
/// Whether one of these remembers.
bool any_remembers(const std::vector<const MaterialSpec*>& materials, const Catalogue& catalogue);
/// Why material points cannot stand for domains side by side; empty: they can.
std::string why_no_domains(const Problem& problem);
/// Makes the open choices of [phase]: whether phases end, and what the points of those that go on take with them.
void resolve_phases(Problem& problem, const Catalogue& catalogue);

}  // namespace stillpoint
