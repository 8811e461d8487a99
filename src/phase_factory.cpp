// Puts a phase together from a scene. The dimension, the basis and the law become template parameters here, once.
#include <stillpoint/lagrangian_phase.hpp>
#include <stillpoint/linear_elastic.hpp>
#include <stillpoint/neo_hookean.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "material_point_phase.hpp"
#include "reject.hpp"

namespace stillpoint {
namespace {

template <int Dim>
Grid<Dim> make_grid(const GridSpec& spec) {
  Grid<Dim> grid;
  for (std::size_t d = 0; d < Dim; ++d) grid.axes[d] = Axis::uniform(spec.min[d], spec.max[d], spec.cells[d]);
  return grid;
}

template <int Dim>
Point<Dim> point_of(const std::vector<double>& at) {
  Point<Dim> x;
  std::copy_n(at.begin(), Dim, x.begin());
  return x;
}

/// Builds the parts in the order in which they depend on each other.
template <AxisBasis B, MaterialLaw Law>
class PhaseBuilder {
  static constexpr int Dim = Law::dim;
  using Basis = TensorBasis<B, Dim>;

 public:
  PhaseBuilder(const Scene& scene, const Law& law)
      : scene_(scene),
        law_(law),
        grid_(make_grid<Dim>(scene.grid)),
        body_(
            place_body<Dim>(scene.bodies[0], grid_, scene.materials.at(scene.bodies[0].material).parameters.at("rho"))),
        weights_(grid_, body_.points) {}

  std::unique_ptr<LagrangianPhase> build() const {
    const DegreesOfFreedom dofs = degrees_of_freedom();
    SplitMatrix consistent = consistent_mass<B, Dim>(body_.points, weights_, dofs);
    std::vector<PrescribedMotion> motions;
    for (const auto& support : scene_.supports) motions.emplace_back(support.motion, time_scale());
    NodalLoads loads = nodal_loads(dofs);
    const bool varying_body_force =
        std::ranges::any_of(scene_.body_force, [](const Expression& b) { return b.uses('t'); });
    if (!varying_body_force) add_constant_body_force(dofs, loads);
    check_projection(consistent.free);
    Mass mass = make_mass(dofs, consistent.free);
    return std::make_unique<MaterialPointPhase<B, Law>>(
        PhaseParts<B, Law>{.points = body_.points,
                           .quadrature = body_.quadrature,
                           .weights = weights_,
                           .dofs = dofs,
                           .mass = std::move(mass),
                           .consistent = std::move(consistent),
                           .loads = std::move(loads),
                           .motions = std::move(motions),
                           .body_force = varying_body_force ? scene_.body_force : std::vector<Expression>{},
                           .initial_u = scene_.initial_u,
                           .initial_v = scene_.initial_v,
                           .law = law_,
                           .grid_functions = Basis::count(grid_)});
  }

 private:
  // A wave's time through half the smallest cell, h/2 √(ρ/A) with the undeformed modulus A: about 1/omega_max [s].
  double time_scale() const {
    double h = std::numeric_limits<double>::infinity();
    for (const Axis& axis : grid_.axes) {
      for (int c = 0; c < axis.cells(); ++c) h = std::min(h, axis.nodes[c + 1] - axis.nodes[c]);
    }
    const double density = scene_.materials.at(scene_.bodies[0].material).parameters.at("rho");
    return h / 2 * std::sqrt(density / law_.moduli({})[0]);
  }

  DegreesOfFreedom degrees_of_freedom() const {
    std::vector<bool> reached(static_cast<std::size_t>(Dim * Basis::count(grid_)), false);
    for (std::size_t p = 0; p < body_.points.size(); ++p) {
      for (int a = 0; a < Basis::per_cell; ++a) {
        if (weights_.N(a, p) == 0) continue;
        for (int i = 0; i < Dim; ++i) reached[static_cast<std::size_t>(Dim * weights_.function(p, a) + i)] = true;
      }
    }
    std::vector<int> prescribed;
    for (std::size_t s = 0; s < scene_.supports.size(); ++s) {
      const std::string key = fmt::format("support[{}].at", s);
      const auto function = Basis::interpolating_function(grid_, point_of<Dim>(scene_.supports[s].at));
      if (!function) {
        reject(scene_, key,
               "a support must lie where the basis has a value of its own: at a node of a linear or hermite grid, at "
               "an end of a quadratic or cubic one");
      }
      const int unknown = Dim * *function + scene_.supports[s].component;
      if (!reached[static_cast<std::size_t>(unknown)]) reject(scene_, key, "no material reaches this support");
      if (std::ranges::find(prescribed, unknown) != prescribed.end())
        reject(scene_, key, "this place is supported already");
      prescribed.push_back(unknown);
    }
    return {reached, prescribed};
  }

  Mass make_mass(const DegreesOfFreedom& dofs, const SparseMatrix& consistent) const {
    try {
      if (scene_.mass.kind == MassKind::consistent) return Mass::consistent(consistent);
      return Mass::lumped(lumped_mass<B, Dim>(body_.points, weights_, dofs));
    } catch (const std::invalid_argument& error) {
      reject(scene_, "mass.kind", error.what());
    }
  }

  // Initial values are fitted with the consistent mass, whatever the motion uses.
  void check_projection(const SparseMatrix& consistent) const {
    const bool projects = !scene_.initial_u.empty() || !scene_.initial_v.empty();
    if (!projects || scene_.mass.kind == MassKind::consistent || SparseCholesky(consistent).positive_definite()) return;
    reject(scene_, "initial",
           "initial values cannot be fitted: too few material points for the basis; expected more points per cell");
  }

  // Weights N_i(x) of the free degrees of freedom at a place.
  NodalLoads::Weights weights_at(const Point<Dim>& x, int component, const DegreesOfFreedom& dofs,
                                 const std::string& key) const {
    const auto cell = grid_.cell_of(x);
    const auto values = Basis::evaluate(grid_, cell, x);
    const auto offset = Basis::offsets(grid_);
    NodalLoads::Weights weights;
    for (int a = 0; a < Basis::per_cell; ++a) {
      const int dof = dofs.number[static_cast<std::size_t>(Dim * (Basis::first(grid_, cell) + offset[a]) + component)];
      if (dof < 0 && std::abs(values.N[a]) > 1e-12) reject(scene_, key, "there is no material at this place");
      if (dofs.is_free(dof) && values.N[a] != 0) weights.emplace_back(dof, values.N[a]);
    }
    return weights;
  }

  NodalLoads nodal_loads(const DegreesOfFreedom& dofs) const {
    NodalLoads loads(dofs.size());
    for (std::size_t f = 0; f < scene_.forces.size(); ++f) {
      const auto& force = scene_.forces[f];
      for (int i = 0; i < Dim; ++i) {
        loads.add(force.value[static_cast<std::size_t>(i)],
                  weights_at(point_of<Dim>(force.at), i, dofs, fmt::format("force[{}].at", f)));
      }
    }
    for (std::size_t f = 0; f < scene_.tractions.size(); ++f) {
      static_assert(Dim == 1, "a face of the body is a point in one dimension only");
      const auto& traction = scene_.tractions[f];
      const Point<Dim> face{is_upper(traction.face) ? scene_.bodies[0].max[0] : scene_.bodies[0].min[0]};
      auto weights = weights_at(face, 0, dofs, fmt::format("traction[{}].face", f));
      for (auto& [dof, weight] : weights) weight *= scene_.bodies[0].area;
      loads.add(traction.value[0], std::move(weights));
    }
    return loads;
  }

  // F_i = Σ_p N_ip m_p b(x_p)
  void add_constant_body_force(const DegreesOfFreedom& dofs, NodalLoads& loads) const {
    if (scene_.body_force.empty()) return;
    for (std::size_t p = 0; p < body_.points.size(); ++p) {
      for (int i = 0; i < Dim; ++i) {
        const double force =
            body_.points.mass[p] * scene_.body_force[static_cast<std::size_t>(i)](body_.points.place(p), 0);
        for (int a = 0; a < Basis::per_cell; ++a) {
          const int dof = dofs.number[static_cast<std::size_t>(Dim * weights_.function(p, a) + i)];
          if (dofs.is_free(dof)) loads.add_constant(dof, force * weights_.N(a, p));
        }
      }
    }
  }

  const Scene& scene_;
  Law law_;
  Grid<Dim> grid_;
  PlacedBody<Dim> body_;
  PointWeights<B, Dim> weights_;
};

template <MaterialLaw Law>
std::unique_ptr<LagrangianPhase> with_law(const Scene& scene, const Law& law) {
  switch (scene.grid.basis) {
    case BasisKind::linear:
      return PhaseBuilder<BSpline<1>, Law>(scene, law).build();
    case BasisKind::quadratic:
      return PhaseBuilder<BSpline<2>, Law>(scene, law).build();
    case BasisKind::cubic:
      return PhaseBuilder<BSpline<3>, Law>(scene, law).build();
    case BasisKind::hermite:
      return PhaseBuilder<CubicHermite, Law>(scene, law).build();
  }
  throw std::logic_error("a basis without an instantiation");
}

template <StressState State>
std::unique_ptr<LagrangianPhase> with_state(const Scene& scene) {
  const MaterialSpec& material = scene.materials.at(scene.bodies[0].material);
  const auto lame = LameParameters::from(material.parameters.at("E"), material.parameters.at("nu"));
  if (material.law == "linear-elastic") return with_law(scene, LinearElastic<State>(lame));
  if (material.law == "neo-hookean") return with_law(scene, NeoHookean<State>(lame));
  throw std::logic_error("a material law without an instantiation");
}

}  // namespace

std::unique_ptr<LagrangianPhase> make_phase(const Scene& scene) {
  switch (scene.state) {
    case StressState::uniaxial_stress:
      return with_state<StressState::uniaxial_stress>(scene);
    case StressState::uniaxial_strain:
      return with_state<StressState::uniaxial_strain>(scene);
    default:
      break;
  }
  throw std::logic_error("a stress state without an instantiation");
}

}  // namespace stillpoint
