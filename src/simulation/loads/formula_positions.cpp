#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "scene/body_border.hpp"
#include "scene/grid_lines.hpp"
#include "scene/support_kind.hpp"
#include "simulation/loads/formula_samples.hpp"

namespace stillpoint {
namespace {

constexpr int fewest_of_all = 1000;

std::vector<double> along(const std::array<double, 2>& from, const std::array<double, 2>& to, const GridSpec& grid,
                          int fewest) {
  double cells = 0;
  for (std::size_t d = 0; d < 2; ++d) cells += std::abs(cells_between(grid, d, from[d], to[d]));
  const int count = std::max(fewest, static_cast<int>(8 * cells));
  std::vector<double> positions;
  for (int k = 0; k < count; ++k) {
    const double share = (k + 0.5) / count;
    for (std::size_t d = 0; d < 2; ++d) positions.push_back(from[d] + share * (to[d] - from[d]));
  }
  return positions;
}

/// Positions along each axis of a part of a face.
struct Sampling {
  int fewest, per_cell;
};
// The sampling by the number of these axes: about fewest_of_all together, and more along a line of many cells.
constexpr std::array<Sampling, 3> samplings{{{1, 0}, {fewest_of_all, 8}, {32, 0}}};

// The middles of equal parts of a part of a face, which lies at `face` of the axis across it, by the first axis first.
std::vector<double> over(const std::vector<FaceInterval>& part, double face, const GridSpec& grid) {
  const Sampling& sampling = samplings[part.size()];
  std::vector<std::vector<double>> positions = {std::vector<double>(part.size() + 1, face)};
  for (std::size_t k = part.size(); k-- > 0;) {
    const auto& [along, from, to] = part[k];
    const double cells = std::abs(cells_between(grid, along, from, to));
    const int count = std::max(sampling.fewest, static_cast<int>(sampling.per_cell * cells));
    std::vector<std::vector<double>> finer;
    for (std::vector<double>& x : positions) {
      for (int i = 0; i < count; ++i) {
        x[along] = from + (i + 0.5) / count * (to - from);
        finer.push_back(x);
      }
    }
    positions = std::move(finer);
  }
  std::vector<double> flat;
  for (const std::vector<double>& x : positions) flat.insert(flat.end(), x.begin(), x.end());
  return flat;
}

}  // namespace

std::vector<double> formula_positions(const Problem& problem, const LagrangianPhase& phase, const std::string& key) {
  for (std::size_t k = 0; k < problem.tractions.size(); ++k) {
    if (!key.starts_with(fmt::format("traction[{}]", k))) continue;
    const TractionSpec& traction = problem.tractions[k];
    if (!traction.line.empty()) {
      std::vector<double> positions;
      const std::vector<BorderLine> lines = border_lines(problem, traction);
      const int fewest = 1 + (fewest_of_all - 1) / static_cast<int>(lines.size());
      for (const BorderLine& line : lines) {
        const std::vector<double> of_line = along(line.from, line.to, problem.grid, fewest);
        positions.insert(positions.end(), of_line.begin(), of_line.end());
      }
      return positions;
    }
    if (traction.surface) {
      const BodySpec& shape = problem.bodies[body_with_surface(problem).value()];
      double length = 0;
      constexpr int along_box = 16;
      for (std::size_t d = 0; d < 3; ++d) length = std::max(length, (shape.max[d] - shape.min[d]) / along_box);
      std::vector<double> positions;
      for (const SurfacePiece& piece : surface_pieces(shape, *traction.surface, length))
        positions.insert(positions.end(), piece.x.begin(), piece.x.end());
      return positions;
    }
    const BodySpec& body = problem.bodies.front();
    const auto axis = static_cast<std::size_t>(axis_of(*traction.face));
    const double face = (is_upper(*traction.face) ? body.max : body.min)[axis];
    return over(part_of_face(*traction.face, traction.from, traction.to, body.min, body.max), face, problem.grid);
  }
  for (std::size_t k = 0; k < problem.supports.size(); ++k) {
    if (!key.starts_with(fmt::format("support[{}]", k))) continue;
    const SupportSpec& support = problem.supports[k];
    if (!support.face) return support.at;
    const auto axis = static_cast<std::size_t>(axis_of(*support.face));
    const double face = (is_upper(*support.face) ? problem.grid.max : problem.grid.min)[axis];
    return over(held_part(problem.grid, support), face, problem.grid);
  }
  return phase.fields().positions();
}

}  // namespace stillpoint
