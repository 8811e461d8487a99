// Loads that keep their proportion and are driven by a displacement, so that a body can be followed to its limit load
// and beyond, where no larger load has an equilibrium.
//
//   load = λ F,   q = F·u/P,   P = Σ_a |F_a| over the functions a
//
// F: the reference loads, as the scene gives them. Their mean displacement q is prescribed, q = q(t), and the factor λ
// is what that takes: a spring with the weights w = F/P (springs.hpp) gives k (q(t) − w·u) w, so that
//
//   λ = k (q(t) − w·u)/P.
//
// The path is that of displacement control [Batoz and Dhatt 1979], whatever the loads are: it goes on where λ falls. q
// lags behind q(t) by λ P/k; what belongs to λ is the q that there is.
#pragma once

#include <stillpoint/scene.hpp>

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "scene/controlled_loads.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/boundary_conditions.hpp"
#include "space/boundary/load_state.hpp"
#include "space/boundary/springs.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class LoadControl {
  static constexpr int dim = dimensions(K);
  using Parts = PhaseParts<B, K>;
  // Of the stiffest spring that leaves the critical step alone where the loads act at a single function.
  static constexpr double beta = 0.25;

 public:
  /// grid: the first one; time_scale: of PrescribedMotion.
  LoadControl(const Scene& scene, const Grid<dim>& grid, double time_scale)
      : reference_(scene.load ? reference_loads(scene) : Scene()) {
    if (!scene.load) return;
    motion_.emplace_back(scene.load->displacement, time_scale);
    loads_ = make_boundary_conditions<B, K>(reference_, grid, time_scale);
  }
  LoadControl(const LoadControl&) = delete;  // loads_ knows where reference_ is
  LoadControl& operator=(const LoadControl&) = delete;

  bool acts() const { return !motion_.empty(); }
  const Springs& springs() const { return springs_; }

  /// stiffness_bound(): G_a ≥ Σ_b |K_ab|, (functions) [N/m]. Throws SceneError if the loads act on nothing that is
  /// free.
  template <class StiffnessBound>
  void begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound) {
    if (!acts()) return;
    std::vector<double> F(phase.dofs.size(), 0.0), at_rest(phase.dofs.number.size(), 0.0);
    for (const auto& load : loads_) {
      load->begin_phase(phase, F);
      load->add_load(phase, 0, F);
      if (load->follows()) load->add_following_force(phase, 0, at_rest.data(), F);
    }
    total_ = magnitude(F, phase.dofs);
    if (!(total_ > 0)) throw_scene_error(reference_, "load", "the loads act on nothing that can move");
    std::vector<Springs::Weight> weights;
    for (std::size_t k = 0; k < F.size(); ++k) {
      if (F[k] != 0) weights.push_back({phase.dofs.free[k], static_cast<int>(k), F[k] / total_});
    }
    if (!(stiffness_ > 0)) {  // of all phases that of the first
      const std::vector<double> G = stiffness_bound();
      double compliance = 0;
      for (const auto& [unknown, dof, w] : weights) compliance += w * w / G[static_cast<std::size_t>(unknown / dim)];
      stiffness_ = beta / compliance;
    }
    springs_.clear();
    springs_.add(stiffness_, moved_, motion_.front(), weights);
  }
  /// The phase ends with u, over the grid's functions.
  void end_phase(const double* u) {
    if (!acts()) return;
    moved_ += springs_.displacement(0, u);
    for (const auto& load : loads_) load->end_phase(u);
  }
  void archive(const StateArchive& state) {
    if (!acts()) return;
    state("moved", moved_);
    state("stiffness", stiffness_);
    for (std::size_t k = 0; k < loads_.size(); ++k) loads_[k]->archive(state.part(fmt::format("load_{}", k)));
  }
  /// F_s += λ F at the prescribed degrees of freedom, at (t, u).
  void add_load_on_supports(const Parts& phase, double t, const double* u, Vec F_s) const {
    if (!acts()) return;
    const std::vector<double> at_rest(phase.dofs.number.size(), 0.0);
    std::vector<double> F(F_s.size(), 0.0);
    for (const auto& load : loads_) load->add_load_on_supports(phase, 0, at_rest.data(), F);
    const double factor = state(t, u).factor;
    for (std::size_t s = 0; s < F.size(); ++s) F_s[s] += factor * F[s];
  }
  /// At (t, u), u over the grid's functions.
  LoadState state(double t, const double* u) const {
    return {.factor = -stiffness_ * springs_.gap(0, t, u) / total_,
            .displacement = moved_ + springs_.displacement(0, u),
            .prescribed = motion_.front().displacement(t)};
  }

 private:
  static double magnitude(const std::vector<double>& F, const DegreesOfFreedom& dofs) {
    std::vector<double> square(dofs.number.size() / dim, 0.0);
    for (std::size_t k = 0; k < F.size(); ++k) square[static_cast<std::size_t>(dofs.free[k] / dim)] += F[k] * F[k];
    double sum = 0;
    for (const double of_function : square) sum += std::sqrt(of_function);
    return sum;
  }

  const Scene reference_;  // the scene with these loads alone
  BoundaryConditions<B, K> loads_;
  std::vector<PrescribedMotion> motion_;  // q(t); none: nothing is driven
  Springs springs_;                       // one, of the present phase
  double total_ = 0;                      // P [N]
  double stiffness_ = 0;                  // k [N/m]
  double moved_ = 0;                      // q when the phase began [m]
};

}  // namespace stillpoint
