// Material points from a CSV file: a header with the columns x, y (in two dimensions) and volume in any order, then a
// line a point; '#' begins a comment.
#pragma once

#include <stillpoint/problem.hpp>

#include <filesystem>
#include <vector>

namespace stillpoint {

struct PointFile {
  std::vector<std::vector<double>> x;  // positions [m], dim × (n)
  std::vector<double> volume;          // [m³]: thickness included, or all the way round the axis; (n)
};

/// min, max: the box that the points have to lie in [m], (dim). What is wrong goes to problems, at its line and column;
/// the points are complete only if nothing is.
PointFile read_point_file(const std::filesystem::path& file, const std::vector<double>& min,
                          const std::vector<double>& max, std::vector<Mistake>& problems);

}  // namespace stillpoint
