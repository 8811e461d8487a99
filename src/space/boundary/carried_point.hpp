// A loaded position of a body, which moves with the body from phase to phase.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "parallel/of_all.hpp"
#include "space/boundary/boundary_condition.hpp"
#include "space/kernels/corner_sum.hpp"
#include "space/points/nearest_point.hpp"

namespace stillpoint {

/// A position that carries a load: a force f at it loads functions by w_a f, and it follows x += Σ_a w_a u_a with the
/// same weights, so that the force does the work of its own displacement.
///
/// - In a body of a single phase w_a = N_a(x).
/// - In a body that moves on, surface and points separate in the cells that the body's edge cuts: there N_a(x) loads
/// functions that points hardly resist, or the cell of x holds no point at all. Hence the material point nearest to x
/// carries the position. Its volume is taken to reach from x = x_p + d to the mirror image x_p − d, and the midpoint
/// rule, by which the point has its share of the internal force, gives over that volume
///
///     w_a = N_a(x_p − d) + 2 d·∇N_ap = N_a(x) + O(d³),
///
/// a force inside the body and a dipole that the point's stress resists. Since Σ N_a = 1 and Σ N_a ξ_a = x (ξ_a the
/// Greville abscissae), Σ w_a f = f and Σ w_a ξ_a × f = x × f: neither the force nor its moment depends on which point
/// carries it.
/// - Where points represent domains, the position stays in the domain of one point, at Σ_c ω_c x_c of its corners, and
/// w_a = Σ_c ω_c N_a(x_c): a load on a face of domains is in equilibrium with a stress in them.
template <int Dim>
struct CarriedPoint {
  struct Entry {
    int function = -1;  // function of the grid; −1: one that no material reaches
    double w = 0;       // weight
    Point<Dim> dN{};    // factor in the displacement gradient at the position [1/m]
  };

  Point<Dim> x;                // position when the phase begins [m]
  Point<Dim> X;                // undeformed position, if the position belongs to a domain [m]
  std::size_t carrier;         // number of the point whose domain it belongs to
  int field = any_field;       // the field of motion of its body; any_field: that of the nearest point
  std::vector<Entry> entries;  // the functions of a cell, or of two cells, which may be the same one

  /// Sets the weights by the functions of a cell. Returns Σ_a w_a over the functions that material reaches.
  double freeze(const std::array<int, Dim>& cell, const PhaseParts<Dim>& phase) {
    const int per_cell = phase.functions.per_cell();
    if (field == any_field) {
      const bool is_one = phase.functions.fields() == 1;
      field = is_one ? 0 : phase.points.field_of_cell(NearestPoint<Dim>(phase.points, phase.grid).to(x).k);
    }
    entries.assign(static_cast<std::size_t>(per_cell), {});
    const auto values = phase.functions.evaluate(field, cell, x);
    const double reached = take_functions(0, values, phase);
    for (int a = 0; a < per_cell; ++a) {
      for (int j = 0; j < Dim; ++j) entry(a).dN[j] = values.dN[per_cell * j + a];
    }
    return reached;
  }
  /// Sets the weights by a material point. A position further than a cell's width from the point has lost its surface,
  /// and is moved back to that distance.
  void freeze(const PointInCell& nearest, const PhaseParts<Dim>& phase) {
    const int per_cell = phase.functions.per_cell();
    entries.assign(static_cast<std::size_t>(2 * per_cell), {});
    const auto [k, p] = nearest;
    const Point<Dim> x_p = phase.points.position(p);
    const auto at = phase.grid.cell_at(phase.points.cell[k]);
    Point<Dim> d, mirror;
    for (int j = 0; j < Dim; ++j) {
      const auto& nodes = phase.grid.axes[j].nodes;
      const double width = nodes[static_cast<std::size_t>(at[j]) + 1] - nodes[static_cast<std::size_t>(at[j])];
      x[j] = std::clamp(x[j], x_p[j] - width, x_p[j] + width);
      d[j] = x[j] - x_p[j];
      mirror[j] = x_p[j] - d[j];
    }
    typename PointFunctions<Dim>::Slopes gradients;
    phase.weights.slopes(k, p, gradients);
    for (int a = 0; a < per_cell; ++a) {
      Entry& of_point = entry(a);
      of_point.function = phase.weights.function(k, a);
      for (int j = 0; j < Dim; ++j) {
        of_point.dN[j] = gradients[per_cell * j + a];
        of_point.w += 2 * d[j] * of_point.dN[j];
      }
    }
    const int field_of_point = phase.points.field_of_cell(k);
    const auto at_mirror = phase.functions.evaluate(field_of_point, phase.grid.cell_of(mirror), mirror);
    const double reached = take_functions(per_cell, at_mirror, phase);
    if (reached > 1 - 1e-13) return;
    // There is no material at the mirror image: the weights are of first order.
    typename PointFunctions<Dim>::Numbers N;
    phase.weights.values(k, p, N);
    for (int a = 0; a < per_cell; ++a) {
      entry(per_cell + a).function = -1;
      entry(a).w = N[a] + entry(a).w / 2;
    }
  }

  /// Attaches the position to the domain of a point, or to what its mean deformation F makes of it:
  ///   X = X_p + F⁻¹ (x − x_p)
  void attach(const PointInCell& nearest, const MaterialPoints<Dim>& points) {
    const std::size_t p = nearest.p;
    carrier = static_cast<std::size_t>(points.number[p]);
    X = x;
    Point<Dim> half, away;
    bool is_undeformed = true;
    for (int d = 0; d < Dim; ++d) {
      half[d] = points.half[d][p];
      away[d] = x[d] - points.x[d][p];
      is_undeformed = is_undeformed && points.x[d][p] == points.rest[d][p];
    }
    if (is_undeformed) return;
    if constexpr (Dim < 3) {
      const auto F = Domain<Dim>::of(points, p).deformation(half);
      if constexpr (Dim == 1) {
        X[0] = points.rest[0][p] + away[0] / F[0];
      } else {
        const double det = F[0] * F[3] - F[1] * F[2];
        X[0] = points.rest[0][p] + (F[3] * away[0] - F[1] * away[1]) / det;
        X[1] = points.rest[1][p] + (F[0] * away[1] - F[2] * away[0]) / det;
      }
    }
  }
  /// The position in the domain of point p, each coordinate from −1 to 1.
  Point<Dim> position_in(std::size_t p, const MaterialPoints<Dim>& points) const {
    Point<Dim> xi;
    for (int j = 0; j < Dim; ++j) xi[j] = (X[j] - points.rest[j][p]) / points.half[j][p];
    return xi;
  }
  /// Sets the weights by the corners of the domain that the position belongs to.
  void freeze_in_domain(const PointInCell& of, const PhaseParts<Dim>& phase) {
    const int per_cell = phase.functions.per_cell();
    entries.assign(static_cast<std::size_t>(per_cell), {});
    const auto [k, p] = of;
    const auto cell = phase.grid.cell_at(phase.points.cell[k]);
    const auto domain = Domain<Dim>::of(phase.points, p), in_grid = Domain<Dim>::in_grid(phase.points, p, phase.grid);
    const auto share = Domain<Dim>::weights(position_in(p, phase.points));
    x.fill(0);
    for (int c = 0; c < domain.corners; ++c) {
      const auto N = phase.functions.evaluate(phase.points.field_of_cell(k), cell, in_grid.x[c]).N;
      for (int a = 0; a < per_cell; ++a) entry(a).w += share[c] * N[a];
      for (int j = 0; j < Dim; ++j) x[j] += share[c] * domain.x[c][j];
    }
    typename PointFunctions<Dim>::Slopes gradients;
    phase.weights.slopes(k, p, gradients);
    for (int a = 0; a < per_cell; ++a) {
      Entry& of_domain = entry(a);
      for (int j = 0; j < Dim; ++j) {
        of_domain.dN[j] = gradients[per_cell * j + a];
        // Keeps the moment that of x, where the domain in the grid was shrunk.
        for (int c = 0; c < domain.corners; ++c)
          of_domain.w += share[c] * (domain.x[c][j] - in_grid.x[c][j]) * of_domain.dN[j];
      }
      const bool acts = phase.dofs.number[static_cast<std::size_t>(Dim * phase.weights.function(k, a))] >= 0;
      if (acts) of_domain.function = phase.weights.function(k, a);
    }
  }

  /// Moves the position by the displacement u at the end of a phase.
  void move(const double* u) {
    for (int i = 0; i < Dim; ++i) {
      for (const Entry& a : entries) {
        if (a.function >= 0) x[i] += a.w * u[Dim * a.function + i];
      }
    }
  }

  /// Calls visit(entry, component, free degree of freedom, its share of the entry's function).
  template <class Visit>
  void for_free(const DegreesOfFreedom& dofs, const Visit& visit) const {
    for_sources(dofs, [&](const Entry& a, int i, int dof, double share) {
      if (dofs.is_free(dof)) visit(a, i, dof, share);
    });
  }

  /// Calls visit(entry, component, number of the prescribed unknown, its share).
  template <class Visit>
  void for_prescribed(const DegreesOfFreedom& dofs, const Visit& visit) const {
    for_sources(dofs, [&](const Entry& a, int i, int dof, double share) {
      if (!dofs.is_free(dof)) visit(a, i, static_cast<std::size_t>(dof) - dofs.size(), share);
    });
  }

 private:
  template <class Visit>
  void for_sources(const DegreesOfFreedom& dofs, const Visit& visit) const {
    for (const Entry& a : entries) {
      if (a.function < 0) continue;
      for (int i = 0; i < Dim; ++i) {
        dofs.for_sources(Dim * a.function + i, [&](int, int dof, double share) { visit(a, i, dof, share); });
      }
    }
  }
  Entry& entry(int a) { return entries[static_cast<std::size_t>(a)]; }
  // Takes those functions of a cell that material reaches, with weights N, into the entries from `first` on. Returns
  // the sum of their N.
  double take_functions(int first, const typename GridFunctions<Dim>::Values& values, const PhaseParts<Dim>& phase) {
    double reached = 0;
    for (int a = 0; a < phase.functions.per_cell(); ++a) {
      entry(first + a).w = values.N[a];
      if (phase.dofs.number[static_cast<std::size_t>(Dim * values.function[a])] < 0) continue;
      entry(first + a).function = values.function[a];
      reached += values.N[a];
    }
    return reached;
  }
};

/// The cell whose functions represent a position of the grid.
template <int Dim>
std::array<int, Dim> cell_with_functions_at(const GridFunctions<Dim>& functions, const Point<Dim>& x) {
  const Grid<Dim>& grid = functions.grid();
  auto cell = grid.cell_of(x);
  for (int d = 0; d < Dim; ++d) {
    const CellRange along = grid.range(d);
    cell[d] = std::clamp(cell[d], along.first, std::max(along.end - functions.window(), along.first));
  }
  return cell;
}

/// The points whose domains carry the loads: of a domain split into parts, the part that contains the load or is
/// nearest.
template <int Dim, class Loads, class PositionOf>
std::vector<PointInCell> carriers_of(Loads& loads, const PositionOf& at_of, const MaterialPoints<Dim>& points) {
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> first(points.size(), none), next(loads.size());  // linked lists of the loads of each point
                                                                            // number
  for (std::size_t l = loads.size(); l-- > 0;) next[l] = std::exchange(first[at_of(loads[l]).carrier], l);
  std::vector<PointInCell> carriers(loads.size());
  std::vector<double> nearest(loads.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < points.cells(); ++k) {
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      for (std::size_t l = first[static_cast<std::size_t>(points.number[p])]; l != none; l = next[l]) {
        double distance = 0;
        for (const double along : at_of(loads[l]).position_in(p, points))
          distance = std::max(distance, std::abs(along));
        if (!(distance < nearest[l])) continue;
        nearest[l] = distance;
        carriers[l] = {k, p};
      }
    }
  }
  return carriers;
}

/// As freeze_carried(), where ranks share the points: the rank of the point that carries a position sets its weights,
/// and tells the others.
template <int Dim, class Loads, class PositionOf>
void freeze_by_ranks(Loads& loads, const PositionOf& at_of, const PhaseParts<Dim>& phase, const Ranks& ranks) {
  using Carried = CarriedPoint<Dim>;
  const NearestPoint<Dim> nearest(phase.points, phase.grid);
  std::vector<PointInCell> carriers;
  std::vector<Nearness> near;
  for (auto& load : loads) {
    const Carried& at = at_of(load);
    carriers.push_back(phase.points.size() > 0 ? nearest.to(at.x, at.field) : PointInCell{});
    near.push_back(nearest.nearness(at.x, carriers.back(), at.field));
  }
  const std::size_t count = near.size();
  const std::vector<Nearness> of_ranks = joined_lists(&ranks, std::move(near));
  std::vector<std::vector<std::size_t>> loads_of(static_cast<std::size_t>(ranks.count()));
  for (std::size_t l = 0; l < count; ++l) {
    std::size_t first = 0;
    for (std::size_t rank = 1; rank < loads_of.size(); ++rank)
      if (of_ranks[count * rank + l].key() < of_ranks[count * first + l].key()) first = rank;
    loads_of[first].push_back(l);
  }
  std::vector<Point<Dim>> positions;
  std::vector<typename Carried::Entry> entries;
  for (const std::size_t l : loads_of[static_cast<std::size_t>(ranks.rank())]) {
    Carried& at = at_of(loads[l]);
    at.freeze(carriers[l], phase);
    positions.push_back(at.x);
    entries.insert(entries.end(), at.entries.begin(), at.entries.end());
  }
  positions = joined_lists(&ranks, std::move(positions));
  entries = joined_lists(&ranks, std::move(entries));
  const std::size_t per_load = count == 0 ? 0 : entries.size() / count;
  std::size_t next = 0;
  for (const std::vector<std::size_t>& of_rank : loads_of) {
    for (const std::size_t l : of_rank) {
      Carried& at = at_of(loads[l]);
      at.x = positions[next];
      const auto first = entries.begin() + static_cast<std::ptrdiff_t>(per_load * next++);
      at.entries.assign(first, first + static_cast<std::ptrdiff_t>(per_load));
    }
  }
}

/// Sets the weights of the positions at_of(load) for the phase that begins, by the material points that carry them.
template <int Dim, class Loads, class PositionOf>
void freeze_carried(Loads& loads, const PositionOf& at_of, bool is_first, const PhaseParts<Dim>& phase) {
  if (const Ranks* ranks = phase.corner_sum.ranks()) return freeze_by_ranks(loads, at_of, phase, *ranks);
  if (phase.functions.window() == 1) {
    const NearestPoint<Dim> nearest(phase.points, phase.grid);
    for (auto& load : loads) at_of(load).freeze(nearest.to(at_of(load).x, at_of(load).field), phase);
  } else {
    if (is_first) {
      const NearestPoint<Dim> nearest(phase.points, phase.grid);
      for (auto& load : loads) at_of(load).attach(nearest.to(at_of(load).x, at_of(load).field), phase.points);
    }
    const std::vector<PointInCell> carriers = carriers_of(loads, at_of, phase.points);
    for (std::size_t l = 0; l < loads.size(); ++l) at_of(loads[l]).freeze_in_domain(carriers[l], phase);
  }
}

}  // namespace stillpoint
