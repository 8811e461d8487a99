// The tables of [exact]: formulas, or a solution with keys of its own.
#pragma once

#include <stillpoint/catalogue.hpp>

#include <vector>

#include "scene/input/keys.hpp"

namespace stillpoint {

/// A table that reads all of it, and one for each solution, which tells its keys. The catalogue must outlive them.
std::vector<TableInfo> exact_tables(const Catalogue& catalogue);

}  // namespace stillpoint
