// Tractions on faces of the body, as points on its surface that move with it.
#pragma once

#include <stillpoint/expression.hpp>
#include <stillpoint/material.hpp>

#include <array>
#include <optional>
#include <vector>

#include "linalg/sparse_cholesky.hpp"
#include "space/grid/basis.hpp"
#include "space/grid/degrees_of_freedom.hpp"
#include "space/materials/deformation.hpp"

namespace stillpoint {

/// A load over part of the surface: dead, per undeformed area, or a pressure that follows the deformed one.
struct SurfaceTraction {
  std::vector<Expression> value;       // of t [Pa]; or
  std::optional<Expression> pressure;  // of t [Pa]
};

template <AxisBasis B, Kinematics K>
class SurfaceLoads {
  static constexpr int dim = dimensions(K);
  using Basis = TensorBasis<B, dim>;

 public:
  /// A piece of surface round x with undeformed area dA and the outward unit normal n.
  void add(std::size_t traction, const Point<dim>& x, const std::array<double, dim>& n, double dA) {
    Piece piece{.traction = traction, .x = x, .area = dA, .vector = {}};
    for (int i = 0; i < dim; ++i) piece.vector[i] = n[i] * dA;
    pieces_.push_back(piece);
  }
  std::size_t add_traction(SurfaceTraction traction) {
    tractions_.push_back(std::move(traction));
    return tractions_.size() - 1;
  }
  bool empty() const { return pieces_.empty(); }
  bool follows() const {
    for (const auto& traction : tractions_) {
      if (traction.pressure) return true;
    }
    return false;
  }

  /// Freezes the weights for a phase. False where a piece reaches no material.
  bool begin_phase(const Grid<dim>& grid, const DegreesOfFreedom& dofs) {
    constexpr double inwards = 1e-9;  // a face on a grid line belongs to the cell that the body is in
    for (Piece& piece : pieces_) {
      Point<dim> inside = piece.x;
      const auto here = grid.cell_of(piece.x);
      for (int d = 0; d < dim; ++d) {
        const auto& nodes = grid.axes[d].nodes;
        const double h = nodes[static_cast<std::size_t>(here[d]) + 1] - nodes[static_cast<std::size_t>(here[d])];
        inside[d] -= inwards * h * (piece.vector[d] > 0 ? 1 : piece.vector[d] < 0 ? -1 : 0);
      }
      const auto cell = grid.cell_of(inside);
      piece.values = Basis::evaluate(grid, cell, piece.x);
      const auto offset = Basis::offsets(grid);
      double reached = 0;
      for (int a = 0; a < Basis::per_cell; ++a) {
        piece.function[a] = Basis::first(grid, cell) + offset[a];
        const bool has_material = dofs.number[static_cast<std::size_t>(dim * piece.function[a])] >= 0;
        if (!has_material) piece.function[a] = -1;
        reached += has_material ? piece.values.N[a] : 0;
      }
      if (!(reached > 1e-12)) return false;
      // Detached from some of the cell's nodes, it loads the others with all of its force.
      if constexpr (B::partition_of_unity) {
        for (double& N : piece.values.N) N /= reached;
      }
    }
    return true;
  }

  /// F += dead loads, t dA; F: (n).
  void add_dead(double t, const DegreesOfFreedom& dofs, Vec F) const {
    for (const Piece& piece : pieces_) {
      const SurfaceTraction& traction = tractions_[piece.traction];
      if (traction.pressure) continue;
      for (int i = 0; i < dim; ++i)
        add_force(piece, dofs, i, traction.value[static_cast<std::size_t>(i)]({}, t) * piece.area, F);
    }
  }
  /// F += −p n da = −p cof(f) N dA for the displacements u over the grid's functions; F: (n).
  void add_following(double t, const double* u, const DegreesOfFreedom& dofs, Vec F) const {
    for (const Piece& piece : pieces_) {
      const SurfaceTraction& traction = tractions_[piece.traction];
      if (!traction.pressure) continue;
      const auto area = deformed_area(piece, u);
      for (int i = 0; i < dim; ++i) add_force(piece, dofs, i, -(*traction.pressure)({}, t) * area[i], F);
    }
  }
  /// ∂F/∂u of these, unsymmetric, (n × n).
  SparseMatrix following_tangent(double t, const double* u, const DegreesOfFreedom& dofs) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (const Piece& piece : pieces_) {
      const SurfaceTraction& traction = tractions_[piece.traction];
      if (!traction.pressure) continue;
      const double p = (*traction.pressure)({}, t);
      for_free(piece, dofs, [&](int b, int j, int column) {
        const auto change = area_derivative(piece, u, b, j);
        for_free(piece, dofs,
                 [&](int a, int i, int row) { entries.emplace_back(row, column, -p * change[i] * piece.values.N[a]); });
      });
    }
    const auto n = static_cast<Eigen::Index>(dofs.size());
    SparseMatrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }  // NOLINT(clang-analyzer-unix.Malloc): the analyzer loses sight of Eigen's destructor
  /// The phase ends with u: the pieces go with the body.
  void end_phase(const double* u) {
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
    std::size_t traction;
    Point<dim> x;                    // where it is when the phase begins [m]
    double area;                     // undeformed [m²]
    std::array<double, dim> vector;  // n da when the phase begins [m²]
    typename Basis::Values values{};
    std::array<int, Basis::per_cell> function{};  // −1 where no material reaches
  };

  // cof(f) n da; cof(f) = [f_yy, −f_yx; −f_xy, f_xx] in the plane, times f_θθ where axisymmetric
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

  void add_force(const Piece& piece, const DegreesOfFreedom& dofs, int component, double force, Vec F) const {
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

  std::vector<SurfaceTraction> tractions_;
  std::vector<Piece> pieces_;
};

}  // namespace stillpoint
