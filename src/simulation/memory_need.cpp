// The bytes a point are those of the arrays that a phase has; what unknowns take was measured, see matrix_size.hpp too.
#include "simulation/memory_need.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/memory_room.hpp"
#include "scene/dimensions.hpp"
#include "scene/support_kind.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/highest_frequency.hpp"
#include "simulation/matrix_size.hpp"
#include "simulation/multigrid_choice.hpp"
#include "simulation/omega_1_needs.hpp"
#include "simulation/scene_motion.hpp"
#include "solvers/relaxation/conjugate_descent.hpp"
#include "solvers/statics/static_methods.hpp"
#include "space/grid/domain_basis.hpp"
#include "space/kernels/elastic_cells.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/materials/point_material.hpp"
#include "space/materials/with_kinematics.hpp"

namespace stillpoint {
namespace {

constexpr double real = sizeof(double);

// --- the points ------------------------------------------------------------------------------------------------------

// What a law keeps of a point.
double of_law(const Problem& problem, const MaterialSpec& material) {
  const auto bytes = [&](const auto& made) {
    double sum = 0;
    for (const PointArray& array : made->arrays()) sum += array.bytes_per_point;
    if (averages_dilatation(problem)) {
      // What a tangent of averaged cells has no use for; and of its volume, and of its mean, committed and tried.
      sum += static_cast<double>(made->info().history_size) * real;
      sum += (made->info().history_dependent ? 3 : 2) * real;
    }
    return sum;
  };
  return with_kinematics(kinematics(problem.state), [&]<Kinematics K>() {
    return bytes(make_point_material<K>(material, problem.state, 0, 1, problem.phase.ends()));
  });
}

template <AxisBasis B, Kinematics K>
double weights_of() {
  double sum = 0;
  for (const PointArray& array : PointWeights<B, K>::arrays()) sum += array.bytes_per_point;
  return sum;
}
double of_weights(const Problem& problem) {
  const bool of_domains = problem.phase.quadrature == Quadrature::domains;
  return with_kinematics(kinematics(problem.state), [&]<Kinematics K>() {
    switch (problem.grid.basis) {
      case BasisKind::linear:
        return of_domains ? weights_of<DomainBSpline<1>, K>() : weights_of<BSpline<1>, K>();
      case BasisKind::quadratic:
        return of_domains ? weights_of<DomainBSpline<2>, K>() : weights_of<BSpline<2>, K>();
      case BasisKind::cubic:
        return of_domains ? weights_of<DomainBSpline<3>, K>() : weights_of<BSpline<3>, K>();
      case BasisKind::hermite:
        break;
    }
    return weights_of<CubicHermite, K>();
  });
}

double of_motion(const Problem& problem) {
  if (!problem.phase.ends()) return 0;
  double numbers = 2 * problem.dim;  // velocity, and position at the start
  if (problem.phase.transfer == Transfer::apic) numbers += problem.dim * problem.dim;
  if (problem.phase.quadrature == Quadrature::domains) numbers += (problem.dim << problem.dim) + problem.dim;
  return numbers * real;
}

// Of linear elastic cells of a linear basis; those of a line keep none.
double of_moments(const Problem& problem, const BodySize& size) {
  const bool takes_moments = problem.state != StressState::axisymmetric && problem.grid.basis == BasisKind::linear &&
                             problem.phase.quadrature == Quadrature::points && !is_nonlinear(problem) &&
                             !problem.phase.ends() && !problem.geostatic;
  if (!takes_moments) return 0;
  constexpr std::array of_cells{0.0, ElasticCells<2>::bytes_per_cell, ElasticCells<3>::bytes_per_cell};
  const double of_cell = of_dimension(of_cells, problem.dim);
  return of_cell * size.cells / size.points;
}

double bytes_per_point(const Problem& problem, const BodySize& size) {
  double laws = 0;
  for (std::size_t k = 0; k < problem.bodies.size(); ++k)
    laws += size.body_points[k] / size.points * of_law(problem, problem.materials.at(problem.bodies[k].material));
  const double of_any = (problem.dim + 2) * real + sizeof(int);  // position, mass, volume; number
  return of_any + of_weights(problem) + of_motion(problem) + of_moments(problem, size) + laws;
}

// --- the unknowns ----------------------------------------------------------------------------------------------------

// Numbers an unknown as measured, of a line or a plane with what cells have at their corners. In space, where a cell
// has eight functions or more for the three unknowns that it brings, that is counted by itself: a force, two numbers of
// the function, and, as a phase begins, what points give to it (NodalTotals).
struct VectorsOf {
  double numbers;
  bool corners_apart;
};
constexpr std::array<VectorsOf, 3> vectors_of{{{25, false}, {25, false}, {11, true}}};

double of_vectors(const Problem& problem, const BodySize& size) {
  return of_dimension(vectors_of, problem.dim).numbers * real * size.unknowns;
}
double of_corners(const Problem& problem, const BodySize& size) {
  if (!of_dimension(vectors_of, problem.dim).corners_apart) return 0;
  const double functions = std::pow(degree_of(problem.grid.basis) + 1, problem.dim);
  return functions * (problem.dim * real + 2 * sizeof(int) + (2 + problem.dim) * real) * size.cells;
}

// Those of loads and supports that vary, as muParser has them: one for the schedule of the loads, one for the phase.
MemoryNeed::Part formulas(const Problem& problem) {
  constexpr double of_one = 5000;
  MemoryNeed::Part part{.what = "formulas", .bytes = 0, .key = ""};
  problem.for_each_formula([&](const std::string& key, const Expression& formula) {
    if (formula.constant()) return;
    part.bytes += 2 * of_one;
    if (part.key.empty()) part.key = key;
  });
  return part;
}

// Of supports on faces.
MemoryNeed::Part springs(const Problem& problem) {
  constexpr double of_one = 1500;
  MemoryNeed::Part part{.what = "springs of supports", .bytes = 0, .key = ""};
  for (std::size_t k = 0; k < problem.supports.size(); ++k) {
    const SupportSpec& support = problem.supports[k];
    if (!support.face || !holds_by_springs(problem.grid, support)) continue;
    double springs = support.holds_one_component() ? 1 : problem.dim;
    for (const FaceInterval& held : held_part(problem.grid, support)) {
      int to_a_cell = 3;
      for (const BodySpec& body : problem.bodies) to_a_cell = std::max(to_a_cell, body.points_per_cell[held.along]);
      springs *= (held.to - held.from) / problem.grid.cell_length(held.along) * to_a_cell;
    }
    part.bytes += springs * of_one;
    if (part.key.empty()) part.key = fmt::format("support[{}]", k);
  }
  return part;
}

bool factorises(const Problem& problem, const BodySize& size) {
  const StaticMethodInfo* method = catalogue().static_method(problem.solve.method);
  const bool solves = method && method->is_newton && linear_solver_of(problem.solve.method) != LinearSolver::iterative;
  const bool steps_tell =
      steps_tell_omega_1(problem, {.linear = !is_nonlinear(problem), .moves_on = problem.phase.ends()});
  return solves || omega_1_needs(problem, static_cast<std::size_t>(size.unknowns), steps_tell).any();
}

// As asked for, or as auto may choose.
bool takes_multigrid(const Problem& problem, const BodySize& size) {
  if (problem.mass.kind == MassKind::multigrid) return true;
  return chooses_mass(problem) && !remembers(problem) && !problem.phase.ends() && problem.walls.empty() &&
         multigrid_pays(problem, size.unknowns, !is_nonlinear(problem));
}

}  // namespace

double MemoryNeed::total() const {
  return std::accumulate(parts.begin(), parts.end(), 0.0,
                         [](double sum, const Part& part) { return sum + part.bytes; });
}

MemoryNeed memory_need(const Problem& problem) {
  const BodySize size = body_size(problem);
  MemoryNeed need{.size = size, .bytes_per_point = bytes_per_point(problem, size), .parts = {}};
  const auto add = [&](const char* what, double bytes, const std::string& key) {
    if (bytes > 0) need.parts.push_back({what, bytes, key});
  };
  const bool tries_another_mass = chooses_mass(problem) && wants_equilibrium_only(problem);
  // Bytes a point of copies, for a while: as points are placed and sorted, or, later, of their displacement and stress
  // as they are shown.
  constexpr double while_placed = 60, while_moving = 100;
  const double while_shown = (problem.dim + stress_components(problem.state)) * real;
  add("material points", size.points * need.bytes_per_point, size.most_points);
  if (tries_another_mass) add("the same with another mass", size.points * need.bytes_per_point, size.most_points);
  add("points as they are placed and shown",
      size.points * (std::max(while_placed, while_shown) + (problem.phase.ends() ? while_moving : 0)),
      size.most_points);
  add("vectors of unknowns", of_vectors(problem, size), "grid.cells");
  add("forces of cells at their corners", of_corners(problem, size), "grid.cells");
  if (tries_another_mass && is_nonlinear(problem))
    add("steps that auto remembers", 2 * ConjugateDescent::memory * real * size.unknowns, "grid.cells");

  if (!problem.own_load.empty())
    add("positions and forces of the program's own load", 2 * problem.dim * real * size.points, size.most_points);

  constexpr double little = 1e7;
  if (const MemoryNeed::Part of_loads = formulas(problem); of_loads.bytes > little) need.parts.push_back(of_loads);
  if (const MemoryNeed::Part of_springs = springs(problem); of_springs.bytes > little) need.parts.push_back(of_springs);
  const bool consistent = problem.mass.kind == MassKind::consistent;
  const bool multigrid = takes_multigrid(problem, size), factor = !multigrid && factorises(problem, size);
  if (multigrid) {
    // K, the module's copy of it, transfers and coarser levels.
    constexpr double of_hierarchy = 2.0;
    add("stiffness matrix", bytes_of_matrix(problem, size), "grid.cells");
    add("hierarchy of multigrid", of_hierarchy * bytes_of_matrix(problem, size), "grid.cells");
  }
  const StaticMethodInfo* const solver = catalogue().static_method(problem.solve.method);
  const bool multiplies = multigrid && solver && solver->is_newton;
  if (multiplies) add("stiffness matrix by columns and by rows", 2 * bytes_of_matrix(problem, size), "grid.cells");
  if (factor || consistent || multiplies || (multigrid && tries_another_mass))
    add("a matrix as it is assembled", bytes_of_assembly(problem, size), "grid.cells");
  if (consistent)
    // As it was assembled, and as it is factorised.
    add("mass matrix and its factor",
        (2 * bytes_of_matrix(problem, size) + bytes_of_factor(problem, size)) / problem.dim, "grid.cells");
  if (factor) {
    add("stiffness matrix", (is_nonlinear(problem) ? 4 : 2) * bytes_of_matrix(problem, size), "grid.cells");
    if (means_over_splines(problem)) add("its products with means", 1.5 * bytes_of_matrix(problem, size), "grid.cells");
    add("factor of the stiffness", bytes_of_factor(problem, size), "grid.cells");
  }
  return need;
}

MemoryNeed require_memory(const Problem& problem) {
  MemoryNeed need = memory_need(problem);
  const MemoryRoom room = memory_room();
  if (need.total() <= room.bytes) return need;
  std::vector<std::string> parts;
  for (const auto& part : need.parts) parts.push_back(fmt::format("{} {:.3g} GB", part.what, part.bytes / 1e9));
  const auto largest = std::ranges::max_element(need.parts, {}, &MemoryNeed::Part::bytes);
  throw_scene_error(
      largest->key,
      fmt::format("the run needs about {:.3g} GB of memory ({}), and {} leaves {:.3g} GB; expected fewer "
                  "cells or points, or a basis of lower degree{}",
                  need.total() / 1e9, fmt::join(parts, ", "), room.set_by, room.bytes / 1e9,
                  factorises(problem, need.size) ? ", or damping.strategy = \"auto\", which makes no factor "
                                                   "of a large body"
                                                 : ""));
}

}  // namespace stillpoint
