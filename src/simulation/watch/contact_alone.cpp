#include "simulation/watch/contact_alone.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "scene/contact_bodies.hpp"

namespace stillpoint {

bool slips(const LagrangianPhase& phase, double t, ConstVec u) {
  return std::ranges::any_of(phase.supports().contacts(t, u),
                             [](const ContactReport& one) { return one.slipping > 0; });
}

std::vector<std::size_t> on_contact_alone(const LagrangianPhase& phase) {
  std::map<std::size_t, int> axes;  // that are free
  for (const FreePart& part : phase.shape().free_parts()) ++axes[part.point];
  std::vector<std::size_t> points;
  for (const auto& [point, free] : axes)
    if (free == phase.dim() && phase.dim() > 1) points.push_back(point);
  return points;
}

std::string note_on_small_contact(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  constexpr double small = 0.5;  // beside the face of a cube of the body's volume
  if (!phase.info().may_touch) return "";
  const PointData data = phase.fields().point_data();
  const std::vector<ContactReport> reports = phase.supports().contacts(t, u);
  for (const std::size_t point : on_contact_alone(phase)) {
    const auto k = static_cast<std::size_t>(data.bodies[point]);
    const std::string& name = problem.bodies[k].name;
    double touching = 0, volume = 0;
    for (std::size_t r = 0; r < reports.size(); ++r) {
      const bool of_body = r < problem.rigid.size()
                               ? problem.rigid[r].touches(name)
                               : std::ranges::count(problem.contacts[r - problem.rigid.size()].bodies, name) > 0;
      if (of_body) touching += reports[r].area;
    }
    for (std::size_t p = 0; p < data.bodies.size(); ++p)
      if (data.bodies[p] == data.bodies[point]) volume += data.volumes[p];
    const double depth = phase.dim() == 2 ? problem.bodies[k].area : 1;
    const double face = depth * std::pow(volume / depth, 1 - 1.0 / phase.dim());
    if (!(touching < small * face)) continue;
    return fmt::format(
        "{} rests on contact alone, on a face that is {:.2g} of its size, and whether it would roll or tip was not "
        "judged: {}",
        name_of_body(problem, k), touching / face,
        phase.info().remembers ? "its material remembers its way"
        : phase.info().of_small_strain
            ? "a law of small strains does not feel that; expected \"neo-hookean\" or \"hencky\""
        : slips(phase, t, u) ? "a part of what it touches slips"
                             : "K(u) is too large to be factorised");
  }
  return "";
}

}  // namespace stillpoint
