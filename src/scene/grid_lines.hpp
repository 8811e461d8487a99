// Positions and the lines of the grid.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace stillpoint {

/// The share of a cell below which a length counts as 0.
inline constexpr double kSliver = 1e-6;

/// A fault of a grid; empty if there is none.
struct GridFault {
  std::string key;  // the key of [grid] that is wrong, "max"; empty: the table as a whole
  int axis = -1;    // the axis whose entry of the key is wrong; −1: all axes
  std::string message{};

  bool empty() const { return message.empty(); }
};
/// The reason why a problem's grid is no box that can be divided into its cells.
GridFault fault_of_grid(const Problem& problem);

/// A cell's length along an axis; 0 if the cells are not known.
double known_cell_length(const GridSpec& grid, std::size_t axis);
/// Moves a position that misses a box by no more than a sliver onto its border.
void move_into(std::vector<double>& position, const std::vector<double>& min, const std::vector<double>& max,
               const GridSpec& grid);
/// Moves a position that misses a grid line by a sliver of a cell onto it: points in the sliver would have next to no
/// mass.
void snap_to_lines(std::vector<double>& position, const GridSpec& grid);
/// The box around all bodies, of which there is at least one: its lower and its upper corner.
std::pair<std::vector<double>, std::vector<double>> box_around(const std::vector<BodySpec>& bodies);

/// The longest side of the grid's cells at the start [m].
inline double longest_cell(const GridSpec& grid) {
  double longest = 0;
  for (std::size_t d = 0; d < grid.cells.size(); ++d) longest = std::max(longest, grid.cell_length(d));
  return longest;
}

}  // namespace stillpoint
