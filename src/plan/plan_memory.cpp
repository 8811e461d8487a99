// The memory that a plan takes. The bytes a point are those of the arrays that a phase has; what unknowns take was
// measured.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plan/plan.hpp"
#include "scene/dimensions.hpp"
#include "scene/point_sums.hpp"
#include "scene/support_kind.hpp"
#include "scene/throw_scene_error.hpp"
#include "solvers/relaxation/conjugate_descent.hpp"
#include "space/grid/domain_basis.hpp"
#include "space/kernels/elastic_cells.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/materials/point_material.hpp"
#include "space/materials/with_kinematics.hpp"

namespace stillpoint {
namespace {

constexpr double real = sizeof(double);

double bytes_of(const std::vector<PointArray>& arrays) {
  double sum = 0;
  for (const PointArray& array : arrays) sum += array.bytes_per_point;
  return sum;
}

// --- bytes a point ---------------------------------------------------------------------------------------------------

double bytes_of_law(const Problem& problem, const MaterialSpec& material) {
  return with_kinematics(kinematics(problem.state), [&]<Kinematics K>() {
    const auto law = make_point_material<K>(material, problem.state, 0, 1, problem.phase.ends());
    if (!averages_dilatation(problem)) return bytes_of(law->arrays());
    // A tangent of averaged cells writes a history that nobody reads. Each point has its share of the volume, and the
    // effect of averaging: as it was committed, and for a law with a history also as it is tried.
    const double effects = law->info().history_dependent ? 2 : 1;
    return bytes_of(law->arrays()) + (static_cast<double>(law->info().history_size) + 1 + effects) * real;
  });
}

double bytes_of_weights(const Problem& problem) {
  const bool domains = problem.phase.quadrature == Quadrature::domains;
  return with_kinematics(kinematics(problem.state), [&]<Kinematics K>() {
    const auto of_degree = [&]<int Degree>() {
      return bytes_of(domains ? PointWeights<DomainBSpline<Degree>, K>::arrays()
                              : PointWeights<BSpline<Degree>, K>::arrays());
    };
    switch (problem.grid.basis) {
      case BasisKind::linear:
        return of_degree.template operator()<1>();
      case BasisKind::quadratic:
        return of_degree.template operator()<2>();
      case BasisKind::cubic:
        return of_degree.template operator()<3>();
      case BasisKind::hermite:
        break;
    }
    return bytes_of(PointWeights<CubicHermite, K>::arrays());
  });
}

double bytes_of_motion(const Problem& problem) {
  if (!problem.phase.ends()) return 0;
  double numbers = 2 * problem.dim;  // velocity, and position at the start
  if (problem.phase.transfer == Transfer::apic) numbers += problem.dim * problem.dim;
  if (problem.phase.quadrature == Quadrature::domains) numbers += (problem.dim << problem.dim) + problem.dim;
  return numbers * real;
}

double bytes_of_moments(const Problem& problem, const Plan& plan) {
  if (!moments_stand_in_for_points(problem, plan.nonlinear_law)) return 0;
  const double of_cell = problem.dim == 2 ? ElasticCells<2>::bytes_per_cell : ElasticCells<3>::bytes_per_cell;
  return of_cell * plan.size.cells / plan.size.points;
}

double bytes_per_point(const Problem& problem, const Plan& plan) {
  double laws = 0;
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    const double share = plan.size.body_points[k] / plan.size.points;
    laws += share * bytes_of_law(problem, problem.materials.at(problem.bodies[k].material));
  }
  const double always = (problem.dim + 2) * real + sizeof(int);  // position, mass, volume; number
  return always + bytes_of_weights(problem) + bytes_of_motion(problem) + bytes_of_moments(problem, plan) + laws;
}

// --- bytes of unknowns and of what acts on them ----------------------------------------------------------------------

// Measured numbers for each unknown; on a line and in the plane they include what cells have at their corners.
constexpr std::array vectors_per_unknown{25.0, 25.0, 11.0};

double bytes_of_vectors(const Problem& problem, const BodySize& size) {
  return of_dimension(vectors_per_unknown, problem.dim) * real * size.unknowns;
}

// In space a cell has eight functions or more for the three unknowns that it brings: for each of them a force, two
// numbers of the function, and, as a phase begins, what points give to it (NodalTotals).
double bytes_of_corners(const Problem& problem, const BodySize& size) {
  if (problem.dim < 3) return 0;
  const double functions = std::pow(degree_of(problem.grid.basis) + 1, problem.dim);
  return functions * (problem.dim * real + 2 * sizeof(int) + (2 + problem.dim) * real) * size.cells;
}

// Each formula of a load or support that varies is compiled once, and kept as text with all that copies it.
MemoryPart memory_of_formulas(const Problem& problem) {
  constexpr double bytes_of_formula = 8500;  // measured with 20 000 of them
  MemoryPart part{.what = "formulas", .bytes = 0, .key = ""};
  problem.for_each_formula([&](const std::string& key, const Expression& formula) {
    if (formula.constant()) return;
    part.bytes += bytes_of_formula;
    if (part.key.empty()) part.key = key;
  });
  return part;
}

MemoryPart memory_of_springs(const Problem& problem) {
  constexpr double bytes_of_spring = 1500;
  MemoryPart part{.what = "springs of supports", .bytes = 0, .key = ""};
  for (std::size_t k = 0; k < problem.supports.size(); ++k) {
    const SupportSpec& support = problem.supports[k];
    if (!support.face || !holds_by_springs(problem.grid, support)) continue;
    double springs = support.holds_one_component() ? 1 : problem.dim;
    for (const FaceInterval& held : held_part(problem.grid, support)) {
      int per_cell = 3;
      for (const BodySpec& body : problem.bodies) per_cell = std::max(per_cell, body.points_per_cell[held.along]);
      springs *= cells_between(problem.grid, held.along, held.from, held.to) * per_cell;
    }
    part.bytes += springs * bytes_of_spring;
    if (part.key.empty()) part.key = fmt::format("support[{}]", k);
  }
  return part;
}

// Copies of points for a while, as they are placed and sorted, or, later, of their displacement and stress as they are
// shown, and as they move on.
double bytes_of_copies(const Problem& problem) {
  constexpr double while_placed = 60, while_moving = 100;
  const double while_shown = (problem.dim + stress_components(problem.state)) * real;
  return std::max(while_placed, while_shown) + (problem.phase.ends() ? while_moving : 0);
}

}  // namespace

double Plan::bytes() const {
  return std::accumulate(memory.begin(), memory.end(), 0.0,
                         [](double sum, const MemoryPart& part) { return sum + part.bytes; });
}

void plan_memory(const Problem& problem, Plan& plan) {
  const BodySize& size = plan.size;
  const auto add = [&](const char* what, double bytes, const std::string& key) {
    if (bytes > 0) plan.memory.push_back({what, bytes, key});
  };
  const auto add_if_large = [&](const MemoryPart& part) {
    constexpr double large = 1e7;  // [bytes]
    if (part.bytes > large) plan.memory.push_back(part);
  };
  plan.bytes_per_point = bytes_per_point(problem, plan);
  add("material points", size.points * plan.bytes_per_point, size.most_points);
  // Room for another mass is counted even if keys of [mass] leave auto no choice.
  const bool may_try_mass = plan.chooses_mass && plan.equilibrium_only;
  if (may_try_mass) add("the same with another mass", size.points * plan.bytes_per_point, size.most_points);
  add("points as they are placed and shown", size.points * bytes_of_copies(problem), size.most_points);
  add("vectors of unknowns", bytes_of_vectors(problem, size), "grid.cells");
  add("forces of cells at their corners", bytes_of_corners(problem, size), "grid.cells");
  if (may_try_mass && plan.nonlinear)
    add("steps that auto remembers", 2 * ConjugateDescent::memory * real * size.unknowns, "grid.cells");
  if (!problem.own_load.empty())
    add("positions and forces of the program's own load", 2 * problem.dim * real * size.points, size.most_points);
  add_if_large(memory_of_formulas(problem));
  add_if_large(memory_of_springs(problem));

  const double of_matrix = plan.stiffness.matrix, of_factor = plan.stiffness.factor();
  const bool consistent = problem.mass.kind == MassKind::consistent, factor = plan.makes_factor();
  const bool multiplies = plan.multigrid && plan.static_method && plan.static_method->is_newton;
  if (plan.multigrid) {
    constexpr double matrices_of_hierarchy = 2;  // the module's copy of K; transfers and coarser levels
    add("stiffness matrix", of_matrix, "grid.cells");
    add("hierarchy of multigrid", matrices_of_hierarchy * of_matrix, "grid.cells");
  }
  if (multiplies) add("stiffness matrix by columns and by rows", 2 * of_matrix, "grid.cells");
  if (factor || consistent || multiplies || (plan.multigrid && may_try_mass))
    add("a matrix as it is assembled", plan.stiffness.assembly, "grid.cells");
  if (consistent)  // as it was assembled, and as it is factorised
    add("mass matrix and its factor", (2 * of_matrix + of_factor) / problem.dim, "grid.cells");
  if (factor) {
    add("stiffness matrix", (plan.nonlinear ? 4 : 2) * of_matrix, "grid.cells");
    if (means_over_splines(problem)) add("its products with means", 1.5 * of_matrix, "grid.cells");
    add("factor of the stiffness", of_factor, "grid.cells");
  }
}

Plan require_memory(Plan plan) {
  if (plan.bytes() <= plan.room.bytes) return plan;
  std::vector<std::string> parts;
  for (const MemoryPart& part : plan.memory) parts.push_back(fmt::format("{} {:.3g} GB", part.what, part.bytes / 1e9));
  const auto largest = std::ranges::max_element(plan.memory, {}, &MemoryPart::bytes);
  throw_scene_error(
      largest->key,
      fmt::format("the run needs about {:.3g} GB of memory ({}), and {} leaves {:.3g} GB; expected fewer "
                  "cells or points, or a basis of lower degree{}",
                  plan.bytes() / 1e9, fmt::join(parts, ", "), plan.room.set_by, plan.room.bytes / 1e9,
                  plan.factorises ? ", or damping.strategy = \"auto\", which makes no factor of a large body" : ""));
}

}  // namespace stillpoint
