#include "simulation/formula_positions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "scene/body_surface.hpp"
#include "scene/border_line.hpp"
#include "scene/support_kind.hpp"

namespace stillpoint {
namespace {

constexpr int fewest_of_all = 1000;

std::vector<double> along(const std::array<double, 2>& from, const std::array<double, 2>& to, const GridSpec& grid,
                          int fewest = fewest_of_all) {
  double cells = 0;
  for (std::size_t d = 0; d < 2; ++d) cells += std::abs(to[d] - from[d]) / grid.cell_length(d);
  const int count = std::max(fewest, static_cast<int>(8 * cells));
  std::vector<double> positions;
  for (int k = 0; k < count; ++k) {
    const double share = (k + 0.5) / count;
    for (std::size_t d = 0; d < 2; ++d) positions.push_back(from[d] + share * (to[d] - from[d]));
  }
  return positions;
}

// Over a part of a face in space, which lies across axis `normal` at `face`.
std::vector<double> over(const std::vector<FaceInterval>& part, std::size_t normal, double face) {
  constexpr int along_axis = 32;  // about fewest_of_all together
  std::vector<double> positions;
  const auto position = [](const FaceInterval& interval, int k) {
    return interval.from + (k + 0.5) / along_axis * (interval.to - interval.from);
  };
  for (int b = 0; b < along_axis; ++b) {
    for (int a = 0; a < along_axis; ++a) {
      std::array<double, 3> x{};
      x[normal] = face;
      x[part[0].along] = position(part[0], a);
      x[part[1].along] = position(part[1], b);
      positions.insert(positions.end(), x.begin(), x.end());
    }
  }
  return positions;
}

}  // namespace

std::vector<double> formula_positions(const Scene& scene, const LagrangianPhase& phase, const std::string& key) {
  for (std::size_t k = 0; k < scene.tractions.size(); ++k) {
    if (!key.starts_with(fmt::format("traction[{}]", k))) continue;
    const TractionSpec& traction = scene.tractions[k];
    if (scene.dim == 2) {
      std::vector<double> positions;
      const std::vector<BorderLine> lines = border_lines(scene, traction);
      const int fewest = 1 + (fewest_of_all - 1) / static_cast<int>(lines.size());
      for (const BorderLine& line : lines) {
        const std::vector<double> of_line = along(line.from, line.to, scene.grid, fewest);
        positions.insert(positions.end(), of_line.begin(), of_line.end());
      }
      return positions;
    }
    if (traction.surface) {
      const BodySpec& shape = scene.bodies[body_with_surface(scene).value()];
      double length = 0;
      constexpr int along_box = 16;
      for (std::size_t d = 0; d < 3; ++d) length = std::max(length, (shape.max[d] - shape.min[d]) / along_box);
      std::vector<double> positions;
      for (const SurfacePiece& piece : surface_pieces(shape, *traction.surface, length))
        positions.insert(positions.end(), piece.x.begin(), piece.x.end());
      return positions;
    }
    const BodySpec& body = scene.bodies.front();
    const std::vector<double>& corner = is_upper(*traction.face) ? body.max : body.min;
    if (scene.dim == 1) return corner;
    const auto normal = static_cast<std::size_t>(axis_of(*traction.face));
    return over(part_of_face(*traction.face, traction.from, traction.to, body.min, body.max), normal, corner[normal]);
  }
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    if (!key.starts_with(fmt::format("support[{}]", k))) continue;
    const SupportSpec& support = scene.supports[k];
    if (!support.face) return support.at;
    const auto axis = static_cast<std::size_t>(axis_of(*support.face));
    const double face = (is_upper(*support.face) ? scene.grid.max : scene.grid.min)[axis];
    if (scene.dim == 1) return {face};
    const std::vector<FaceInterval> part = held_part(scene.grid, support);
    if (scene.dim == 3) return over(part, axis, face);
    std::array<double, 2> from{face, face}, to{face, face};
    from[part.front().along] = part.front().from;
    to[part.front().along] = part.front().to;
    return along(from, to, scene.grid);
  }
  return phase.positions();
}

}  // namespace stillpoint
