// What points keep of a violent way to rest: stresses and places that no function of the grid feels, and that no motion
// after it takes away.
#pragma once

#include <stillpoint/problem.hpp>

#include <optional>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// Of walls that were to move faster than a body follows: how far they have been behind. A note for each.
std::vector<std::string> notes_on_late_walls(const Problem& problem, const std::vector<WallReaction>& walls);
/// Why a body that has come to rest in phases is in no equilibrium that could be trusted: a wall has pushed a part of
/// it out of itself at once, by a good part of a cell. Empty: it has not.
std::string fault_of_push(const Problem& problem, const std::vector<WallReaction>& walls);
/// What share of its stresses is such, if that is much: of null_space_stress().
std::optional<std::string> null_space_note(const Problem& problem, const LagrangianPhase& phase,
                                           double null_space_stress);

}  // namespace stillpoint
