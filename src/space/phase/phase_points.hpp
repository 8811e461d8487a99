// What a user sees of the points of a phase, and how initial values come to the grid.
#pragma once

#include <cstdlib>
#include <set>
#include <utility>

#include "space/phase/law_gradients.hpp"
#include "space/phase/material_point_phase.hpp"
#include "space/phase/phase_places.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::describe() {
  std::set<std::string> names;
  bool finite_strain = false;
  for (const auto& material : body_.materials) {
    history_dependent_ = history_dependent_ || material->info().history_dependent;
    finite_strain = finite_strain || material->info().finite_strain;
    for (const auto& [name, values] : material->shown_history()) names.insert(name);
  }
  std::vector<double> m(body_.points.size());  // in the order of the points' numbers, which does not change
  for_points([&](std::size_t, std::size_t p, std::size_t number) { m[number] = body_.points.mass[p]; });
  info_ = {.dim = Dim,
           .gradient_components = components,
           .stress_components = stillpoint::stress_components(K),
           .points = m.size(),
           .total_mass = sum_over(m.size(), [&](std::size_t p) { return m[p]; }),
           .history_names = {names.begin(), names.end()},
           .updated_lagrangian = moves_on(scene_),
           .nonlinear = finite_strain || history_dependent_,
           // With history the elastic part is small, and what it yields only softens; but springs go with it.
           .stiffens = finite_strain && (!history_dependent_ || (moves_on(scene_) && !weak_supports_.empty()))};
}

template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::point_positions() const {
  std::vector<double> out(Dim * points());
  write_points(out, [&](std::size_t, std::size_t p) { return body_.points.position(p); });
  return out;
}

template <AxisBasis B, Kinematics K>
PointData MaterialPointPhase<B, K>::point_data() const {
  const std::vector<double> of_point(points());
  const std::vector<double> positions = point_positions();
  PointData data{positions, updated_lagrangian() ? origin_ : positions, of_point, of_point, std::vector<int>(points())};
  for_points([&](std::size_t k, std::size_t p, std::size_t number) {
    data.volumes[number] += body_.points.volume[p];
    data.masses[number] += body_.points.mass[p];
    data.materials[number] = body_.points.material_of_cell(k);
  });
  return data;
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::point_field(PointQuantity quantity, double t, ConstVec nodal, Vec out) const {
  if (quantity == PointQuantity::velocity) {
    const std::vector<double> v = nodal_velocity(t, nodal);
    return write_points(out, [&](std::size_t k, std::size_t p) { return weights_.value(v.data(), k, p); });
  }
  spread(t, nodal, grid_u_);
  const double* u = grid_u_.data();
  if (quantity == PointQuantity::volume) {
    std::ranges::fill(out, 0.0);
    return for_points([&](std::size_t k, std::size_t p, std::size_t number) {
      const bool changes = material_of(k).info().finite_strain;
      out[number] +=
          body_.points.volume[p] * (changes ? determinant<K>(plus_identity<K>(weights_.gradient(u, k, p))) : 1.0);
    });
  }
  if (quantity == PointQuantity::strain)
    return write_points(out, [&](std::size_t k, std::size_t p) { return weights_.gradient(u, k, p); });
  if (quantity == PointQuantity::stress) {
    const auto shared = shared_dilatation(u);
    LawGradients<B, K> gradients(body_, weights_, shared, u);
    return write_points(out,
                        [&](std::size_t k, std::size_t p) { return material_of(k).cauchy(gradients.at(k, p), p); });
  }
  write_points(out, [&](std::size_t k, std::size_t p) {
    auto u_p = weights_.value(u, k, p);
    if (!updated_lagrangian()) return u_p;
    const auto number = static_cast<std::size_t>(body_.points.number[p]);
    for (int i = 0; i < Dim; ++i) u_p[i] += body_.points.x[i][p] - origin_[Dim * number + i];
    return u_p;
  });
}

template <AxisBasis B, Kinematics K>
std::unique_ptr<PlaceReader> MaterialPointPhase<B, K>::read_places(double t, ConstVec u, ConstVec v) const {
  using Spline = typename BasisOfOneCell<B>::type;
  std::vector<double> grid_u(grid_u_.size(), 0);
  spread(t, u, grid_u);
  struct Gradients {
    Gradients(const MaterialPointPhase& phase, const std::vector<double>& of)
        : u(of), shared(phase.shared_dilatation(u.data())), of_points(phase.body_, phase.weights_, shared, u.data()) {}
    std::vector<double> u;
    SharedDilatation<B, K> shared;
    LawGradients<B, K> of_points;
  };
  const auto gradients = std::make_shared<Gradients>(*this, grid_u);
  return std::make_unique<PhasePlaces<K>>(
      std::make_unique<FunctionsOfBasis<Spline, Dim>>(grid_), Spline::degree, body_, *dofs_,
      [gradients](std::size_t k, std::size_t p) { return gradients->of_points.at(k, p); }, std::move(grid_u),
      nodal_velocity(t, v));
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::point_history(const std::string& name, Vec out) const {
  std::ranges::fill(out, 0.0);
  for (std::size_t m = 0; m < body_.materials.size(); ++m) {
    const auto begin = static_cast<std::size_t>(body_.points.material_begin[m]);
    for (const auto& [shown, values] : body_.materials[m]->shown_history()) {
      if (shown != name) continue;
      for (std::size_t k = 0; k < values.size(); ++k) {
        out[static_cast<std::size_t>(body_.points.number[begin + k])] = values[k];
      }
    }
  }
}

template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::initial_displacement(double t) const {
  std::vector<double> held;
  for (std::size_t s = 0; s < held_.prescribed().size(); ++s) held.push_back(held_.motion(s).displacement(t));
  return project(scene_.initial_u, held);
}

template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::initial_velocity(double t) {
  if (updated_lagrangian()) return velocity_from_points(t);
  std::vector<double> held;
  for (std::size_t s = 0; s < held_.prescribed().size(); ++s) held.push_back(held_.motion(s).velocity(t));
  std::vector<double> v = project(scene_.initial_v, held);
  begin_motion(t, v);
  return v;
}

template <AxisBasis B, Kinematics K>
std::vector<WallReaction> MaterialPointPhase<B, K>::wall_reactions(double t) const {
  std::vector<WallReaction> reactions;
  for (const auto& condition : boundary_) condition->report(t, reactions);
  return reactions;
}

template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::support_displacements(double t) const {
  const Springs& springs = weak_supports_.springs();
  std::vector<double> moved;
  for (std::size_t s = 0; s < held_.prescribed().size(); ++s) moved.push_back(held_.displacement(s, t));
  for (std::size_t s = 0; s < springs.size(); ++s) moved.push_back(springs.support_displacement(s, t, held_.start()));
  const Springs& load = load_control_.springs();
  for (std::size_t s = 0; s < load.size(); ++s) moved.push_back(load.support_displacement(s, t, held_.start()));
  return moved;
}

// R_s − F_s at the prescribed values, −k g of springs. A slope has a moment, which is no force.
template <AxisBasis B, Kinematics K>
std::vector<SupportReaction> MaterialPointPhase<B, K>::support_reactions(double t, ConstVec u,
                                                                         ConstVec reactions) const {
  std::vector<SupportReaction> named;
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place(scene_.supports.size(), none);
  for (std::size_t s = 0; s < place.size(); ++s) {
    if (scene_.supports[s].name.empty()) continue;
    place[s] = named.size();
    named.push_back({scene_.supports[s].name, {}});
  }
  if (named.empty()) return named;
  spread(t, u, grid_u_);
  const std::size_t prescribed = held_.prescribed().size();
  std::vector<double> F_s(prescribed, 0);
  for (const auto& condition : boundary_) condition->add_load_on_supports(parts(), t, grid_u_.data(), F_s);
  load_control_.add_load_on_supports(parts(), t, grid_u_.data(), F_s);
  // f along axis i at x, with its moment x × f e_i.
  const auto bear = [&](SupportReaction& support, int i, double f, [[maybe_unused]] const auto& place_of) {
    support.force[static_cast<std::size_t>(i)] += f;
    if constexpr (Dim == 3) {
      const Point<Dim> x = place_of();
      const auto next = static_cast<std::size_t>((i + 1) % 3), last = static_cast<std::size_t>((i + 2) % 3);
      support.moment[next] += x[last] * f;
      support.moment[last] -= x[next] * f;
    }
  };
  for (std::size_t s = 0; s < prescribed; ++s) {
    const auto [function, i] = std::div(held_.prescribed()[s], Dim);
    const std::size_t support = held_.owner(s), owner = support == HeldUnknowns::nobody ? none : place[support];
    if (owner == none || !Basis::is_value(grid_, function)) continue;
    bear(named[owner], i, reactions[s] - F_s[s], [&, number = function] {
      Point<Dim> x;
      for (int d = 0; d < Dim; ++d)
        x[d] = B::centre(grid_.axes[d], Basis::index_along(grid_, number, d)) + grid_u_[Dim * number + d];
      return x;
    });
  }
  for (std::size_t s = 0; s < weak_supports_.springs().size(); ++s) {
    if (const std::size_t owner = place[weak_supports_.owner(s)]; owner != none)
      bear(named[owner], weak_supports_.component(s), reactions[prescribed + s],
           [&] { return weak_supports_.place(s, grid_u_.data()); });
  }
  return named;
}

template <AxisBasis B, Kinematics K>
std::vector<WeakSupport> MaterialPointPhase<B, K>::weak_supports(double t, ConstVec u) const {
  if (weak_supports_.empty()) return {};
  spread(t, u, grid_u_);
  return weak_supports_.report(t, grid_u_.data());
}

template <AxisBasis B, Kinematics K>
std::optional<LoadState> MaterialPointPhase<B, K>::load_state(double t, ConstVec u) const {
  if (!load_control_.acts()) return std::nullopt;
  spread(t, u, grid_u_);
  return load_control_.state(t, grid_u_.data());
}

template <AxisBasis B, Kinematics K>
std::vector<FreePart> MaterialPointPhase<B, K>::free_parts() const {
  std::vector<char> sprung(dofs_->number.size(), 0);
  for (const Springs::Weight& weight : weak_supports_.springs().weights())
    sprung[static_cast<std::size_t>(weight.unknown)] = 1;
  return find_free_parts<Dim>({functions_, body_.points, weights_}, K == Kinematics::axisymmetric ? 1 : 0, *dofs_,
                              sprung, /*as_one=*/updated_lagrangian());
}

template <AxisBasis B, Kinematics K>
NodalLayout MaterialPointPhase<B, K>::layout() const {
  if (scene_.grid.basis == BasisKind::hermite) return {};
  NodalLayout layout;
  layout.dim = Dim;
  int function = -1, nodes = 0;
  for (const int unknown : dofs_->free) {
    if (std::exchange(function, unknown / Dim) != unknown / Dim) {
      ++nodes;
      for (int d = 0; d < Dim; ++d)
        layout.positions.push_back(B::centre(grid_.axes[d], Basis::index_along(grid_, function, d)));
    }
    layout.node.push_back(nodes - 1);
    layout.component.push_back(unknown % Dim);
  }
  return layout;
}

template <AxisBasis B, Kinematics K>
Discretisation MaterialPointPhase<B, K>::discretisation() const {
  constexpr double real = sizeof(double);
  std::vector<PointArray> arrays = {
      {"position", Dim * real}, {"mass", real}, {"volume", real}, {"number", sizeof(int)}};
  std::ranges::copy(PointWeights<B, K>::arrays(), std::back_inserter(arrays));
  if (averages_dilatation()) {
    if (means_over_splines()) {
      std::ranges::copy(SplineMeans<B, K>::arrays(), std::back_inserter(arrays));
    } else {
      arrays.push_back({"share of the cell's volume", real});
    }
    arrays.push_back({"change of volume, averaged", (history_dependent_ ? 2 : 1) * real});
    double scratch = 0;
    for (const std::vector<double>& history : scratch_history_) scratch += static_cast<double>(history.size());
    if (scratch > 0) arrays.push_back({"history, of tangents", scratch * real / static_cast<double>(points())});
  }
  if (!elastic_cells_.empty())
    arrays.push_back({"moments of cells", elastic_cells_.bytes() / static_cast<double>(points())});
  if (updated_lagrangian()) {
    arrays.push_back({"velocity", Dim * real});
    arrays.push_back({"position at the start", Dim * real});
    if (scene_.phase.transfer == Transfer::apic) arrays.push_back({"affine velocity", Dim * Dim * real});
    if (B::window > 1) arrays.push_back({"domain", ((Dim << Dim) + 2 * Dim) * real});
  }
  // What a law keeps counts for the share of points that have it.
  for (std::size_t m = 0; m < body_.materials.size(); ++m) {
    const double share =
        (body_.points.material_begin[m + 1] - body_.points.material_begin[m]) / static_cast<double>(points());
    for (PointArray array : body_.materials[m]->arrays()) {
      array.bytes_per_point *= share;
      arrays.push_back(array);
    }
  }
  std::vector<int> cells;
  for (const Axis& axis : grid_.axes) cells.push_back(axis.cells());
  const std::set<int> occupied(body_.points.cell.begin(), body_.points.cell.end());
  return {std::move(arrays), dofs_->prescribed.size(), std::move(cells), occupied.size(), body_.quadrature};
}

// M_ff u_f = Σ_p m_p N_fp u_0(x_p) − M_fs u_s: the least-squares fit at the material points, whatever M the motion
// has.
template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::project(const std::vector<Expression>& field,
                                                      const std::vector<double>& held) const {
  std::vector<double> u(size(), 0.0);
  if (field.empty()) return u;
  for_points([&](std::size_t k, std::size_t p, std::size_t) {
    const auto moment = [&](int i) {
      return body_.points.mass[p] * field[static_cast<std::size_t>(i)](body_.points.position(p), 0);
    };
    weights_.add_at_functions(k, p, moment, *dofs_, u);
  });
  std::optional<SplitMatrix> of_points;
  if (!consistent_) of_points = consistent_mass<B, K>(grid_, body_.points, weights_, *dofs_);
  const SplitMatrix& M = consistent_ ? *consistent_ : *of_points;
  if (!held.empty()) {
    const Eigen::Map<const Eigen::VectorXd> u_s(held.data(), static_cast<Eigen::Index>(held.size()));
    Eigen::Map<Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size())) -= M.prescribed * u_s;
  }
  SparseCholesky(M.free).solve(u, u);
  return u;
}

}  // namespace stillpoint
