// Output fields at the points of a phase, and the projection of initial values onto the grid.
#pragma once

#include <set>
#include <utility>

#include "space/phase/law_gradients.hpp"
#include "space/phase/material_point_phase.hpp"
#include "space/phase/phase_places.hpp"

namespace stillpoint {

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
std::vector<double> MaterialPointPhase<B, K>::initial_displacement(double t) const {
  std::vector<double> held;
  for (std::size_t s = 0; s < held_.prescribed().size(); ++s) held.push_back(held_.motion(s).displacement(t));
  return project(problem_.initial_u, held);
}

template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::initial_velocity(double t) {
  if (updated_lagrangian()) return velocity_from_points(t);
  std::vector<double> held;
  for (std::size_t s = 0; s < held_.prescribed().size(); ++s) held.push_back(held_.motion(s).velocity(t));
  std::vector<double> v = project(problem_.initial_v, held);
  begin_motion(t, v);
  return v;
}

template <AxisBasis B, Kinematics K>
std::vector<FreePart> MaterialPointPhase<B, K>::free_parts() const {
  const std::vector<char> sprung = conditions_.are_sprung(dofs_->number.size());
  return find_free_parts<Dim>({functions_, body_.points, weights_}, K == Kinematics::axisymmetric ? 1 : 0, *dofs_,
                              sprung, /*as_one=*/updated_lagrangian());
}

template <AxisBasis B, Kinematics K>
Discretisation MaterialPointPhase<B, K>::discretisation() const {
  constexpr double real = sizeof(double);
  std::vector<PointArray> arrays = PointWeights<B, K>::arrays();
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
  std::vector<int> cells;
  for (const Axis& axis : grid_.axes) cells.push_back(axis.cells());
  const std::set<int> occupied(body_.points.cell.begin(), body_.points.cell.end());
  return {account().arrays(points(), arrays), dofs_->prescribed.size(), std::move(cells), occupied.size(),
          body_.quadrature};
}

// The projection M_ff u_f = Σ_p m_p N_fp u_0(x_p) − M_fs u_s: the least-squares fit at the material points, whatever
// the mass of the motion.
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
