#include <stillpoint/run.hpp>

#include "base/json.hpp"

namespace stillpoint {
std::string to_json(const Summary& s) {
  Json error = nullptr;
  if (s.error) {
    error = {{"u_rel_l2", number(s.error->u_rel_l2)},
             {"u_rel_max", number(s.error->u_rel_max)},
             {"stress_rel_l2", number(s.error->stress_rel_l2)}};
  }
  Json probes = Json::object();
  for (const auto& [name, fields] : s.probes) {
    for (const auto& [field, value] : fields) probes[name][field] = number(value);
  }
  Json stages = Json::array();
  for (const Snapshot& stage : s.snapshots)
    stages.push_back({{"t", number(stage.t)}, {"slope_angle", number(stage.slope_angle)}});

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
                     {"wall_s", number(s.wall_s)},
                     {"ns_per_point_step", number(s.ns_per_point_step)},
                     {"bytes_per_point", number(s.bytes_per_point)},
                     {"residual", number(s.residual)},
                     {"distance", number(s.distance)},
                     {"kinetic_energy", number(s.kinetic_energy)},
                     {"external_work", number(s.external_work)},
                     {"mass_error", s.transfer ? number(s.transfer->mass) : Json(nullptr)},
                     {"momentum_error", s.transfer ? number(s.transfer->momentum) : Json(nullptr)},
                     {"added_inertia", s.transfer ? number(s.transfer->added_mass) : Json(nullptr)},
                     {"slope_angle", number(s.slope_angle)},
                     {"stages", stages},
                     {"integrator", s.integrator},
                     {"damping", s.damping},
                     {"omega_1", number(s.omega_1)},
                     {"omega_max", number(s.omega_max)},
                     {"c", number(s.c)},
                     {"dt", number(s.dt)},
                     {"critical_step", number(s.critical_step)},
                     {"notes", s.notes},
                     {"error", error},
                     {"probes", probes},
                     {"probe_places", s.probe_positions},
                     {"versions", versions_of_libraries()}};
  return json.dump(2) + "\n";
}

}  // namespace stillpoint
