#include "space/boundary/contact_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "scene/body_border.hpp"
#include "scene/body_solid.hpp"
#include "scene/grid_lines.hpp"
#include "space/boundary/face_pieces.hpp"
#include "space/boundary/grid_crossings.hpp"

namespace stillpoint {
namespace {

// Gauss points that are exact for the product of a load as smooth as the functions with these, along each direction.
std::vector<FacePoint> gauss_rule(int count, int parts) {
  const std::vector<double> xi = line_positions(Placement::gauss, count);
  const Eigen::MatrixXd row = Eigen::Map<const Eigen::RowVectorXd>(xi.data(), static_cast<Eigen::Index>(xi.size()));
  const MomentFit gauss = fit_moments(row);
  std::vector<FacePoint> rule;
  for (const double middle : line_positions(Placement::uniform, parts)) {
    for (std::size_t k = 0; k < xi.size(); ++k)
      rule.push_back({middle + xi[k] / parts, 2 * gauss.weights(static_cast<Eigen::Index>(k)) / parts});
  }
  return rule;
}

/// The pieces of a part of the border along an axis, and how many of them make a patch.
struct PieceRule {
  std::vector<FacePoint> points;
  std::size_t in_patch;
};

PieceRule rule_along(const Problem& problem, const BodySpec& body, std::size_t along) {
  if (!problem.phase.ends()) {
    const int count = degree_of(problem.grid.basis) + 1;
    return {gauss_rule(count, 1), static_cast<std::size_t>(count)};
  }
  const int parts = body.points_per_cell[along];
  if (problem.phase.quadrature == Quadrature::domains) return {gauss_rule(2, parts), 2};
  return {face_rule(body, along, /*carried=*/true, /*domains=*/false), static_cast<std::size_t>(parts)};
}

template <int Dim>
double width_of_cell(const Grid<Dim>& grid, const std::array<int, Dim>& cell) {
  double volume = 1;
  for (int d = 0; d < Dim; ++d) {
    const auto& nodes = grid.axes[d].nodes;
    volume *= nodes[static_cast<std::size_t>(cell[d]) + 1] - nodes[static_cast<std::size_t>(cell[d])];
  }
  return std::pow(volume, 1.0 / Dim);
}

// The whole border of a body in the plane, with the material on its left.
std::vector<BorderLine> border_of(const Problem& problem, std::size_t body) {
  std::vector<BorderLine> lines;
  const BodySpec& spec = problem.bodies[body];
  const auto add = [&](Polygon loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const PlanePoint &a = loop[k], &b = loop[(k + 1) % loop.size()];
      if (distance(a, b) > 0) lines.push_back({.body = body, .from = a, .to = b, .normal = normal_of_edge(a, b)});
    }
  };
  if (!spec.file.empty()) {
    for (const auto& loop : spec.outline.loops) add(loop);
    return lines;
  }
  Polygon corners = outline_of(spec);
  if (signed_area(corners) < 0) std::ranges::reverse(corners);
  add(std::move(corners));
  return lines;
}

}  // namespace

template <Kinematics K>
ContactSurface<K>::ContactSurface(const Problem& problem, const std::vector<char>& touched, const Grid<dim>& grid)
    : phases_end_(problem.phase.ends()) {
  for (std::size_t k = 0; k < problem.bodies.size(); ++k)
    if (touched[k]) cut(problem, k, grid);
}

template <Kinematics K>
void ContactSurface<K>::cut(const Problem& problem, std::size_t body, const Grid<dim>& grid) {
  if constexpr (dim == 2) cut_lines(problem, body, grid);
  if constexpr (dim == 3) {
    if (problem.bodies[body].is_box()) {
      cut_faces(problem, body, grid);
    } else {
      cut_surfaces(problem, body, grid);
    }
  }
}

template <Kinematics K>
void ContactSurface<K>::add_patch(std::size_t body, double cell, double depth, std::vector<BorderPiece<K>>&& pieces) {
  const std::size_t begin = pieces_.size();
  pieces_.insert(pieces_.end(), pieces.begin(), pieces.end());
  patches_.push_back({.body = body, .begin = begin, .end = pieces_.size(), .cell = cell, .depth = depth});
  pieces.clear();
}

template <Kinematics K>
void ContactSurface<K>::cut_lines(const Problem& problem, std::size_t number, const Grid<dim>& grid) {
  if constexpr (dim == 2) {
    const BodySpec& body = problem.bodies[number];
    constexpr double on_axis = 1e-12;  // of the length of a cell: such a line is no border
    for (const BorderLine& line : border_of(problem, number)) {
      if (K == Kinematics::axisymmetric &&
          std::max(line.from[0], line.to[0]) <= on_axis * (grid.axes[0].max() - grid.axes[0].min()))
        continue;
      const std::size_t across = std::abs(line.normal[0]) > std::abs(line.normal[1]) ? 0 : 1;
      const PieceRule rule = rule_along(problem, body, 1 - across);
      const std::vector<Point<dim>> ends = grid_crossings(line, grid);
      for (std::size_t c = 0; c + 1 < ends.size(); ++c) {
        const Point<dim>&from = ends[c], &to = ends[c + 1];
        const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
        std::vector<BorderPiece<K>> pieces;
        for (const auto& [xi, weight] : rule.points) {
          Point<dim> x;
          for (std::size_t d = 0; d < dim; ++d) x[d] = (from[d] + to[d]) / 2 + (to[d] - from[d]) / 2 * xi;
          const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * x[0] : body.area;
          pieces.push_back(BorderPiece<K>::make(x, length / 2 * weight * depth, line.normal));
          if (pieces.size() < rule.in_patch) continue;
          Point<dim> inside = x;
          for (std::size_t d = 0; d < dim; ++d) inside[d] -= 1e-9 * length * line.normal[d];
          add_patch(number, width_of_cell<dim>(grid, grid.cell_of(inside)), depth, std::move(pieces));
        }
      }
    }
  }
}

template <Kinematics K>
void ContactSurface<K>::cut_faces(const Problem& problem, std::size_t number, const Grid<dim>& grid) {
  if constexpr (dim == 3) {
    const BodySpec& body = problem.bodies[number];
    for (const Face face : {Face::left, Face::right, Face::bottom, Face::top, Face::back, Face::front}) {
      const auto normal = static_cast<std::size_t>(axis_of(face));
      Point<dim> outwards{};
      outwards[normal] = is_upper(face) ? 1 : -1;
      std::map<int, std::vector<BorderPiece<K>>> in_cells;
      for_face_pieces<dim>(
          grid, normal, (is_upper(face) ? body.max : body.min)[normal], part_of_face(face, {}, {}, body.min, body.max),
          [&](std::size_t along) { return rule_along(problem, body, along).points; },
          [&](const Point<dim>& x, double area, double) {
            Point<dim> inside = x;
            inside[normal] -= 1e-9 * (body.max[normal] - body.min[normal]) * outwards[normal];
            in_cells[grid.cell_number(grid.cell_of(inside))].push_back(BorderPiece<K>::make(x, area, outwards));
          });
      for (auto& [cell, pieces] : in_cells)
        add_patch(number, width_of_cell<dim>(grid, grid.cell_at(cell)), 1, std::move(pieces));
    }
  }
}

// A curved surface is not cut at the borders of cells, but in pieces of half a cell.
template <Kinematics K>
void ContactSurface<K>::cut_surfaces(const Problem& problem, std::size_t number, const Grid<dim>& grid) {
  if constexpr (dim == 3) {
    const BodySpec& body = problem.bodies[number];
    double length = std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d < dim; ++d) length = std::min(length, problem.grid.cell_length(d) / 2);
    for (const BodySurface surface : {BodySurface::outer, BodySurface::inner, BodySurface::start, BodySurface::end}) {
      if (!why_no_surface(body, surface).empty()) continue;
      std::map<int, std::vector<BorderPiece<K>>> in_cells;
      for (const SurfacePiece& piece : surface_pieces(body, surface, length)) {
        const auto& [a, b, c] = piece.vector;
        const double area = std::hypot(a, b, c);
        if (!(area > 0)) continue;
        in_cells[grid.cell_number(grid.cell_of(piece.x))].push_back(
            BorderPiece<K>::make(piece.x, area, {a / area, b / area, c / area}));
      }
      for (auto& [cell, pieces] : in_cells)
        add_patch(number, width_of_cell<dim>(grid, grid.cell_at(cell)), 1, std::move(pieces));
    }
  }
}

template <Kinematics K>
void ContactSurface<K>::begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound) {
  if (empty()) return;
  freeze(phase);
  take_weights(phase);
  if (!has_begun_) choose_stiffness(stiffness_bound());
  has_begun_ = true;
}

template <Kinematics K>
void ContactSurface<K>::freeze(const Parts& phase) {
  if (phases_end_) {
    freeze_carried(
        pieces_, [](BorderPiece<K> & piece) -> auto& { return piece.at; }, !has_begun_, phase);
    return;
  }
  for (BorderPiece<K>& piece : pieces_)
    if (!piece.freeze_in_single_phase(phase)) piece.at.entries.clear();
}

template <Kinematics K>
void ContactSurface<K>::take_weights(const Parts& phase) {
  free_ = static_cast<int>(phase.dofs.size());
  area_.clear(), weights_.clear(), sources_.clear();
  begin_.assign(1, 0), sources_begin_.assign(1, 0);
  for (const BorderPiece<K>& piece : pieces_) {
    double square = 0;
    for (const double along : piece.vector) square += along * along;
    area_.push_back(std::sqrt(square));
    for (const auto& a : piece.at.entries) {
      if (a.function < 0 || a.w == 0) continue;
      weights_.push_back({dim * a.function, a.w});
      for (int i = 0; i < dim; ++i) {
        phase.dofs.for_sources(dim * a.function + i, [&](int, int dof, double share) {
          const auto first = sources_.begin() + static_cast<std::ptrdiff_t>(sources_begin_.back());
          const auto known = std::find_if(first, sources_.end(), [&](const Source& one) { return one.dof == dof; });
          if (known == sources_.end()) {
            sources_.push_back({i, dof, a.w * share});
          } else {
            known->w += a.w * share;
          }
        });
      }
    }
    begin_.push_back(weights_.size());
    sources_begin_.push_back(sources_.size());
  }
}

template <Kinematics K>
void ContactSurface<K>::choose_stiffness(const std::vector<double>& G) {
  constexpr double beta = 1;
  for (Patch& patch : patches_) {
    double sum = 0, area = 0;
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      double ww = 0, compliance = 0;  // Σ w_a², Σ w_a²/G_a
      for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e) {
        const double bound = G[static_cast<std::size_t>(weights_[e].first_unknown / dim)];
        if (!(bound > 0)) continue;
        ww += weights_[e].w * weights_[e].w;
        compliance += weights_[e].w * weights_[e].w / bound;
      }
      if (compliance > 0) sum += area_[s] * beta * ww / compliance;
      area += area_[s];
    }
    const double of_cell = patch.depth * std::pow(patch.cell, dim - 1);
    patch.stiffness = area > 0 ? sum / area / of_cell : 0;
  }
}

template <Kinematics K>
void ContactSurface<K>::end_phase(const double* u) {
  for (BorderPiece<K>& piece : pieces_) piece.move(u);
}

template <Kinematics K>
void ContactSurface<K>::archive(const StateArchive& state) {
  if (empty()) return;
  state.each(
      "positions", pieces_, [](BorderPiece<K> & piece) -> auto& { return piece.at.x; });
  state.each(
      "areas", pieces_, [](BorderPiece<K> & piece) -> auto& { return piece.vector; });
  std::vector<double> stiffness;
  for (const Patch& patch : patches_) stiffness.push_back(patch.stiffness);
  state("stiffness", Vec(stiffness));
  for (std::size_t k = 0; k < patches_.size(); ++k) patches_[k].stiffness = stiffness[k];
}

template <Kinematics K>
double ContactSurface<K>::bound_of_frequency(const Parts& phase) const {
  if (!phase.mass.is_lumped()) return 0;
  std::vector<double> kappa(static_cast<std::size_t>(free_), 0.0);
  for (const Patch& patch : patches_) {
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      double sum = 0;  // Σ_b |w_sb|
      for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e) sum += std::abs(weights_[e].w);
      for_free(s, [&](int, int dof, double w) {
        kappa[static_cast<std::size_t>(dof)] += area_[s] * patch.stiffness * std::abs(w) * sum;
      });
    }
  }
  double most = 0;
  for (std::size_t i = 0; i < kappa.size(); ++i) most = std::max(most, kappa[i] / phase.mass.diagonal()[i]);
  return most;
}

template class ContactSurface<Kinematics::line>;
template class ContactSurface<Kinematics::plane>;
template class ContactSurface<Kinematics::axisymmetric>;
template class ContactSurface<Kinematics::space>;

}  // namespace stillpoint
