#include "space/boundary/load_control.hpp"

#include <cmath>

#include <fmt/format.h>

#include "scene/controlled_loads.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

// Share of the stiffness of the stiffest spring that leaves the critical step unchanged where the loads act at a single
// function.
constexpr double beta = 0.25;

// The total load Σ_a |F_a|.
double magnitude(int dim, const std::vector<double>& F, const DegreesOfFreedom& dofs) {
  std::vector<double> square(dofs.number.size() / static_cast<std::size_t>(dim), 0.0);
  for (std::size_t k = 0; k < F.size(); ++k) square[static_cast<std::size_t>(dofs.free[k] / dim)] += F[k] * F[k];
  double sum = 0;
  for (const double of_function : square) sum += std::sqrt(of_function);
  return sum;
}

}  // namespace

template <Kinematics K>
LoadControl<K>::LoadControl(const Problem& problem, const Grid<dim>& grid, double time_scale)
    : reference_(problem.load ? reference_loads(problem) : Problem()) {
  if (!problem.load) return;
  motion_.emplace_back(problem.load->displacement, time_scale);
  loads_ = make_boundary_conditions<K>(reference_, grid, time_scale);
}

template <Kinematics K>
void LoadControl<K>::begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound) {
  if (!acts()) return;
  std::vector<double> F(phase.dofs.size(), 0.0), at_rest(phase.dofs.number.size(), 0.0);
  for (const auto& load : loads_) {
    load->begin_phase(phase, F);
    load->add_load(phase, 0, F);
    if (load->follows()) load->add_following_force(phase, 0, at_rest.data(), F);
  }
  total_ = magnitude(dim, F, phase.dofs);
  if (!(total_ > 0)) throw_scene_error("load", "the loads act on nothing that can move");
  std::vector<Springs::Weight> weights;
  for (std::size_t k = 0; k < F.size(); ++k) {
    if (F[k] != 0) weights.push_back({phase.dofs.free[k], static_cast<int>(k), F[k] / total_});
  }
  if (!(stiffness_ > 0)) {  // set in the first phase for all phases
    const std::vector<double> G = stiffness_bound();
    double compliance = 0;
    for (const auto& [unknown, dof, w] : weights) compliance += w * w / G[static_cast<std::size_t>(unknown / dim)];
    stiffness_ = beta / compliance;
  }
  springs_.clear();
  springs_.add(stiffness_, moved_, motion_.front(), weights);
}

template <Kinematics K>
void LoadControl<K>::end_phase(const double* u, bool in_place) {
  if (!acts()) return;
  moved_ += springs_.displacement(0, u);
  for (std::size_t k = 0; k < loads_.size() && !in_place; ++k) loads_[k]->end_phase(u);
}

template <Kinematics K>
void LoadControl<K>::archive(const StateArchive& state) {
  if (!acts()) return;
  state("moved", moved_);
  state("stiffness", stiffness_);
  for (std::size_t k = 0; k < loads_.size(); ++k) loads_[k]->archive(state.part(fmt::format("load_{}", k)));
}

template <Kinematics K>
void LoadControl<K>::add_load_on_supports(const Parts& phase, double t, const double* u, Vec F_s) const {
  if (!acts()) return;
  const std::vector<double> at_rest(phase.dofs.number.size(), 0.0);
  std::vector<double> F(F_s.size(), 0.0);
  for (const auto& load : loads_) load->add_load_on_supports(phase, 0, at_rest.data(), F);
  const double factor = state(t, u).factor;
  for (std::size_t s = 0; s < F.size(); ++s) F_s[s] += factor * F[s];
}

template <Kinematics K>
LoadState LoadControl<K>::state(double t, const double* u) const {
  return {.factor = 0 - stiffness_ * springs_.gap(0, t, u) / total_,  // which is never -0
          .displacement = moved_ + springs_.displacement(0, u),
          .prescribed = motion_.front().displacement(t)};
}

template class LoadControl<Kinematics::line>;
template class LoadControl<Kinematics::plane>;
template class LoadControl<Kinematics::axisymmetric>;
template class LoadControl<Kinematics::space>;

}  // namespace stillpoint
