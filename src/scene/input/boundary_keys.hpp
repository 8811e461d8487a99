// The tables of what holds and loads the bodies.
#pragma once

#include "scene/input/key_reader.hpp"

namespace stillpoint {

/// [[support]], [[wall]], [[force]], [[traction]], [body_force] and [load].
void add_boundary(Tables& tables);

}  // namespace stillpoint
