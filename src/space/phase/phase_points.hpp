// What a user sees of the points of a phase, and how initial values come to the grid.
#pragma once

#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::positions() const {
  std::vector<double> out(Dim * points());
  for_points([&](std::size_t, std::size_t p, std::size_t number) {
    for (int d = 0; d < Dim; ++d) out[Dim * number + d] = body_.points.x[d][p];
  });
  return out;
}

template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::volumes() const {
  std::vector<double> out(points());
  for_points([&](std::size_t, std::size_t p, std::size_t number) { out[number] = body_.points.volume[p]; });
  return out;
}

template <AxisBasis B, Kinematics K>
std::vector<int> MaterialPointPhase<B, K>::materials() const {
  std::vector<int> out(points());
  for_points([&](std::size_t k, std::size_t, std::size_t number) { out[number] = body_.points.material_of_cell(k); });
  return out;
}

template <AxisBasis B, Kinematics K>
double MaterialPointPhase<B, K>::total_mass() const {
  // in the order of the points' numbers, which does not change
  std::vector<double> m(points());
  for_points([&](std::size_t, std::size_t p, std::size_t number) { m[number] = body_.points.mass[p]; });
  return sum_over(m.size(), [&](std::size_t p) { return m[p]; });
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::point_displacement(double t, ConstVec u, Vec out) const {
  spread(t, u, grid_u_);
  for_points([&](std::size_t k, std::size_t p, std::size_t number) {
    const auto u_p = weights_.value(grid_u_.data(), k, p);
    for (int i = 0; i < Dim; ++i) {
      out[Dim * number + i] = updated_lagrangian_ ? body_.points.x[i][p] - origin_[Dim * number + i] + u_p[i] : u_p[i];
    }
  });
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::point_velocity(double t, ConstVec v, Vec out) const {
  const std::vector<double> grid_v = nodal_velocity(t, v);
  write_points(out, [&](std::size_t k, std::size_t p) { return weights_.value(grid_v.data(), k, p); });
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::point_strain(double t, ConstVec u, Vec out) const {
  spread(t, u, grid_u_);
  write_points(out, [&](std::size_t k, std::size_t p) { return weights_.gradient(grid_u_.data(), k, p); });
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::point_stress(double t, ConstVec u, Vec out) const {
  spread(t, u, grid_u_);
  write_points(out, [&](std::size_t k, std::size_t p) {
    return material_of(k).cauchy(weights_.gradient(grid_u_.data(), k, p), p);
  });
}

template <AxisBasis B, Kinematics K>
std::vector<std::string> MaterialPointPhase<B, K>::history_names() const {
  std::set<std::string> names;
  for (const auto& material : body_.materials) {
    for (const auto& [name, values] : material->shown_history()) names.insert(name);
  }
  return {names.begin(), names.end()};
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
  for (std::size_t s = 0; s < boundary_.prescribed().size(); ++s)
    held.push_back(boundary_.motion_of(s).displacement(t));
  return project(scene_.initial_u, held);
}

template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::initial_velocity(double t) {
  if (updated_lagrangian_) return velocity_from_points(t);
  std::vector<double> held;
  for (std::size_t s = 0; s < boundary_.prescribed().size(); ++s) held.push_back(boundary_.motion_of(s).velocity(t));
  std::vector<double> v = project(scene_.initial_v, held);
  begin_contact(t, v);
  return v;
}

template <AxisBasis B, Kinematics K>
std::vector<WallReaction> MaterialPointPhase<B, K>::wall_reactions(double t) const {
  std::vector<WallReaction> reactions;
  for (const WallContact& wall : boundary_.walls()) {
    const WallForce force = wall.force();
    reactions.push_back({wall.name(), force.normal, force.shear, wall.power(t)});
  }
  return reactions;
}

template <AxisBasis B, Kinematics K>
std::vector<PointArray> MaterialPointPhase<B, K>::point_arrays() const {
  constexpr double real = sizeof(double);
  std::vector<PointArray> arrays = {{"place", Dim * real}, {"mass", real}, {"volume", real}, {"number", sizeof(int)}};
  std::ranges::copy(PointWeights<B, K>::arrays(), std::back_inserter(arrays));
  if (updated_lagrangian_) {
    arrays.push_back({"velocity", Dim * real});
    arrays.push_back({"place at the start", Dim * real});
    if (scene_.phase.transfer == Transfer::apic) arrays.push_back({"affine velocity", Dim * Dim * real});
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
  return arrays;
}

template <AxisBasis B, Kinematics K>
std::vector<int> MaterialPointPhase<B, K>::grid_cells() const {
  std::vector<int> cells;
  for (const Axis& axis : grid_.axes) cells.push_back(axis.cells());
  return cells;
}

// M_ff u_f = Σ_p m_p N_fp u_0(x_p) − M_fs u_s: the least-squares fit at the material points, whatever M the motion
// uses.
template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::project(const std::vector<Expression>& field,
                                                      const std::vector<double>& held) const {
  std::vector<double> u(size(), 0.0);
  if (field.empty()) return u;
  for_points([&](std::size_t k, std::size_t p, std::size_t) {
    for (int i = 0; i < Dim; ++i) {
      const double moment = body_.points.mass[p] * field[static_cast<std::size_t>(i)](body_.points.position(p), 0);
      weights_.add_at_functions(k, p, i, moment, *dofs_, u);
    }
  });
  const SplitMatrix M = updated_lagrangian_ ? consistent_mass<B, K>(body_.points, weights_, *dofs_) : consistent_;
  if (!held.empty()) {
    const Eigen::Map<const Eigen::VectorXd> u_s(held.data(), static_cast<Eigen::Index>(held.size()));
    Eigen::Map<Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size())) -= M.prescribed * u_s;
  }
  SparseCholesky(M.free).solve(u, u);
  return u;
}
}  // namespace stillpoint
