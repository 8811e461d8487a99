// The numbers of cells, points and unknowns of a problem, counted without placing one.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

namespace stillpoint {

struct BodySize {
  double points = 0, cells = 0;     // cells are counted if they hold points
  double unknowns = 0;              // counted before supports take some away
  double grid_functions = 0;        // functions of the whole grid
  double width = 0;                 // unknowns across the body at its narrowest: half of the band of K
  std::vector<double> body_points;  // points of each body
  std::string most_points;          // the key that sets the points of the body that has most
};

/// Counts to a few per cent. Bodies that meet in a cell count it twice, and the cells of a file's points fill its box.
BodySize body_size(const Problem& problem);

}  // namespace stillpoint
