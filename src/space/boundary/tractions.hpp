// Tractions on faces of the body, as pieces of its surface that move with it.
#pragma once

#include <stillpoint/scene.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "scene/throw_scene_error.hpp"
#include "space/boundary/boundary_condition.hpp"

namespace stillpoint {

/// Dead ones, t dA per undeformed area, and pressures that follow the deformed surface, −p n da = −p cof(f) N dA.
/// Along a face of the body's box each cell has three Gauss points, exact to degree 5; they carry the undeformed area,
/// 2 π r ds if axisymmetric.
template <AxisBasis B, Kinematics K>
class Tractions final : public BoundaryCondition<B, K> {
  static constexpr int dim = dimensions(K);
  using Basis = TensorBasis<B, dim>;
  using typename BoundaryCondition<B, K>::GridOf;
  using typename BoundaryCondition<B, K>::Parts;

 public:
  Tractions(const Scene& scene, const GridOf& grid) : scene_(scene) {
    for (const TractionSpec& traction : scene.tractions) cut_face(traction, grid);
  }

  void begin_phase(const Parts& phase, Vec) override {
    for (Piece& piece : pieces_) {
      if (!freeze_weights(piece, phase)) throw_scene_error(scene_, "traction", "there is no material at this face");
    }
  }
  void add_load(const Parts& phase, double t, Vec F) const override {
    for (const Piece& piece : pieces_) {
      if (piece.traction->pressure) continue;
      for (int i = 0; i < dim; ++i) {
        const double stress = piece.traction->value[static_cast<std::size_t>(i)]({}, t);
        add_component(piece, phase.dofs, i, stress * piece.area, F);
      }
    }
  }
  bool follows() const override {
    return std::ranges::any_of(scene_.tractions, [](const TractionSpec& t) { return t.pressure.has_value(); });
  }
  void add_following_force(const Parts& phase, double t, const double* u, Vec F) const override {
    for (const Piece& piece : pieces_) {
      if (!piece.traction->pressure) continue;
      const auto area = deformed_area(piece, u);
      for (int i = 0; i < dim; ++i)
        add_component(piece, phase.dofs, i, -(*piece.traction->pressure)({}, t) * area[i], F);
    }
  }
  // Unsymmetric.
  void add_following_tangent(const Parts& phase, double t, const double* u, MatrixEntries& K_F) const override {
    for (const Piece& piece : pieces_) {
      if (!piece.traction->pressure) continue;
      const double p = (*piece.traction->pressure)({}, t);
      for_free(piece, phase.dofs, [&](int b, int j, int column) {
        const auto change = area_derivative(piece, u, b, j);
        for_free(piece, phase.dofs,
                 [&](int a, int i, int row) { K_F.emplace_back(row, column, -p * change[i] * piece.values.N[a]); });
      });
    }
  }
  // The pieces go with the body.
  void end_phase(const double* u) override {
    for (Piece& piece : pieces_) {
      const auto area = deformed_area(piece, u);
      for (int i = 0; i < dim; ++i) {
        for (int a = 0; a < Basis::per_cell; ++a) {
          if (piece.function[a] >= 0) piece.x[i] += piece.values.N[a] * u[dim * piece.function[a] + i];
        }
      }
      piece.vector = area;
    }
  }

 private:
  struct Piece {
    const TractionSpec* traction;
    Point<dim> x;                    // position when the phase begins [m]
    double area;                     // undeformed [m²]
    std::array<double, dim> vector;  // n da when the phase begins [m²]
    typename Basis::Values values{};
    std::array<int, Basis::per_cell> function{};  // −1 if no material reaches it
  };

  void cut_face(const TractionSpec& traction, const GridOf& grid) {
    const BodySpec& body = scene_.bodies.front();
    const int axis = axis_of(traction.face);
    const double face = (is_upper(traction.face) ? body.max : body.min)[static_cast<std::size_t>(axis)];
    const auto add = [&](const Point<dim>& x, double area) {
      Piece& piece = pieces_.emplace_back(Piece{.traction = &traction, .x = x, .area = area, .vector = {}});
      piece.vector[static_cast<std::size_t>(axis)] = is_upper(traction.face) ? area : -area;
    };
    if constexpr (dim == 1) {
      add({face}, body.area);
    } else {
      const auto along = static_cast<std::size_t>(1 - axis);
      const double begin = body.min[along], end = body.max[along];
      const auto& nodes = grid.axes[along].nodes;
      for (std::size_t c = 0; c + 1 < nodes.size(); ++c) {
        const double from = std::max(begin, nodes[c]), to = std::min(end, nodes[c + 1]);
        if (!(to > from)) continue;
        const double middle = (from + to) / 2, half = (to - from) / 2, offset = std::sqrt(0.6);
        for (const auto& [xi, weight] : {std::pair{-offset, 5.0 / 9}, {0.0, 8.0 / 9}, {offset, 5.0 / 9}}) {
          Point<dim> x;
          x[static_cast<std::size_t>(axis)] = face;
          x[along] = middle + half * xi;
          const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * x[0] : body.area;
          add(x, half * weight * depth);
        }
      }
    }
  }

  // False if the piece reaches no material.
  static bool freeze_weights(Piece& piece, const Parts& phase) {
    constexpr double inwards = 1e-9;  // a face on a grid line belongs to the cell that the body is in
    const GridOf& grid = phase.grid;
    Point<dim> inside = piece.x;
    const auto here = grid.cell_of(piece.x);
    for (int d = 0; d < dim; ++d) {
      const auto& nodes = grid.axes[d].nodes;
      const double h = nodes[static_cast<std::size_t>(here[d]) + 1] - nodes[static_cast<std::size_t>(here[d])];
      inside[d] -= inwards * h * (piece.vector[d] > 0 ? 1 : piece.vector[d] < 0 ? -1 : 0);
    }
    const auto cell = grid.host_of(inside);
    piece.values = Basis::evaluate(grid, cell, piece.x);
    const auto offset = Basis::offsets(grid);
    double reached = 0;
    for (int a = 0; a < Basis::per_cell; ++a) {
      piece.function[a] = Basis::first(grid, cell) + offset[a];
      const bool has_material = phase.dofs.number[static_cast<std::size_t>(dim * piece.function[a])] >= 0;
      if (!has_material) piece.function[a] = -1;
      reached += has_material ? piece.values.N[a] : 0;
    }
    if (!(reached > 1e-12)) return false;
    // Detached from some of the cell's nodes, it loads the others with all of its force.
    if constexpr (B::partition_of_unity) {
      for (double& N : piece.values.N) N /= reached;
    }
    return true;
  }

  // cof(f) n da; cof(f) = [f_yy, −f_yx; −f_xy, f_xx] in the plane, times f_θθ if axisymmetric
  std::array<double, dim> deformed_area(const Piece& piece, const double* u) const {
    if constexpr (dim == 1) {
      return piece.vector;
    } else {
      const Deformation f = deformation(piece, u);
      const auto area = plane_area(piece, f.plane);
      return {f.hoop * area[0], f.hoop * area[1]};
    }
  }
  // Of that by component j of local function b.
  std::array<double, dim> area_derivative(const Piece& piece, const double* u, int b, int j) const {
    if constexpr (dim == 1) {
      return {};
    } else {
      const Deformation f = deformation(piece, u);
      std::array<double, 4> df{};
      for (int i = 0; i < 2; ++i) df[2 * j + i] = piece.values.dN[i][b];
      const auto area = plane_area(piece, f.plane), change = plane_area(piece, df);
      const double dhoop = j == 0 && has_hoop(piece) ? piece.values.N[b] / piece.x[0] : 0;
      return {f.hoop * change[0] + dhoop * area[0], f.hoop * change[1] + dhoop * area[1]};
    }
  }

  struct Deformation {
    std::array<double, 4> plane;  // f_xx, f_xy, f_yx, f_yy
    double hoop;
  };
  static bool has_hoop(const Piece& piece) { return K == Kinematics::axisymmetric && piece.x[0] > 0; }
  static std::array<double, dim> plane_area(const Piece& piece, const std::array<double, 4>& f) {
    const auto& n = piece.vector;
    return {f[3] * n[0] - f[2] * n[1], -f[1] * n[0] + f[0] * n[1]};
  }
  static Deformation deformation(const Piece& piece, const double* u) {
    if constexpr (dim == 1) {
      return {};
    } else {
      std::array<double, 4> f{1, 0, 0, 1};
      double u_r = 0;
      for (int a = 0; a < Basis::per_cell; ++a) {
        if (piece.function[a] < 0) continue;
        const double* of_function = u + dim * piece.function[a];
        u_r += piece.values.N[a] * of_function[0];
        for (int i = 0; i < 2; ++i) {
          for (int j = 0; j < 2; ++j) f[2 * i + j] += of_function[i] * piece.values.dN[j][a];
        }
      }
      return {f, has_hoop(piece) ? 1 + u_r / piece.x[0] : 1};
    }
  }

  static void add_component(const Piece& piece, const DegreesOfFreedom& dofs, int component, double force, Vec F) {
    for_free(piece, dofs, [&](int a, int i, int dof) {
      if (i == component) F[static_cast<std::size_t>(dof)] += force * piece.values.N[a];
    });
  }
  /// visit(local function, component, free degree of freedom)
  template <class Visit>
  static void for_free(const Piece& piece, const DegreesOfFreedom& dofs, const Visit& visit) {
    for (int a = 0; a < Basis::per_cell; ++a) {
      if (piece.function[a] < 0) continue;
      for (int i = 0; i < dim; ++i) {
        const int dof = dofs.number[static_cast<std::size_t>(dim * piece.function[a] + i)];
        if (dofs.is_free(dof)) visit(a, i, dof);
      }
    }
  }

  const Scene& scene_;
  std::vector<Piece> pieces_;
};

}  // namespace stillpoint
