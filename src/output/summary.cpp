#include <stillpoint/summary.hpp>

#include <utility>

#include "base/json.hpp"

namespace stillpoint {

std::string to_string(RunStatus status) {
  switch (status) {
    case RunStatus::running:
      return "running";
    case RunStatus::equilibrium:
      return "equilibrium";
    case RunStatus::unstable_equilibrium:
      return "unstable-equilibrium";
    case RunStatus::limit_load:
      return "limit-load";
    case RunStatus::stop_test:
      return "stop-test";
    case RunStatus::end_time:
      return "end-time";
    case RunStatus::step_limit:
      return "step-limit";
    case RunStatus::time_limit:
      return "time-limit";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::diverged:
      return "diverged";
    case RunStatus::failed:
      return "failed";
  }
  return "unknown";
}

namespace {

Json text(const std::string& word) { return word.empty() ? Json(nullptr) : Json(word); }

}  // namespace

std::string to_json(const Summary& s) {
  Json error = nullptr;
  if (s.error) {
    error = {{"u_rel_l2", number(s.error->u_rel_l2)},
             {"u_rel_max", number(s.error->u_rel_max)},
             {"stress_rel_l2", number(s.error->stress_rel_l2)}};
  }
  Json::object_t probes;  // names differ, and searching for each among all earlier ones would take long
  for (const auto& [name, fields] : s.probes) {
    Json of_probe = Json::object();
    for (const auto& [field, value] : fields) of_probe[field] = number(value);
    probes.emplace_back(name, std::move(of_probe));
  }
  const auto by_support = [](const std::map<std::string, std::vector<double>>& vectors) {
    Json all = Json::object();
    for (const auto& [name, vector] : vectors)
      for (std::size_t i = 0; i < vector.size(); ++i) all[name][std::string(1, "xyz"[i])] = number(vector[i]);
    return all;
  };
  Json weak_supports = Json::array();
  for (const SupportGap& weak : s.weak_supports)
    weak_supports.push_back({{"support", weak.support},
                             {"stiffness", number(weak.stiffness)},
                             {"gap", number(weak.gap)},
                             {"share_of_displacement", number(weak.share)}});
  Json ended_stages = Json::array();
  for (const StageFigures& stage : s.stages) {
    ended_stages.push_back({{"begin", number(stage.begin)},
                            {"end", number(stage.end)},
                            {"status", to_string(stage.status)},
                            {"reason", stage.reason},
                            {"residual", number(stage.residual)},
                            {"steps", stage.steps}});
  }
  Json stages = Json::array();
  for (const Snapshot& stage : s.snapshots)
    stages.push_back({{"t", number(stage.t)}, {"slope_angle", number(stage.slope_angle)}});

  Json load = nullptr;
  if (s.load) {
    load = {{"factor", number(s.load->factor)},
            {"largest_factor", number(s.load->largest_factor)},
            {"displacement", number(s.load->displacement)},
            {"growth", number(s.load->growth)}};
  }

  const Json json = {{"scene", s.scene},
                     {"title", s.title},
                     {"status", to_string(s.status)},
                     {"reason", s.reason},
                     {"exit_status", s.exit_status},
                     {"t", number(s.t)},
                     {"steps", s.steps},
                     {"rejected_steps", s.rejected_steps},
                     {"rhs_evaluations", s.rhs_evaluations},
                     {"phases", s.phases},
                     {"points", s.points},
                     {"dofs", s.dofs},
                     {"threads", s.threads},
                     {"ranks", s.ranks},
                     {"wall_s", number(s.wall_s)},
                     {"ns_per_point_step", number(s.ns_per_point_step)},
                     {"bytes_per_point", number(s.bytes_per_point)},
                     {"residual", number(s.residual)},
                     {"distance", number(s.distance)},
                     {"distance_kind", text(s.distance_kind)},
                     {"way_left", number(s.way_left)},
                     {"kinetic_energy", number(s.kinetic_energy)},
                     {"external_work", number(s.external_work)},
                     {"plastic_overshoot", number(s.plastic_overshoot)},
                     {"unbalanced_plastic_work", number(s.unbalanced_plastic_work)},
                     {"rate_share", number(s.rate_share)},
                     {"resting_points", number(s.resting_points)},
                     {"held_force", number(s.held_force)},
                     {"single_phase_strain", number(s.single_phase_strain)},
                     {"mass_error", number(s.mass_error)},
                     {"momentum_error", number(s.momentum_error)},
                     {"angular_momentum_error", number(s.angular_momentum_error)},
                     {"added_inertia", number(s.added_mass)},
                     {"null_space_stress", number(s.null_space_stress)},
                     {"slope_angle", number(s.slope_angle)},
                     {"stages", stages},
                     {"ended_stages", ended_stages},
                     {"method", s.method},
                     {"integrator", text(s.integrator)},
                     {"damping", text(s.damping)},
                     {"stability", text(s.stability)},
                     {"unstable_omega_squared", number(s.unstable_omega_squared)},
                     {"omega_1", number(s.omega_1)},
                     {"omega_max", number(s.omega_max)},
                     {"c", number(s.c)},
                     {"dt", number(s.dt)},
                     {"critical_step", number(s.critical_step)},
                     {"notes", s.notes},
                     {"error", error},
                     {"reactions", by_support(s.reactions)},
                     {"reaction_moments", by_support(s.reaction_moments)},
                     {"contacts", s.contacts},
                     {"weak_supports", weak_supports},
                     {"load", load},
                     {"probes", probes},
                     {"probe_places", s.probe_positions},
                     {"versions", versions_of_libraries()}};
  return json.dump(2) + "\n";
}

}  // namespace stillpoint
