// The lines of the grid at the start, and positions among them.
//
// Along an axis of equal cells their length is (max − min)/cells everywhere. Along one that is given by pieces it
// varies, so that each use asks for the smallest, the longest or the mean length, or for that at a position.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace stillpoint {

/// The share of a cell below which a length counts as 0.
inline constexpr double kSliver = 1e-6;

/// Sets min, max and cells of a grid that is given by pieces, which have to be in order. What two of them miss each
/// other by, a rounding error, goes.
void take_extent_of_pieces(GridSpec& grid);

// What follows needs a grid that is in order, whose lines along an axis are numbered from 0 to cells.

/// Whether the cells along an axis are equal: by min, max and cells, or by a single piece without a ratio.
bool has_equal_cells(const GridSpec& grid, std::size_t axis);
/// The position of a line [m].
double line_position(const GridSpec& grid, std::size_t axis, int line);
/// The positions of all lines, ascending [m].
std::vector<double> grid_lines(const GridSpec& grid, std::size_t axis);

/// The cell that contains x: at a line the one above it, at the ends (and past them) the end cell.
int cell_at(const GridSpec& grid, std::size_t axis, double x);
/// The line that is nearest to x.
int nearest_line(const GridSpec& grid, std::size_t axis, double x);
bool is_on_line(const GridSpec& grid, std::size_t axis, double x);
/// The number of cells from the lower end of an axis to x, and the share of the cell of x: below 0 or above cells
/// outside, where the end cells go on.
double cells_before(const GridSpec& grid, std::size_t axis, double x);
/// The number of cells from one position to another.
double cells_between(const GridSpec& grid, std::size_t axis, double from, double to);

/// The length of the cell that contains x [m].
double cell_length_at(const GridSpec& grid, std::size_t axis, double x);
/// The same; 0 if the cells are not known.
double known_cell_length_at(const GridSpec& grid, std::size_t axis, double x);
double smallest_cell(const GridSpec& grid, std::size_t axis);
double longest_cell(const GridSpec& grid, std::size_t axis);
double mean_cell(const GridSpec& grid, std::size_t axis);
/// The side of a cube as large as the mean cell [m].
double mean_cell(const GridSpec& grid);
/// The longest side of any cell [m].
double longest_cell(const GridSpec& grid);
/// The longest side of a cell whose sides are the smallest along each axis [m].
double longest_of_smallest_sides(const GridSpec& grid);
/// The mean length of the cells along the axis where it is longest [m]: the size of a grid that is refined, which
/// halves with every cell halved, as the longest one does not if its halves are unequal.
double longest_mean_cell(const GridSpec& grid);

/// Moves a position that misses a box by no more than a sliver onto its border.
void move_into(std::vector<double>& position, const std::vector<double>& min, const std::vector<double>& max,
               const GridSpec& grid);
/// Moves a position that misses a grid line by a sliver of a cell onto it: points in the sliver would have next to no
/// mass.
void snap_to_lines(std::vector<double>& position, const GridSpec& grid);
/// The box around all bodies, of which there is at least one: its lower and its upper corner.
std::pair<std::vector<double>, std::vector<double>> box_around(const std::vector<BodySpec>& bodies);

}  // namespace stillpoint
