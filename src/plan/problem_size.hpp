// The size of a problem, told without placing a point: its cells, points and unknowns, its stiffness matrix, a factor.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

#include "base/memory_room.hpp"

namespace stillpoint {

struct BodySize {
  double points = 0, cells = 0;     // cells are counted if they hold points
  double unknowns = 0;              // counted before supports take some away
  double grid_functions = 0;        // functions of the grid that have a number
  double longest = 0;               // cells along the longest side of a box around the bodies
  double width = 0;                 // unknowns across the body at its narrowest: half of the band of K
  std::vector<double> body_points;  // points of each body
  std::string most_points;          // the key that sets the points of the body that has most
};

/// Counts to a few per cent. Bodies that meet in a cell count it twice, and the cells of a file's points fill its box.
BodySize body_size(const Problem& problem);

/// The sizes of a stiffness matrix and of its factor. They were measured on plates of 8e4 to 1e6 unknowns, and on
/// lines.
struct MatrixSize {
  double matrix = 0;    // K [bytes]
  double assembly = 0;  // the blocks that a matrix is assembled in, one for each pair of neighbours in the grid [bytes]
  double entries_per_column = 0, entries_of_factor = 0;
  double factor() const { return sizeof(double) * entries_of_factor; }  // [bytes]

  /// Whether a factor can be numbered, and has room beside the matrices that it is made from.
  bool factor_fits(const MemoryRoom& room) const;
  /// Whether a factor costs about as much as a relaxation, or less, as in the plane; in space it costs as many times
  /// more as there are cells across half of the body.
  bool factor_is_cheap() const;
};

MatrixSize matrix_size(const Problem& problem, const BodySize& size);

}  // namespace stillpoint
