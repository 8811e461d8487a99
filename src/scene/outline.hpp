// The outline of a body in the plane.
#pragma once

#include <stillpoint/problem.hpp>

#include "geometry/polygon.hpp"

namespace stillpoint {

/// The corners of its polygon as they are written, or of its box, counter-clockwise; of points from a file the box
/// around them.
inline Polygon outline_of(const BodySpec& body) {
  if (body.polygon.empty())
    return {
        {body.min[0], body.min[1]}, {body.max[0], body.min[1]}, {body.max[0], body.max[1]}, {body.min[0], body.max[1]}};
  Polygon outline;
  for (const std::vector<double>& corner : body.polygon) outline.push_back({corner[0], corner[1]});
  return outline;
}

}  // namespace stillpoint
