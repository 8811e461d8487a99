// What is wrong with a grid.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>

namespace stillpoint {

/// A fault of a grid; empty if there is none.
struct GridFault {
  std::string key;  // the key of [grid] that is wrong, "max", or "x[1][2]"; empty: the table as a whole
  int axis = -1;    // the axis whose entry of the key is wrong; −1: all axes
  std::string message{};

  bool empty() const { return message.empty(); }
};

/// The reason why a problem's pieces do not follow each other along every axis; empty if there are none.
GridFault fault_of_pieces(const Problem& problem);
/// The reason why a problem's grid is no box that can be divided into its cells.
GridFault fault_of_grid(const Problem& problem);

}  // namespace stillpoint
