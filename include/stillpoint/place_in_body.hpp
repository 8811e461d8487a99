// A place in a body, in words for error messages.
#pragma once

#include <string>
#include <vector>

namespace stillpoint {

struct PlaceInBody {
  std::string what;                // "material point 12", "the node"
  std::vector<double> position{};  // [m], (dim); empty: it has none
  std::vector<int> cell{};         // cell of the grid, counted from 1, (dim); empty: it is in none
  std::string material_point{};    // nearest material point, unless the place is one
};

/// "material point 12 at (0.5, 0.25) in cell (3, 1)", "the node at x = 0.5 beside material point 12 in cell 3"
std::string to_string(const PlaceInBody& place);

}  // namespace stillpoint
