// How many cells, points and unknowns a scene comes to, counted without placing one.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

namespace stillpoint {

struct BodySize {
  double points = 0, cells = 0;     // cells: that hold points
  double unknowns = 0;              // before supports take some away
  double grid_functions = 0;        // of the whole grid
  double width = 0;                 // unknowns across the body where it is slender: K's band
  std::vector<double> body_points;  // of each body
  std::string most_points;          // the key of the body that has most
};

/// To a few per cent. Bodies that meet in a cell count it twice, and the cells of a file's points fill its box.
BodySize body_size(const Problem& problem);

}  // namespace stillpoint
