#include "simulation/notes.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

namespace stillpoint {
namespace {

int degree_of(BasisKind basis) {
  switch (basis) {
    case BasisKind::linear:
      return 1;
    case BasisKind::quadratic:
      return 2;
    case BasisKind::cubic:
    case BasisKind::hermite:
      return 3;
  }
  throw std::logic_error("a basis without a degree");
}

// A basis of degree p keeps its order of convergence if the points integrate degree 2p − 2 [Strang and Fix
// 1973, 4.3].
std::vector<std::string> quadrature_notes(const Scene& scene, const QuadratureReport& quadrature) {
  std::vector<std::string> notes;
  if (quadrature.cells_limited_by_sign > 0) {
    notes.push_back(fmt::format("in {} cells a fit of higher degree would need a negative volume; they integrate less",
                                quadrature.cells_limited_by_sign));
  }
  if (quadrature.smallest_share < 0.05) {
    notes.push_back(
        fmt::format("the body covers only {:.2g} of some cell's length, which shortens the critical step; expected its "
                    "faces on grid lines",
                    quadrature.smallest_share));
  }
  const int needed = 2 * degree_of(scene.grid.basis) - 2;
  if (quadrature.degree < needed) {
    const bool equal =
        std::ranges::any_of(scene.bodies, [](const BodySpec& body) { return body.volumes == VolumeRule::equal; });
    notes.push_back(fmt::format("the points integrate degree {}, this basis needs {} for its full order: {}",
                                quadrature.degree, needed,
                                equal ? "take consistent volumes" : "take more points per cell or Gauss points"));
  }
  return notes;
}

// Where a point crosses a line of the grid its share of a linear function's gradient changes sign: what an elastic body
// settles over many phases comes out too large [Steffen, Kirby and Berzins 2008].
std::vector<std::string> phase_notes(const Scene& scene, const LagrangianPhase& phase) {
  if (!phase.info().updated_lagrangian || phase.history_dependent() || scene.grid.basis != BasisKind::linear) return {};
  return {
      "points cross the cells of a linear basis from phase to phase, which lets an elastic column settle 6 to 9 % too "
      "far; a quadratic basis is within 0.3 %"};
}

std::vector<std::string> support_notes(const Scene& scene) {
  std::vector<std::string> notes;
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    for (std::size_t d = 0; d < scene.supports[k].at.size(); ++d) {
      const double at = scene.supports[k].at[d];
      const bool inside = std::ranges::any_of(scene.bodies, [&](const BodySpec& body) {
        return body.file.empty() ? at >= body.min[d] && at <= body.max[d] : true;
      });
      if (inside) continue;
      notes.push_back(fmt::format(
          "support[{}] at {:.6g} lies outside the body: it holds the cell that the body shares with it", k, at));
    }
  }
  return notes;
}

}  // namespace

std::vector<std::string> accuracy_notes(const Scene& scene, const LagrangianPhase& phase) {
  std::vector<std::string> notes = quadrature_notes(scene, phase.discretisation().quadrature);
  std::ranges::move(support_notes(scene), std::back_inserter(notes));
  std::ranges::move(phase_notes(scene, phase), std::back_inserter(notes));
  return notes;
}

// Where points yield or part, stresses vary as fast as they like.
std::optional<std::string> null_space_note(const Scene& scene, const LagrangianPhase& phase, double null_space_stress) {
  constexpr double much = 0.05;
  if (phase.history_dependent() || null_space_stress <= much) return std::nullopt;
  const char* remedy = scene.grid.basis == BasisKind::linear ? "take a quadratic basis"
                       : scene.phase.deformation == DeformationRule::accumulated
                           ? "take phase.deformation = \"positions\""
                           : "take more points per cell or smaller cells";
  return fmt::format("{:.2g} of the points' stresses varies faster than the grid's functions, which do not feel it: {}",
                     null_space_stress, remedy);
}

}  // namespace stillpoint
