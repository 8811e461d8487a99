// The table of the bodies.
#pragma once

#include "scene/input/key_reader.hpp"

namespace stillpoint {

/// [body], or several [[body]].
void add_body(Tables& tables);

}  // namespace stillpoint
