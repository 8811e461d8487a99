// The choices of [phase] that a problem leaves open.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// The materials of the bodies, each once; without those whose law is not for this stress state.
std::vector<const MaterialSpec*> materials_in_use(const Problem& problem, const Catalogue& catalogue);
/// True if the law of one of these materials depends on the history.
bool any_remembers(const std::vector<const MaterialSpec*>& materials, const Catalogue& catalogue);
/// The reason why material points cannot stand for domains side by side; empty if they can.
std::string why_no_domains(const Problem& problem);
/// Makes the open choices of [phase]: the end of a phase, and the quantities that points take into the next.
void resolve_phases(Problem& problem, const Catalogue& catalogue);

}  // namespace stillpoint
