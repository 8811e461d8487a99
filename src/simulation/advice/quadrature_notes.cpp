#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/dimensions.hpp"
#include "scene/grid_lines.hpp"
#include "simulation/advice/notes.hpp"
#include "space/grid/basis.hpp"

namespace stillpoint {
namespace {

// A basis of degree p reaches into a share s of a cell with one function N ~ s^p, N' ~ s^(p−1), that is outside but for
// that. Its frequency, ω² = ∫N'²/∫N², grows as 1/s; with a lumped mass, ω² = ∫N'²/∫N ~ s^(p−2), as 1/√s for p = 1 and
// not at all for p > 1. A slope of Hermite's has a lumped mass of its own, and again 1/s.
bool sliver_shortens_the_step(const Problem& problem, const LagrangianPhase& phase, MassScaling scaling) {
  if (problem.solve.is_static()) return false;
  if (!phase.mass().is_lumped()) return true;
  const bool light_nodes_get_inertia = phase.info().updated_lagrangian || scaling == MassScaling::gershgorin;
  return !light_nodes_get_inertia &&
         (problem.grid.basis == BasisKind::linear || problem.grid.basis == BasisKind::hermite);
}

// The first body whose volumes the scene asks to be fitted, where that differs from equal ones: up to two uniform
// points along an axis are alike by symmetry.
std::string body_with_fitted_volumes(const Problem& problem) {
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    const BodySpec& body = problem.bodies[k];
    const bool by_symmetry = std::ranges::all_of(body.points_per_cell, [](int along) { return along <= 2; });
    if (!by_symmetry && body.volumes.asked() == VolumeRule::consistent)
      return problem.bodies.size() > 1 ? fmt::format("body[{}]", k) : "body";
  }
  return "";
}

// The fewest domains across a body of the plane. Only the mean of the strains in a domain counts: n domains across a
// body that bends have Σ_p V_p y_p² = (1 − 1/n²) ∫ y² dV.
double fewest_domains_across(const Problem& problem) {
  double fewest = std::numeric_limits<double>::infinity();
  const bool can_bend = !dimension_info(problem.dim).turns.empty();
  if (!can_bend || problem.phase.quadrature != Quadrature::domains) return fewest;
  for (const BodySpec& body : problem.bodies) {
    for (std::size_t d = 0; d < body.points_per_cell.size(); ++d) {
      fewest = std::min(fewest, cells_between(problem.grid, d, body.min[d], body.max[d]) * body.points_per_cell[d]);
    }
  }
  return fewest;
}

// The points of a cell, the same number along each axis, that are as many as a polynomial of a total degree has
// coefficients.
int fewest_gauss_points(int dim, int degree) {
  int coefficients = 1;  // (degree + dim) over dim
  for (int d = 1; d <= dim; ++d) coefficients = coefficients * (degree + d) / d;
  int along = 1;
  while (power(along, dim) < coefficients) ++along;
  return power(along, dim);
}

}  // namespace

// A basis of degree p keeps its order of convergence if the points integrate degree 2p − 2 in each coordinate [Strang
// and Fix 1973, 4.3]. In a cell that a body's border cuts they integrate a total degree m, and gradients of products
// of p have the total degree 2p − 1: what is missed of their work with a stress is of order m + 1 − (2p − 1) in h,
// which is p for m = 3p − 2.
std::vector<std::string> quadrature_notes(const Problem& problem, const LagrangianPhase& phase, MassScaling scaling) {
  std::vector<std::string> notes;
  const QuadratureReport quadrature = phase.shape().discretisation().quadrature;
  if (quadrature.cells_limited_by_sign > 0) {
    notes.push_back(fmt::format("in {} cells a fit of higher degree would need a negative volume; they integrate less",
                                quadrature.cells_limited_by_sign));
  }
  if (quadrature.joined > 0) {
    notes.push_back(fmt::format(
        "in {} cells that the body hardly reaches the outermost functions follow those further inside, for the "
        "frequencies' sake",
        quadrature.joined));
  }
  if (quadrature.smallest_share < 0.05 && quadrature.slivers > quadrature.joined &&
      sliver_shortens_the_step(problem, phase, scaling)) {
    notes.push_back(
        fmt::format("the body covers only {:.2g} of some cell's length, which shortens the critical step; expected its "
                    "faces on grid lines",
                    quadrature.smallest_share));
  }
  if (const std::string body = body_with_fitted_volumes(problem);
      problem.phase.quadrature == Quadrature::domains && !body.empty()) {
    notes.push_back(fmt::format(
        "{}.volumes = \"consistent\" is taken as equal: domains side by side fill their cells by equal volumes; "
        "phase.quadrature = \"points\" takes fitted ones",
        body));
  }
  if (const double n = fewest_domains_across(problem); n < 9.5) {
    notes.push_back(fmt::format(
        "{:.0f} domains lie across the body, of whose strains the means count: it bends by up to {:.1f} % too "
        "easily; expected more points per cell or smaller cells where it bends",
        n, 100 / (n * n)));
  }
  const int needed = 2 * degree_of(problem.grid.basis) - 2;
  // Domains integrate what is interpolated over them, wherever their points lie.
  const bool at_points = problem.phase.quadrature == Quadrature::points;
  if (at_points && quadrature.degree && *quadrature.degree < needed) {
    notes.push_back(fmt::format(
        "the points integrate degree {}, this basis needs {} for its full order: {}", *quadrature.degree, needed,
        quadrature.equal_volumes ? "take consistent volumes" : "take more points per cell or Gauss points"));
  }
  const int needed_at_border = 3 * degree_of(problem.grid.basis) - 2;
  if (const int below = quadrature.border_cells_below(needed_at_border); below > 0) {
    const int points = fewest_gauss_points(problem.dim, needed_at_border);
    const bool equal = std::ranges::any_of(
        problem.bodies, [](const BodySpec& body) { return body.has_shape() && body.volumes == VolumeRule::equal; });
    notes.push_back(fmt::format(
        "in {} of the {} cells that a body's border cuts the points integrate less than degree {}, which this basis "
        "needs for its full order: take {}body.placement = \"gauss\" with {} points per cell",
        below, quadrature.border_cells_below(highest_cut_cell_degree + 1), needed_at_border,
        equal ? "consistent volumes and " : "", points));
  }
  return notes;
}

}  // namespace stillpoint
