#include "scene/resolve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "geometry/point_outline.hpp"
#include "geometry/prism.hpp"
#include "scene/body_solid.hpp"
#include "scene/driven_motion.hpp"
#include "scene/grid_fault.hpp"
#include "scene/grid_lines.hpp"
#include "scene/point_file.hpp"
#include "scene/stages.hpp"

namespace stillpoint {
namespace {

constexpr int r = 3;  // the number of the component r, after x, y, z

void resolve_state(Problem& problem) {
  const auto told = std::ranges::find_if(problem.bodies, [](const BodySpec& body) { return body.state.has_value(); });
  problem.state = told != problem.bodies.end() ? *told->state
                  : problem.dim == 1           ? StressState::uniaxial_stress
                  : problem.dim == 2           ? StressState::plane_strain
                                               : StressState::space;
}

// The coordinates of an axisymmetric problem are r and z, which may be called so.
void resolve_component(SupportSpec& support) {
  if (const std::optional<int> asked = support.component.asked()) {
    support.component.become(*asked >= r ? *asked - r : *asked);
  } else {
    support.component.take(support.face ? axis_of(*support.face) : 0, "the normal of the face");
  }
}

// The outline of the points of a file, which loads on lines and rigid bodies need. The volume of a point of an
// axisymmetric body is that of its whole ring.
void take_outline(const Problem& problem, BodySpec& body, const PointFile& points) {
  body.outline = {};
  const auto is_on_line = [](const TractionSpec& one) { return !one.line.empty(); };
  const bool may_touch = problem.may_touch() || !problem.later_rigid.empty();
  if (problem.dim != 2 || (!may_touch && std::ranges::none_of(problem.tractions, is_on_line))) return;
  std::vector<double> area = points.volume;
  const bool axisymmetric = problem.state == StressState::axisymmetric;
  for (std::size_t p = 0; p < area.size(); ++p)
    area[p] /= axisymmetric ? 2 * std::numbers::pi * points.x[0][p] : body.area;
  body.outline = {.loops = outline_of_points(points.x[0], points.x[1], area),
                  .spacing = std::sqrt(*std::ranges::max_element(area))};
}

// True if the keys of a shape in space suffice to make a solid of it.
bool has_solid(const BodySpec& body) {
  const bool is_round = body.radius > 0 && body.inner_radius < body.radius;
  switch (body.shape()) {
    case BodyShape::polygon:
      return body.polygon.size() >= 3;
    case BodyShape::sphere:
      return is_round;
    case BodyShape::cylinder:
      return is_round && body.cylinder.size() == 2 && body.cylinder[0] != body.cylinder[1];
    case BodyShape::triangles:
      return body.from_stl.solid != nullptr;
    default:
      return false;
  }
}

// The extent of a grid that is given by pieces; none if the pieces are not in order.
void resolve_grid(const Problem& problem, GridSpec& grid) {
  if (!grid.is_by_pieces()) return;
  if (fault_of_pieces(problem).empty()) {
    take_extent_of_pieces(grid);
  } else {
    grid.min.clear(), grid.max.clear(), grid.cells.clear();
  }
}

class Resolution {
 public:
  Resolution(Problem& problem, const Catalogue& catalogue) : problem_(problem), catalogue_(catalogue) {}

  std::vector<FileMistake> run() {
    resolve_grid(problem_, problem_.grid);
    has_grid_ = fault_of_grid(problem_).empty();
    resolve_state(problem_);
    for (SupportSpec& support : problem_.supports) resolve_component(support);
    problem_.mass.kind.take(problem_.dim == 1 ? MassKind::consistent : MassKind::lumped, "by dim");
    for (std::size_t k = 0; k < problem_.bodies.size(); ++k) resolve_body(k);
    for (std::size_t k = 0; k < problem_.rigid.size(); ++k)
      if (RigidSpec& rigid = problem_.rigid[k]; !rigid.stl.empty())
        rigid.from_stl = triangles_in(rigid.stl, rigid.from_stl, FileMistake::Owner::rigid, k);
    if (has_grid_) resolve_positions();
    resolve_phases(problem_, catalogue_);
    resolve_stages(problem_);
    resolve_step();
    if (has_grid_) problem_.damping.alpha.take(usual_alpha(problem_), "by how loads and walls move");
    return std::move(mistakes_);
  }

 private:
  // Each surface point that closes makes the body stiffer by as much as a cell: near the critical step a damped motion
  // would open and close it for ever.
  void resolve_step() {
    constexpr double with_contact = 0.8;
    Choice<double>& fraction = problem_.integrator.step_fraction;
    if (!problem_.may_touch()) {
      fraction.take(IntegratorSpec().step_fraction);
    } else {
      fraction.take(with_contact, problem_.rigid.empty() ? "bodies touch each other" : "rigid bodies touch the body");
    }
  }

  void resolve_body(std::size_t k) {
    BodySpec& body = problem_.bodies[k];
    const GridSpec& grid = problem_.grid;
    if (body.points_per_cell.empty()) body.points_per_cell = BodySpec().points_per_cell;
    body.points_per_cell.resize(static_cast<std::size_t>(problem_.dim), body.points_per_cell.front());
    body.min.take(grid.min, "that of the grid");
    body.max.take(grid.max, "that of the grid");
    if (!body.file.empty()) return read_points(k);
    if (!body.stl.empty()) body.from_stl = triangles_in(body.stl, body.from_stl, FileMistake::Owner::body, k);
    if (!body.mesh.empty()) read_mesh(k);
    if (!has_grid_) return;
    if (problem_.dim == 2 && !body.polygon.empty()) return resolve_polygon(body);
    resolve_box(body);
    if (problem_.dim == 3 && body.has_shape() && body.min.size() == 3 && body.max.size() == 3) resolve_solid(body);
  }

  void resolve_box(BodySpec& body) {
    for (Choice<std::vector<double>>* const corner : {&body.min, &body.max}) {
      std::vector<double> position = *corner;
      move_into(position, problem_.grid.min, problem_.grid.max, problem_.grid);
      snap_to_lines(position, problem_.grid);
      corner->become(std::move(position));
    }
  }

  void resolve_polygon(BodySpec& body) {
    std::vector<double> low = body.polygon.front(), high = low;
    for (std::vector<double>& corner : body.polygon) {
      move_into(corner, problem_.grid.min, problem_.grid.max, problem_.grid);
      snap_to_lines(corner, problem_.grid);
      for (std::size_t axis = 0; axis < std::min(corner.size(), low.size()); ++axis) {
        low[axis] = std::min(low[axis], corner[axis]);
        high[axis] = std::max(high[axis], corner[axis]);
      }
    }
    body.min.become(std::move(low));
    body.max.become(std::move(high));
  }

  void resolve_solid(BodySpec& body) {
    const auto axes = across(static_cast<std::size_t>(body.axis));
    for (std::vector<double>& corner : body.polygon) {
      if (corner.size() != 2) return;
      std::vector<double> position = problem_.grid.min;
      for (std::size_t d = 0; d < 2; ++d) position[axes[d]] = corner[d];
      snap_to_lines(position, problem_.grid);
      for (std::size_t d = 0; d < 2; ++d) corner[d] = position[axes[d]];
    }
    if (!has_solid(body)) return;
    const SpaceBox part = in_common(solid_of(body)->bounds(), box_of(body));
    if (!(part.volume() > 0)) return;
    std::vector<double> low(part.low.begin(), part.low.end()), high(part.high.begin(), part.high.end());
    snap_to_lines(low, problem_.grid);
    snap_to_lines(high, problem_.grid);
    body.min.become(std::move(low));
    body.max.become(std::move(high));
  }

  // In the plane its border becomes a polygon, in space a surface of triangles.
  void read_mesh(std::size_t k) {
    BodySpec& body = problem_.bodies[k];
    if (body.material.empty()) body.material = body.group;
    std::vector<Mistake> found;
    if (problem_.dim == 2 && body.polygon.empty()) {
      for (const PlanePoint& corner : read_mesh_outline(body, found)) body.polygon.push_back({corner[0], corner[1]});
    } else if (problem_.dim == 3) {
      body.from_stl = {.file = body.mesh, .solid = read_mesh_solid(body, found)};
    }
    keep({FileMistake::Owner::body, k, "mesh", body.mesh, {}}, found);
  }

  StlSolid triangles_in(const std::filesystem::path& file, const StlSolid& known, FileMistake::Owner owner,
                        std::size_t number) {
    std::vector<Mistake> found;
    StlSolid triangles{.file = file, .solid = read_stl_solid(file, known, found)};
    keep({owner, number, "stl", file, {}}, found);
    return triangles;
  }

  void read_points(std::size_t k) {
    BodySpec& body = problem_.bodies[k];
    const auto axes = static_cast<std::size_t>(problem_.dim);
    std::vector<double> min(axes, -std::numeric_limits<double>::infinity());
    std::vector<double> max(axes, std::numeric_limits<double>::infinity());
    if (has_grid_) min = problem_.grid.min, max = problem_.grid.max;
    std::vector<Mistake> found;
    const PointFile points = read_point_file(body.file, min, max, found);
    if (found.empty() && has_grid_) {
      for (std::size_t axis = 0; axis < points.x.size(); ++axis) {
        const auto [low, high] = std::ranges::minmax_element(points.x[axis]);
        min[axis] = *low;
        max[axis] = *high;
      }
      body.min.become(std::move(min));
      body.max.become(std::move(max));
      take_outline(problem_, body, points);
    }
    keep({FileMistake::Owner::body, k, "file", body.file, {}}, found);
  }

  void keep(FileMistake of_file, std::vector<Mistake>& found) {
    for (Mistake& mistake : found) {
      of_file.mistake = std::move(mistake);
      mistakes_.push_back(of_file);
    }
  }

  // Moves supports, forces and probes that miss the grid or a body by a sliver onto its border.
  void resolve_positions() {
    const GridSpec& grid = problem_.grid;
    for (SupportSpec& support : problem_.supports) move_into(support.at, grid.min, grid.max, grid);
    if (problem_.bodies.empty()) return;
    const auto [low, high] = box_around(problem_.bodies);
    for (PointForceSpec& force : problem_.forces) move_into(force.at, low, high, grid);
    for (ProbeSpec& probe : problem_.probes) {
      const bool moves = probe.frame == ProbeFrame::material;
      move_into(probe.at, moves ? low : grid.min, moves ? high : grid.max, grid);
    }
  }

  Problem& problem_;
  const Catalogue& catalogue_;
  bool has_grid_ = false;
  std::vector<FileMistake> mistakes_;
};

}  // namespace

std::vector<FileMistake> resolve(Problem& problem, const Catalogue& catalogue) {
  return Resolution(problem, catalogue).run();
}

}  // namespace stillpoint
