#include "space/phase/place_of_ranks.hpp"

#include <sstream>
#include <string>

#include <fmt/format.h>

namespace stillpoint {

// As a text of four lines: words, the point beside it, the position, the cell.
PlaceInBody place_of_ranks(const Ranks* ranks, const PlaceInBody& mine, const CellPlace& cell) {
  if (!ranks) return mine;
  const std::string mine_as_text = mine.what.empty()
                                       ? ""
                                       : fmt::format("{}\n{}\n{:a}\n{}", mine.what, mine.material_point,
                                                     fmt::join(mine.position, " "), fmt::join(mine.cell, " "));
  std::istringstream text(first_text(ranks, mine_as_text, cell));
  PlaceInBody place;
  std::string line;
  std::getline(text, place.what);
  std::getline(text, place.material_point);
  std::getline(text, line);
  std::istringstream coordinates(line);
  for (std::string x; coordinates >> x;) place.position.push_back(std::stod(x));
  for (int c = 0; text >> c;) place.cell.push_back(c);
  return place;
}

}  // namespace stillpoint
