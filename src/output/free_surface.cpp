#include "output/free_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace stillpoint {
namespace {

// A square of side w with points in it, [column, column + 1) × [row, row + 1) in units of w. The numbers are whole, but
// of type double, so that they hold any position.
struct Square {
  double column, row;
  std::size_t points;   // number of points in it
  double x, y;          // its highest point
  std::size_t cluster;  // number of its cluster; 0: not known yet
};

bool before(const Square& a, const Square& b) { return std::tie(a.column, a.row) < std::tie(b.column, b.row); }

// The squares that have points, by columns and from below in each.
std::vector<Square> occupied_squares(ConstVec position, double w) {
  std::vector<Square> squares;
  for (std::size_t k = 0; k + 1 < position.size(); k += 2) {
    const double x = position[k], y = position[k + 1];
    if (std::isfinite(x) && std::isfinite(y)) squares.push_back({std::floor(x / w), std::floor(y / w), 1, x, y, 0});
  }
  std::sort(squares.begin(), squares.end(), [](const Square& a, const Square& b) {
    return std::tie(a.column, a.row, b.y, a.x) < std::tie(b.column, b.row, a.y, b.x);
  });
  std::size_t kept = 0;
  for (const Square& each : squares) {  // the first entry of a square is its highest point
    if (kept > 0 && !before(squares[kept - 1], each)) {
      ++squares[kept - 1].points;
    } else {
      squares[kept++] = each;
    }
  }
  squares.resize(kept);
  return squares;
}

// Gives square `first` and all connected with it the number of their cluster; returns their number of points.
std::size_t spread(std::vector<Square>& squares, std::size_t first, std::size_t cluster) {
  std::size_t points = 0;
  std::vector<std::size_t> waiting = {first};
  squares[first].cluster = cluster;
  while (!waiting.empty()) {
    const Square square = squares[waiting.back()];
    waiting.pop_back();
    points += square.points;
    for (const double column : {square.column - 1, square.column, square.column + 1}) {
      const Square lowest{column, square.row - 1, 0, 0, 0, 0};
      for (auto near = std::lower_bound(squares.begin(), squares.end(), lowest, before);
           near != squares.end() && near->column == column && near->row <= square.row + 1; ++near) {
        if (near->cluster != 0) continue;
        near->cluster = cluster;
        waiting.push_back(static_cast<std::size_t>(near - squares.begin()));
      }
    }
  }
  return points;
}

std::size_t largest_cluster(std::vector<Square>& squares) {
  std::size_t cluster = 0, largest = 0, most_points = 0;
  for (std::size_t k = 0; k < squares.size(); ++k) {
    if (squares[k].cluster != 0) continue;
    const std::size_t points = spread(squares, k, ++cluster);
    if (points > most_points) most_points = points, largest = cluster;
  }
  return largest;
}

}  // namespace

FreeSurface free_surface(ConstVec position, double w) {
  if (!(w > 0)) throw std::invalid_argument("the columns of a free surface need a positive width");
  std::vector<Square> squares = occupied_squares(position, w);
  const std::size_t mass = largest_cluster(squares);
  FreeSurface surface;
  double column = std::numeric_limits<double>::quiet_NaN();
  for (const Square& square : squares) {
    if (square.cluster != mass) continue;
    if (square.column != column) {
      column = square.column;
      surface.x.emplace_back();
      surface.y.emplace_back();
    }
    surface.x.back() = square.x;  // the last square of a column is its highest
    surface.y.back() = square.y;
  }
  return surface;
}

double slope_angle(const FreeSurface& surface, double base) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto highest = std::max_element(surface.y.begin(), surface.y.end());
  if (highest == surface.y.end()) return none;
  const double height = *highest - base, low = base + 0.15 * height, high = base + 0.85 * height;
  if (!(height > 0)) return none;

  const auto top = highest - surface.y.begin(), columns = std::ssize(surface.y);
  const auto flank = [&](std::ptrdiff_t step) {
    std::vector<std::size_t> found;
    for (std::ptrdiff_t at = top; at >= 0 && at < columns; at += step) {
      const auto k = static_cast<std::size_t>(at);
      if (surface.y[k] < low) break;
      if (surface.y[k] <= high) found.push_back(k);
    }
    return found;
  };
  const std::vector<std::size_t> left = flank(-1), right = flank(1);
  const std::vector<std::size_t>& slope = left.size() > right.size() ? left : right;
  if (slope.size() < 3) return none;

  // The line through the mean along the larger principal axis of the second moments: tan 2θ = 2 S_xy / (S_xx − S_yy).
  double x_mean = 0, y_mean = 0, xx = 0, yy = 0, xy = 0;
  for (const std::size_t k : slope) {
    x_mean += surface.x[k] / static_cast<double>(slope.size());
    y_mean += surface.y[k] / static_cast<double>(slope.size());
  }
  for (const std::size_t k : slope) {
    const double x = surface.x[k] - x_mean, y = surface.y[k] - y_mean;
    xx += x * x, yy += y * y, xy += x * y;
  }
  return std::abs(std::atan2(2 * xy, xx - yy)) / 2 * 180 / std::numbers::pi;
}

}  // namespace stillpoint
