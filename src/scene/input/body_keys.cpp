// The table of the bodies.
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/input/scene_keys.hpp"

namespace stillpoint {
namespace {

std::vector<Word> states() {
  std::vector<Word> words;
  for (int k = 0; k <= static_cast<int>(StressState::space); ++k) {
    const auto state = static_cast<StressState>(k);
    const Dims dims = state == StressState::space ? kSpace : state >= StressState::plane_strain ? kPlane : kLine;
    words.emplace_back(to_string(state), dims);
  }
  return words;
}

/// Points along each coordinate of a cell: an array, or a plain number, which in two and three dimensions counts the
/// cell's points.
void read_points_per_cell(BodySpec& body, const Value& value, const KeyInfo& key) {
  const int dim = value.reading.dim;
  KeyInfo along_axis = key;
  along_axis.range = from(1, dim == 1 ? 1000 : 100);
  if (dim == 1 || value.node.is_array()) {
    if (auto points = read_value<std::vector<int>>(value, along_axis)) body.points_per_cell = std::move(*points);
    return;
  }
  const auto count = read_whole(value, from(1, std::pow(along_axis.range.upper, dim)));
  if (!count) return;
  const double along = std::round(std::pow(static_cast<double>(*count), 1.0 / dim));
  if (std::pow(along, dim) == static_cast<double>(*count)) {
    body.points_per_cell.assign(static_cast<std::size_t>(dim), static_cast<int>(along));
  } else {
    value.problem(
        fmt::format("must be a {}, or an array {}; not {}",
                    dim == 2 ? "square (4 is 2 × 2 points in a cell)" : "cube (8 is 2 × 2 × 2 points in a cell)",
                    dim == 2 ? "[along x, along y]" : "[along x, along y, along z]", *count));
  }
}

}  // namespace

[[gnu::no_sanitize_address]] void add_body(Tables& tables) {
  tables
      .add({"body", "material points in a box, in another shape or from a file; [body], or several [[body]]",
            Repeat::once_or_array, "a scene has a body with a material"},
           &Scene::bodies)
      .key("name", &BodySpec::name, "by which a rigid body or a contact says which bodies touch")
      .key("min", &BodySpec::min, "lower corner of a box, or in space of that in which another shape is cut off",
           {.unit = "m", .fallback = "that of the grid"})
      .key("max", &BodySpec::max, "upper corner, likewise", {.unit = "m", .fallback = "that of the grid"})
      .key("polygon", &BodySpec::polygon,
           "corners in order, not a box; in space [x, y] each, or what axis leaves, drawn out from min to max",
           {.unit = "m", .list = true, .in_plane = true, .dims = kNotLine})
      .key("axis", &BodySpec::axis, "along which a polygon is drawn out",
           {.words = {"x", "y", "z"}, .fallback = "z", .dims = kSpace})
      .key("sphere", &BodySpec::sphere, "the centre of a sphere, not a box", {.unit = "m", .dims = kSpace})
      .key("cylinder", &BodySpec::cylinder, "[from, to], the centres of a cylinder's ends, not a box",
           {.unit = "m", .list = true, .dims = kSpace})
      .key("radius", &BodySpec::radius, "of a sphere or a cylinder",
           {.range = kPositive, .unit = "m", .fallback = "needed by both", .dims = kSpace})
      .key("inner_radius", &BodySpec::inner_radius, "of a hollow one",
           {.range = kPositive, .unit = "m", .fallback = "none: it is solid", .dims = kSpace})
      .key("stl", &BodySpec::stl, "STL file of a closed surface of triangles, in metres, not a box", {.dims = kSpace})
      .key("mesh", &BodySpec::mesh,
           "mesh of Gmsh's, text of format 4.1 or 2.2, in metres, whose border is that of the body, not a box",
           {.dims = kNotLine})
      .key("group", &BodySpec::group, "the physical group of the mesh that the body is",
           {.fallback = "all of the mesh", .dims = kNotLine})
      .key("file", &BodySpec::file, "CSV of points, not a box: columns x, y, z as there are, volume")
      .key("material", &BodySpec::material, "the name of a [material.<name>]",
           {.fallback = "beside group, its name", .required = true, .unless = {"group"}})
      .key("state", &BodySpec::state, "of stress and strain, the same in all bodies",
           {.words = states(), .fallback = "uniaxial-stress, plane-strain or space, by dim"})
      .key("area", &BodySpec::area, "cross-section", {.range = kPositive, .unit = "m2", .dims = kLine})
      .key("thickness", &BodySpec::area, "not of axisymmetric bodies",
           {.range = kPositive, .unit = "m", .dims = kPlane})
      .key("points_per_cell", &BodySpec::points_per_cell, "along each coordinate; a plain number counts all in a cell",
           {.range = from(1, 10'000), .fallback = "2"})
      .read_by(read_points_per_cell)
      .key(
          "placement", &BodySpec::placement,
          "of the points in a cell; gauss: of one that the border of another shape than a box cuts, in the part inside",
          {.words = {"uniform", "gauss", "random"}})
      .key("jitter", &BodySpec::jitter, "each point is moved by up to this share of half its spacing",
           {.range = kShare})
      .key("volumes", &BodySpec::volumes,
           "equal, or fitted to the moments of each cell or of its part inside the shape",
           {.words = {"equal", "consistent"}})
      .key("seed", &BodySpec::seed, "of random points and of jitter", {.range = kNotNegative});
}

}  // namespace stillpoint
