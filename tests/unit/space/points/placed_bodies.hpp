// Bodies placed on a grid: boxes, polygons and files of points.
#pragma once

#include <stillpoint/scene.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <numeric>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "space/grid/scene_grid.hpp"
#include "space/points/make_body.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint::test {

// [0, 4] × [0, 2] in 8 × 3 cells.
inline const Grid<2> kGrid{Axis::uniform(0, 4, 8), Axis::uniform(0, 2, 3)};

inline BodySpec box(std::vector<double> min, std::vector<double> max) {
  BodySpec body;
  body.min = std::move(min);
  body.max = std::move(max);
  body.points_per_cell = {2, 2};
  return body;
}

inline BodySpec polygon(std::vector<std::vector<double>> corners) {
  BodySpec body = box({4, 2}, {0, 0});
  std::vector<double> low = body.min, high = body.max;
  for (const auto& corner : corners) {
    for (std::size_t d = 0; d < 2; ++d) {
      low[d] = std::min(low[d], corner[d]);
      high[d] = std::max(high[d], corner[d]);
    }
  }
  body.min = low;
  body.max = high;
  body.polygon = std::move(corners);
  return body;
}

inline BodySpec from_file(const std::filesystem::path& file) {
  BodySpec body;
  body.file = file;
  return body;
}

inline MaterialPoints<2> place(const BodySpec& body, StressState state = StressState::plane_strain,
                               double density = 1) {
  return place_body<2>(body, kGrid, density, state).points;
}

/// With domains of its points, in the grid of the start.
inline Body<Kinematics::plane> body_of(const Scene& scene) {
  return make_body<Kinematics::plane>(scene, grid_at<2>(scene, 0), true);
}

inline double volume_of(const MaterialPoints<2>& points) {
  return std::accumulate(points.volume.begin(), points.volume.end(), 0.0);
}

/// Points lie in the cells that list them, cells ascend, and none is empty.
inline void check_cells(const MaterialPoints<2>& points) {
  REQUIRE(points.cell_begin.size() == points.cell.size() + 1);
  REQUIRE(static_cast<std::size_t>(points.cell_begin.back()) == points.size());
  CHECK(std::adjacent_find(points.cell.begin(), points.cell.end(), std::greater_equal<>()) == points.cell.end());
  for (std::size_t k = 0; k < points.cell.size(); ++k) {
    CHECK(points.cell_begin[k] < points.cell_begin[k + 1]);
    for (int p = points.cell_begin[k]; p < points.cell_begin[k + 1]; ++p)
      CHECK(kGrid.cell_number(kGrid.cell_of(points.position(static_cast<std::size_t>(p)))) == points.cell[k]);
  }
}

}  // namespace stillpoint::test
