// Fields of a phase, at its points and at positions of the body.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "space/grid/sliver_extension.hpp"
#include "space/kernels/point_fit.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/law_gradients.hpp"
#include "space/phase/phase_assembly.hpp"
#include "space/phase/phase_places.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class PhaseFieldsOf final : public PhaseFields {
  static constexpr int dim = dimensions(K);
  using Frame = PhaseFrame<B, K>;

 public:
  /// all: must outlive this object.
  explicit PhaseFieldsOf(const PhaseAssembly<B, K>& all) : all_(all), frame_(all.frame) {}

  PointData point_data() const override { return frame_.account().point_data(frame_.origin); }
  void point_history(const std::string& name, Vec out) const override { frame_.account().history(name, out); }
  std::optional<OverStress> over_stress() const override { return frame_.account().over_stress(); }
  SparseMatrix material_mass() const override {
    return frame_.problem.mass.factor *
           consistent_mass<B, K>(frame_.grid, frame_.body.points, frame_.weights, frame_.corner_sum, frame_.dofs())
               .free;
  }

  void point_field(PointQuantity quantity, double t, ConstVec nodal, Vec out) const override {
    const MaterialPoints<dim>& points = frame_.body.points;
    const PointWeights<B, K>& weights = frame_.weights;
    if (quantity == PointQuantity::velocity) {
      const std::vector<double> v = frame_.unknowns.velocities(t, nodal);
      return write(out, [&](std::size_t k, std::size_t p) { return weights.value(v.data(), k, p); });
    }
    const auto work = all_.force.borrow();
    frame_.unknowns.spread(t, nodal, work->u);
    const double* u = work->u.data();
    if (quantity == PointQuantity::volume) {
      std::ranges::fill(out, 0.0);
      frame_.for_points([&](std::size_t k, std::size_t p, std::size_t number) {
        const bool changes = frame_.material_of(k).info().finite_strain;
        out[number] += points.volume[p] * (changes ? determinant<K>(plus_identity<K>(weights.gradient(u, k, p))) : 1.0);
      });
      return unite(frame_.ranks, out);
    }
    if (quantity == PointQuantity::strain)
      return write(out, [&](std::size_t k, std::size_t p) { return weights.gradient(u, k, p); });
    if (quantity == PointQuantity::stress || quantity == PointQuantity::pore_pressure) {
      const auto shared = all_.force.laws().shared_dilatation(u, *work);
      LawGradients<B, K> gradients(frame_.body, weights, shared, u);
      if (quantity == PointQuantity::stress)
        return write(out,
                     [&](std::size_t k, std::size_t p) { return frame_.material_of(k).cauchy(gradients.at(k, p), p); });
      return write(out, [&](std::size_t k, std::size_t p) {
        return std::array{frame_.material_of(k).pore_pressure(gradients.at(k, p), p)};
      });
    }
    write(out, [&](std::size_t k, std::size_t p) {
      auto u_p = weights.value(u, k, p);
      if (!frame_.moves_on()) return u_p;
      const auto number = static_cast<std::size_t>(points.number[p]);
      for (int i = 0; i < dim; ++i) u_p[i] += points.x[i][p] - frame_.origin[dim * number + i];
      return u_p;
    });
  }

  std::unique_ptr<PlaceReader> read_places(double t, ConstVec u, ConstVec v) const override {
    using Spline = typename BasisOfOneCell<B>::type;
    // The gradients that the laws take, with what they refer to.
    struct Gradients {
      Gradients(const PhaseAssembly<B, K>& all, std::vector<double> of)
          : u(std::move(of)),
            shared(all.force.laws().shared_dilatation(u.data(), *all.force.borrow())),
            of_points(all.frame.body, all.frame.weights, shared, u.data()) {}
      std::vector<double> u;
      SharedDilatation<B, K> shared;
      LawGradients<B, K> of_points;
    };
    std::vector<double> grid_u(static_cast<std::size_t>(dim) * frame_.functions_of_grid(), 0);
    frame_.unknowns.spread(t, u, grid_u);
    const auto gradients = std::make_shared<Gradients>(all_, grid_u);
    return std::make_unique<PhasePlaces<K>>(
        std::make_unique<FunctionsOfBasis<Spline, dim>>(frame_.grid, frame_.body.fields), Spline::degree, frame_.body,
        frame_.ranks, frame_.dofs(),
        [gradients](std::size_t k, std::size_t p) { return gradients->of_points.at(k, p); }, std::move(grid_u),
        frame_.unknowns.velocities(t, v));
  }

  // Forces are Σ_p V_p σ_p ∇N_ip: a stress that varies from point to point faster than the functions is in the null
  // space of that sum, and nothing ever relaxes it [Gritton and Berzins 2017].
  double null_space_stress(double t, ConstVec u) const override {
    constexpr int stresses = stillpoint::stress_components(K);
    using Fit = PointFit<stresses, B, K>;
    const auto work = all_.force.borrow();
    frame_.unknowns.spread(t, u, work->u);
    const MaterialPoints<dim>& points = frame_.body.points;
    const std::vector<int>& first_number = frame_.body.first_number;
    typename Fit::Values of_points;
    of_points.value.resize(points.size());
    const auto shared = all_.force.laws().shared_dilatation(work->u.data(), *work);
    LawGradients<B, K> gradients(frame_.body, frame_.weights, shared, work->u.data());
    frame_.for_points([&](std::size_t k, std::size_t p, std::size_t) {
      of_points.value[p] = frame_.material_of(k).cauchy(gradients.at(k, p), p);
    });
    const auto square = [](const auto& values) {
      double sum = 0;
      for (const double value : values) sum += value * value;
      return sum;
    };
    const auto over_points = [&](const auto& term) { return sum_over_ranks(frame_.ranks, points.size(), term); };
    double missed = 0, all = 0;
    for (std::size_t b = 0; b + 1 < first_number.size(); ++b) {
      of_points.mass.assign(points.size(), 0);
      for (std::size_t p = 0; p < points.size(); ++p)
        if (points.number[p] >= first_number[b] && points.number[p] < first_number[b + 1])
          of_points.mass[p] = points.volume[p];
      const double volume = over_points([&](std::size_t p) { return of_points.mass[p]; });
      const double of_body = over_points([&](std::size_t p) { return of_points.mass[p] * square(of_points.value[p]); });
      all += of_body;
      if (!(of_body > 0)) continue;
      const Fit fit(frame_.grid, points, frame_.weights, frame_.corner_sum, of_points,
                    {.gradient_share = 0, .tolerance = 1e-3 * std::sqrt(of_body / volume), .iterations = 30});
      const std::vector<double> fitted = fit.solve({});
      std::vector<double> off(points.size());
      frame_.for_points([&](std::size_t k, std::size_t p, std::size_t) {
        auto by = fit.value(fitted, k, p);
        for (int i = 0; i < stresses; ++i) by[i] -= of_points.value[p][i];
        off[p] = of_points.mass[p] * square(by);
      });
      missed += over_points([&](std::size_t p) { return off[p]; });
    }
    return all > 0 ? std::sqrt(missed / all) : 0;
  }

 private:
  template <class ValueAt>
  void write(Vec out, const ValueAt& value_at) const {
    write_points(frame_.body, frame_.ranks, out, value_at);
  }

  const PhaseAssembly<B, K>& all_;
  const Frame& frame_;
};

}  // namespace stillpoint
