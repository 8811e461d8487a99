// Bodies that rest on contact alone, which may roll or tip.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// True if something that touches slips. Friction that sticks is a spring, with a potential, and a mode along which
/// K(u) falls is one of a body that rolls or tips; where it slips it resists one way and not the other.
bool slips(const LagrangianPhase& phase, double t, ConstVec u);

/// The numbers of points, one in each part of the bodies that no support holds along any axis.
std::vector<std::size_t> on_contact_alone(const LagrangianPhase& phase);

/// A note on a body whose stability is not known, and which stands on a contact that is small beside it; empty: there
/// is none.
std::string note_on_small_contact(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u);

}  // namespace stillpoint
