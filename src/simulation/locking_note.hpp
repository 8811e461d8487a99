// Whether a scene's cells lock: what their points must keep to is more than their nodes can do.
#pragma once

#include <stillpoint/problem.hpp>

#include <optional>
#include <string>

namespace stillpoint {

/// Of a material that is nearly incompressible, or flows plastically, and no remedy chosen.
std::optional<std::string> locking_note(const Problem& problem);
/// Long cells of a linear basis, which lock where the body bends; nothing if they are not that long.
std::optional<std::string> slender_cells_note(const Problem& problem);

}  // namespace stillpoint
