// The scene's constants: numbers and formulas of each other, in any order.
#pragma once

#include "scene/input/toml_value.hpp"

namespace stillpoint {

/// Computes every entry of [constants] into reading.constants; names of those that cannot be computed go into
/// reading.broken, with a problem.
void resolve_constants(const toml::table& table, Reading& reading);

}  // namespace stillpoint
