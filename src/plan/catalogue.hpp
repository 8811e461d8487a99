// All that a scene may choose from.
#pragma once

#include <stillpoint/catalogue.hpp>

namespace stillpoint {

/// Every law, damping, relaxation, static solver and integrator of this library, in the order of `stillpoint list`.
const Catalogue& catalogue();

}  // namespace stillpoint
