#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "plan/catalogue.hpp"
#include "scene/grid_lines.hpp"
#include "scene/pore_water.hpp"
#include "simulation/advice/notes.hpp"

namespace stillpoint {
namespace {

// States in which a body can be sheared and nothing across the coordinates makes up for a change of volume.
constexpr std::array keeping_volume{StressState::plane_strain, StressState::axisymmetric, StressState::space};

// Linear cells of four points are too stiff by 0.7 % at ν = 0.45, 4 % at 0.49 and 80 % at 0.4999 (Lamé's cylinder,
// eight across the wall); quadratic ones of nine by 3 % at 0.4999 (Cook's membrane, 32 cells a side).
double nearly_incompressible(BasisKind basis) { return basis == BasisKind::linear ? 0.48 : 0.499; }

// Sharing the change of volume is a remedy for one that is 0 everywhere. If flow dilates, points that are sheared
// more have to swell more: a footing on four points of φ = ψ = 20° carries 7 % too much on 30 × 20 cells, on one point
// 0.1 %.
bool dilates(const MaterialSpec& material) {
  const auto psi = material.parameters.find("psi");
  return psi != material.parameters.end() && psi->second > 0;
}

// The weight of a cell's material over its height, ρ |b| h, where and when it is likely to be all there [Pa].
double weight_of_cell(const Problem& problem, const BodySpec& body, const MaterialSpec& material) {
  constexpr double late = 1e6;  // [s]: longer than any ramp of a run without an end
  std::vector<double> middle;
  for (std::size_t d = 0; d < static_cast<std::size_t>(problem.dim); ++d)
    middle.push_back((body.min[d] + body.max[d]) / 2);
  double squared = 0;
  for (const Expression& b : problem.body_force) {
    const double at = b(middle, problem.stop.time > 0 ? problem.stop.time : late);
    squared += at * at;
  }
  const auto rho = material.parameters.find("rho");  // it may be one by place
  return rho == material.parameters.end() ? 0 : rho->second * std::sqrt(squared) * mean_cell(problem.grid);
}

// Points that share their change of volume share their pressure as well, which at a free surface falls to 0 across one
// cell: there friction alone bears less than it should. A layer of an infinite slope of ψ = 0 that should slide at
// F = 1.48 does at 1.08 without cohesion, on 4 to 32 cells, at 1.25 with one of 0.03 ρ |b| h, and rightly with one of
// 0.08 ρ |b| h.
constexpr double least_cohesion = 0.1;  // of the weight of a cell

bool hardly_coheres(const Problem& problem, const BodySpec& body, const MaterialSpec& material) {
  const auto phi = material.parameters.find("phi"), c = material.parameters.find("c");
  if (phi == material.parameters.end() || c == material.parameters.end() || material.by_place.contains("c"))
    return false;
  return phi->second > 0 && c->second <= least_cohesion * weight_of_cell(problem, body, material);
}

// p² Gauss points of a cell, in space p³, under-integrate just enough; a file's points are as they are.
bool has_many_points(const BodySpec& body, BasisKind basis) {
  const int p = degree_of(basis);
  double points = 1, just_enough = 1;
  for (const int along : body.points_per_cell) points *= along, just_enough *= p;
  return !body.file.empty() || points > just_enough;
}

bool flows(const MaterialSpec& material) {
  const auto& laws = catalogue().laws;
  const auto law = std::ranges::find(laws, std::string_view(material.law), &LawInfo::name);
  return law != laws.end() && law->history_dependent;
}

}  // namespace

std::optional<std::string> locking_note(const Problem& problem) {
  if (std::ranges::find(keeping_volume, problem.state) == keeping_volume.end()) return std::nullopt;
  const bool shares = problem.phase.dilatation != Dilatation::points;
  for (const BodySpec& body : problem.bodies) {
    if (!has_many_points(body, problem.grid.basis)) continue;
    const MaterialSpec& material = problem.materials.at(body.material);
    if (flows(material) && (dilates(material) || !shares)) {
      const std::string remedy =
          dilates(material) ? "one point a cell (of a linear basis, that stays in it) lets them flow"
          : hardly_coheres(problem, body, material) ? "phase.dilatation = \"cells\" lets them flow, but a surface of "
                                                      "so little cohesion would give way too early"
                                                    : "phase.dilatation = \"cells\" lets them flow";
      return fmt::format(
          "each of a cell's points keeps to the flow rule of material.{}: where it flows freely, as below a footing, "
          "the cells carry too much; {}",
          material.name, remedy);
    }
    if (flows(material) && problem.phase.dilatation == Dilatation::cells && hardly_coheres(problem, body, material))
      return fmt::format(
          "phase.dilatation = \"cells\" leaves the points of a cell one pressure, and material.{} hardly coheres: a "
          "surface that slopes gives way too early, and a factor of safety may be too small by a quarter; expected "
          "phase.dilatation = \"points\", or a c of {:.3g} Pa, {:g} of the weight of a cell",
          material.name, least_cohesion * weight_of_cell(problem, body, material), least_cohesion);
    if (flows(material) || shares) continue;
    if (!has_E_and_nu(material)) continue;
    const double nu = with_water(material).nu;
    if (nu < nearly_incompressible(problem.grid.basis)) continue;
    return fmt::format(
        "material.{} is nearly incompressible ({}nu = {:.6g}) at each of a cell's points, which makes the cells too "
        "stiff; expected phase.dilatation = \"{}\"",
        material.name, material.undrained ? "with its water, " : "", nu,
        degree_of(problem.grid.basis) > 2 ? "splines" : "cells");
  }
  return std::nullopt;
}

// In pure bending a bilinear cell of length a and height b has to shear: it is 1 + (1 − ν)/2 (a/b)² times as stiff as
// it should be [Cook, Malkus, Plesha and Witt 2002, section 6.6]; of n cells across the body each takes a 1/n² of that.
std::optional<std::string> slender_cells_note(const Problem& problem) {
  constexpr double slender = 10;
  if (problem.dim == 1 || problem.grid.basis != BasisKind::linear) return std::nullopt;
  double longest = 0, shortest = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(problem.dim); ++axis) {
    longest = std::max(longest, mean_cell(problem.grid, axis));
    shortest = std::min(shortest, mean_cell(problem.grid, axis));
  }
  if (longest < slender * shortest) return std::nullopt;
  return fmt::format(
      "the cells are {:.3g} times as long as wide: those of a linear basis are far too stiff where the body bends "
      "along "
      "them; expected a quadratic or cubic basis, or cells nearer to cubes",
      longest / shortest);
}

}  // namespace stillpoint
