#include <stillpoint/place_in_body.hpp>

#include <fmt/format.h>

namespace stillpoint {

std::string to_string(const PlaceInBody& place) {
  const bool is_line = place.position.size() == 1;
  std::string text = place.what;
  if (is_line) text += fmt::format(" at x = {:.6g}", place.position[0]);
  if (place.position.size() > 1) text += fmt::format(" at ({:.6g})", fmt::join(place.position, ", "));
  if (!place.material_point.empty()) text += " beside " + place.material_point;
  if (place.cell.size() == 1) text += fmt::format(" in cell {}", place.cell[0]);
  if (place.cell.size() > 1) text += fmt::format(" in cell ({})", fmt::join(place.cell, ", "));
  return text;
}

}  // namespace stillpoint
