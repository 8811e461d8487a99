#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "plan/catalogue.hpp"
#include "scene/grid_lines.hpp"
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
      return fmt::format(
          "each of a cell's points keeps to the flow rule of material.{}: where it flows freely, as below a footing, "
          "the cells carry too much; {} lets them flow",
          material.name,
          dilates(material) ? "one point a cell (of a linear basis, that stays in it)"
                            : "phase.dilatation = \"cells\"");
    }
    if (flows(material) || shares) continue;
    const auto nu = material.parameters.find("nu");
    if (nu == material.parameters.end() || nu->second < nearly_incompressible(problem.grid.basis)) continue;
    return fmt::format(
        "material.{} is nearly incompressible (nu = {:.6g}) at each of a cell's points, which makes the cells too "
        "stiff; expected phase.dilatation = \"{}\"",
        material.name, nu->second, degree_of(problem.grid.basis) > 2 ? "splines" : "cells");
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
