// Positions and the lines of the grid.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <utility>
#include <vector>

namespace stillpoint {

/// A share of a cell that is taken for none.
inline constexpr double kSliver = 1e-6;

/// What is wrong with a grid.
struct GridFault {
  std::string key;  // "max"; empty: nothing
  int axis = -1;    // of the key's entry; −1: of all
  std::string message{};

  bool empty() const { return message.empty(); }
};
/// Of a problem's grid, if it is no box that can be divided into its cells; `silent` if that was to be seen when it was
/// read.
GridFault fault_of_grid(const Problem& problem);

/// A cell's length along an axis; 0 if the cells are not known.
double known_cell_length(const GridSpec& grid, std::size_t axis);
/// How far a position may miss a box along an axis and still be taken to lie in it [m].
double slack_of(double min, double max, double cell_length);
/// Moves a position that misses a box by no more than a sliver onto its border.
void move_into(std::vector<double>& position, const std::vector<double>& min, const std::vector<double>& max,
               const GridSpec& grid);
/// Moves a position that misses a grid line by a sliver of a cell onto it: points in the sliver would have next to no
/// mass.
void snap_to_lines(std::vector<double>& position, const GridSpec& grid);
/// The box around all bodies, of which there is at least one: its lower and its upper corner.
std::pair<std::vector<double>, std::vector<double>> box_around(const std::vector<BodySpec>& bodies);

}  // namespace stillpoint
