// The tables of materials, whose keys are the parameters and choices of their laws.
#pragma once

#include <stillpoint/catalogue.hpp>

#include <vector>

#include "scene/input/keys.hpp"

namespace stillpoint {

/// A table of all materials, which reads them, and one for each law, which tells its keys. The catalogue must outlive
/// them.
std::vector<TableInfo> material_tables(const Catalogue& catalogue);

}  // namespace stillpoint
