// The sizes of a stiffness matrix and of its factor, from the problem alone. They were measured on plates of 8e4 to 1e6
// unknowns, and on lines.
#pragma once

#include <stillpoint/problem.hpp>

#include "base/memory_room.hpp"
#include "plan/body_size.hpp"

namespace stillpoint {

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
