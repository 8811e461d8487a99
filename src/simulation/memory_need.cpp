// The bytes a point are those of the arrays that a phase has; what unknowns take was measured on plates of 8e4 to 1e6
// of them, and on lines.
#include "simulation/memory_need.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "base/memory_room.hpp"
#include "scene/support_kind.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/highest_frequency.hpp"
#include "simulation/multigrid_choice.hpp"
#include "simulation/omega_1_needs.hpp"
#include "solvers/relaxation/conjugate_descent.hpp"
#include "solvers/statics/static_methods.hpp"
#include "space/kernels/elastic_cells.hpp"
#include "space/materials/point_material.hpp"

namespace stillpoint {
namespace {

constexpr double real = sizeof(double);
constexpr double of_entry = sizeof(double) + sizeof(int);  // of a sparse matrix

bool averages_dilatation(const Scene& scene) { return scene.dim > 1 && scene.phase.dilatation != Dilatation::points; }
// Splines whose means points share are those of degree p − 1, see SplineMeans.
bool means_over_splines(const Scene& scene) {
  return averages_dilatation(scene) && scene.phase.dilatation == Dilatation::splines && degree_of(scene.grid.basis) > 1;
}
bool moves_on(const Scene& scene) { return scene.phase.max_motion || scene.phase.max_strain; }

// --- the points ------------------------------------------------------------------------------------------------------

// What a law keeps of a point.
double of_law(const Scene& scene, const MaterialSpec& material) {
  const auto bytes = [&](const auto& made) {
    double sum = 0;
    for (const PointArray& array : made->arrays()) sum += array.bytes_per_point;
    if (averages_dilatation(scene)) {
      // What a tangent of averaged cells has no use for; and of its volume, and of its mean, committed and tried.
      sum += static_cast<double>(made->info().history_size) * real;
      sum += (made->info().history_dependent ? 3 : 2) * real;
    }
    return sum;
  };
  switch (kinematics(scene.state)) {
    case Kinematics::line:
      return bytes(make_point_material<Kinematics::line>(material, scene.state, 0, 1, moves_on(scene)));
    case Kinematics::plane:
      return bytes(make_point_material<Kinematics::plane>(material, scene.state, 0, 1, moves_on(scene)));
    case Kinematics::axisymmetric:
      return bytes(make_point_material<Kinematics::axisymmetric>(material, scene.state, 0, 1, moves_on(scene)));
    case Kinematics::space:
      break;
  }
  return bytes(make_point_material<Kinematics::space>(material, scene.state, 0, 1, moves_on(scene)));
}

double of_weights(const Scene& scene) {
  const bool of_domains = scene.phase.quadrature == Quadrature::domains;
  const bool is_linear = scene.grid.basis == BasisKind::linear;
  if (scene.dim == 2 && is_linear && !of_domains) return scene.dim * real;
  if (scene.dim == 3)
    return is_linear ? 0.0 : 2 * scene.dim * (degree_of(scene.grid.basis) + 1) * real;  // factors, see PointWeights
  const double functions = std::pow(degree_of(scene.grid.basis) + (of_domains ? 2 : 1), scene.dim);
  return functions * (1 + scene.dim + (scene.state == StressState::axisymmetric ? 1 : 0)) * real;
}

double of_motion(const Scene& scene) {
  if (!moves_on(scene)) return 0;
  double numbers = 2 * scene.dim;  // velocity, and position at the start
  if (scene.phase.transfer == Transfer::apic) numbers += scene.dim * scene.dim;
  if (scene.phase.quadrature == Quadrature::domains) numbers += (scene.dim << scene.dim) + scene.dim;
  return numbers * real;
}

const LawInfo& law_of(const Scene& scene, const BodySpec& body) {
  return *catalogue().law(scene.materials.at(body.material).law);
}
bool remembers(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [&](const BodySpec& one) { return law_of(scene, one).history_dependent; });
}
bool is_nonlinear(const Scene& scene) {
  return remembers(scene) ||
         std::ranges::any_of(scene.bodies, [&](const BodySpec& one) { return law_of(scene, one).finite_strain; });
}

// Of linear elastic cells of a linear basis.
double of_moments(const Scene& scene, const BodySize& size) {
  const bool takes_moments = scene.dim > 1 && scene.state != StressState::axisymmetric &&
                             scene.grid.basis == BasisKind::linear && scene.phase.quadrature == Quadrature::points &&
                             !is_nonlinear(scene) && !moves_on(scene) && !scene.geostatic;
  if (!takes_moments) return 0;
  const double of_cell = scene.dim == 2 ? ElasticCells<2>::bytes_per_cell : ElasticCells<3>::bytes_per_cell;
  return of_cell * size.cells / size.points;
}

double bytes_per_point(const Scene& scene, const BodySize& size) {
  double laws = 0;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k)
    laws += size.body_points[k] / size.points * of_law(scene, scene.materials.at(scene.bodies[k].material));
  const double of_any = (scene.dim + 2) * real + sizeof(int);  // position, mass, volume; number
  return of_any + of_weights(scene) + of_motion(scene) + of_moments(scene, size) + laws;
}

// --- the unknowns ----------------------------------------------------------------------------------------------------

// Neighbours of a function, itself included, along an axis: those that share a cell with it; or those that feel the
// same means, through p splines of degree p − 1 to either side of those that they share cells with.
double own_neighbours_along(const Scene& scene) {
  return scene.grid.basis == BasisKind::hermite ? 6 : 2 * degree_of(scene.grid.basis) + 1;
}
double neighbours_along(const Scene& scene) {
  if (!means_over_splines(scene)) return own_neighbours_along(scene);
  const int p = degree_of(scene.grid.basis), values = scene.grid.basis == BasisKind::hermite ? 2 : 1;
  return own_neighbours_along(scene) + 2 * values * (p + (p - 1) * (2 * p - 1));
}
double neighbours(const Scene& scene) { return std::pow(neighbours_along(scene), scene.dim); }

// Entries of a column of L. With nested dissection their number grows with log n in the plane, and in space as the
// surface of what divides the body, n^(1/3); no more than the band.
double entries_of_factor(const Scene& scene, const BodySize& size) {
  if (scene.dim == 1) return scene.dim * neighbours(scene);
  constexpr double measured_at = 1e5, by_octave = 0.03;
  constexpr double in_the_plane[] = {125, 340, 620, 760}, in_space[] = {27, 68, 110};
  const auto basis = static_cast<std::size_t>(scene.grid.basis);
  const double growth = 1 + by_octave * std::log2(std::max(size.unknowns, 1.0) / measured_at);
  const double by_means = neighbours_along(scene) / own_neighbours_along(scene);  // what separates parts is wider
  const double entries = by_means * (scene.dim == 2 ? std::max(0.5, growth) * in_the_plane[basis]
                                                    : std::cbrt(size.unknowns) * in_space[basis]);
  return std::min(entries, 2 * by_means * size.width);
}

double of_matrix(const Scene& scene, const BodySize& size) {
  return of_entry * scene.dim * neighbours(scene) * size.unknowns;
}

double of_factor(const Scene& scene, const BodySize& size) {
  return real * entries_of_factor(scene, size) * size.unknowns;
}

// Of a line or plane with what cells have at their corners, as measured.
double vectors(const Scene& scene) { return scene.dim == 3 ? 11 : 25; }

// In space, where a cell has eight functions or more for the three unknowns that it brings: a force, two numbers of the
// function, and, as a phase begins, what points give to it (NodalTotals).
double of_corners(const Scene& scene, const BodySize& size) {
  if (scene.dim < 3) return 0;
  const double functions = std::pow(degree_of(scene.grid.basis) + 1, scene.dim);
  return functions * (scene.dim * real + 2 * sizeof(int) + (2 + scene.dim) * real) * size.cells;
}

// The block of a column for every neighbour, of all functions of the grid, from which a matrix is made.
double of_assembly(const Scene& scene, const BodySize& size) {
  const double along = 2 * degree_of(scene.grid.basis) + 1;
  return size.grid_functions * std::pow(along, scene.dim) * scene.dim * scene.dim * real;
}

// Those of loads and supports that vary, as muParser has them: one for the schedule of the loads, one for the phase.
MemoryNeed::Part formulas(const Scene& scene) {
  constexpr double of_one = 5000;
  MemoryNeed::Part part{.what = "formulas", .bytes = 0, .key = ""};
  scene.for_each_formula([&](const std::string& key, const Expression& formula) {
    if (formula.constant()) return;
    part.bytes += 2 * of_one;
    if (part.key.empty()) part.key = key;
  });
  return part;
}

// Of supports on faces.
MemoryNeed::Part springs(const Scene& scene) {
  constexpr double of_one = 1500;
  MemoryNeed::Part part{.what = "springs of supports", .bytes = 0, .key = ""};
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    const SupportSpec& support = scene.supports[k];
    if (!support.face || !holds_by_springs(scene.grid, support)) continue;
    double springs = support.roller ? 1 : scene.dim;
    for (const FaceInterval& held : held_part(scene.grid, support)) {
      int to_a_cell = 3;
      for (const BodySpec& body : scene.bodies) to_a_cell = std::max(to_a_cell, body.points_per_cell[held.along]);
      springs *= (held.to - held.from) / scene.grid.cell_length(held.along) * to_a_cell;
    }
    part.bytes += springs * of_one;
    if (part.key.empty()) part.key = fmt::format("support[{}]", k);
  }
  return part;
}

bool factorises(const Scene& scene, const BodySize& size) {
  const StaticMethodInfo* method = catalogue().static_method(scene.solve.method);
  const bool solves = method && method->is_newton && linear_solver_of(scene.solve.method) != LinearSolver::iterative;
  const RelaxationInfo* relaxation = scene.solve.is_static() ? nullptr : find_relaxation(scene.damping.strategy);
  const bool steps_tell = relaxation && relaxation->chooses_mass && wants_equilibrium_only(scene) &&
                          !is_nonlinear(scene) && !moves_on(scene);
  return solves || omega_1_needs(scene, static_cast<std::size_t>(size.unknowns), steps_tell).any();
}

// As asked for, or as auto may choose.
bool takes_multigrid(const Scene& scene, const BodySize& size) {
  if (scene.mass.kind == MassKind::multigrid) return true;
  const RelaxationInfo* relaxation = scene.solve.is_static() ? nullptr : find_relaxation(scene.damping.strategy);
  return relaxation && relaxation->chooses_mass && !remembers(scene) && !moves_on(scene) && scene.walls.empty() &&
         multigrid_pays(scene, size.unknowns, !is_nonlinear(scene));
}

}  // namespace

double MemoryNeed::total() const {
  return std::accumulate(parts.begin(), parts.end(), 0.0,
                         [](double sum, const Part& part) { return sum + part.bytes; });
}

MemoryNeed memory_need(const Scene& scene) {
  const BodySize size = body_size(scene);
  MemoryNeed need{.size = size, .bytes_per_point = bytes_per_point(scene, size), .parts = {}};
  const auto add = [&](const char* what, double bytes, const std::string& key) {
    if (bytes > 0) need.parts.push_back({what, bytes, key});
  };
  const RelaxationInfo* relaxation = scene.solve.is_static() ? nullptr : find_relaxation(scene.damping.strategy);
  const bool chooses_mass = relaxation && relaxation->chooses_mass && wants_equilibrium_only(scene);
  constexpr double while_placed = 60, while_moving = 100;  // bytes a point of copies, for a while
  add("material points", size.points * need.bytes_per_point, size.most_points);
  if (chooses_mass) add("the same with another mass", size.points * need.bytes_per_point, size.most_points);
  add("points as they are placed", size.points * (while_placed + (moves_on(scene) ? while_moving : 0)),
      size.most_points);
  add("vectors of unknowns", vectors(scene) * real * size.unknowns, "grid.cells");
  add("forces of cells at their corners", of_corners(scene, size), "grid.cells");
  if (chooses_mass && is_nonlinear(scene))
    add("steps that auto remembers", 2 * ConjugateDescent::memory * real * size.unknowns, "grid.cells");

  constexpr double little = 1e7;
  if (const MemoryNeed::Part of_loads = formulas(scene); of_loads.bytes > little) need.parts.push_back(of_loads);
  if (const MemoryNeed::Part of_springs = springs(scene); of_springs.bytes > little) need.parts.push_back(of_springs);
  const bool consistent = scene.mass.kind == MassKind::consistent;
  const bool multigrid = takes_multigrid(scene, size), factor = !multigrid && factorises(scene, size);
  if (multigrid) {
    // K, the module's copy of it, transfers and coarser levels.
    constexpr double of_hierarchy = 2.0;
    add("stiffness matrix", of_matrix(scene, size), "grid.cells");
    add("hierarchy of multigrid", of_hierarchy * of_matrix(scene, size), "grid.cells");
  }
  const StaticMethodInfo* const solver = catalogue().static_method(scene.solve.method);
  const bool multiplies = multigrid && solver && solver->is_newton;
  if (multiplies) add("stiffness matrix by columns and by rows", 2 * of_matrix(scene, size), "grid.cells");
  if (factor || consistent || multiplies || (multigrid && chooses_mass))
    add("a matrix as it is assembled", of_assembly(scene, size), "grid.cells");
  if (consistent)
    // As it was assembled, and as it is factorised.
    add("mass matrix and its factor", (2 * of_matrix(scene, size) + of_factor(scene, size)) / scene.dim, "grid.cells");
  if (factor) {
    add("stiffness matrix", (is_nonlinear(scene) ? 4 : 2) * of_matrix(scene, size), "grid.cells");
    if (means_over_splines(scene)) add("its products with means", 1.5 * of_matrix(scene, size), "grid.cells");
    add("factor of the stiffness", of_factor(scene, size), "grid.cells");
  }
  return need;
}

bool has_room_for_factor(const Scene& scene) {
  constexpr double most_entries = std::numeric_limits<int>::max();  // that CHOLMOD numbers
  const BodySize size = body_size(scene);
  if (entries_of_factor(scene, size) * size.unknowns > most_entries) return false;
  return of_assembly(scene, size) + 2 * of_matrix(scene, size) + of_factor(scene, size) <= memory_room().bytes;
}

MemoryNeed require_memory(const Scene& scene) {
  MemoryNeed need = memory_need(scene);
  const MemoryRoom room = memory_room();
  if (need.total() <= room.bytes) return need;
  std::vector<std::string> parts;
  for (const auto& part : need.parts) parts.push_back(fmt::format("{} {:.3g} GB", part.what, part.bytes / 1e9));
  const auto largest = std::ranges::max_element(need.parts, {}, &MemoryNeed::Part::bytes);
  throw_scene_error(
      scene, largest->key,
      fmt::format("the run needs about {:.3g} GB of memory ({}), and {} leaves {:.3g} GB; expected fewer "
                  "cells or points, or a basis of lower degree{}",
                  need.total() / 1e9, fmt::join(parts, ", "), room.set_by, room.bytes / 1e9,
                  factorises(scene, need.size) ? ", or damping.strategy = \"auto\", which makes no factor "
                                                 "of a large body"
                                               : ""));
}

}  // namespace stillpoint
