// The tables of how a scene is brought to rest, and of what is written.
#pragma once

#include <stillpoint/catalogue.hpp>

#include "scene/input/key_reader.hpp"

namespace stillpoint {

/// [solve], [damping], [integrator] and [stop].
void add_method(Tables& tables, const Catalogue& catalogue);

/// [output], [checkpoint], [[probe]] and [[variant]].
void add_output(Tables& tables);

}  // namespace stillpoint
