// What contact with rigid bodies tells of itself.
#include <algorithm>
#include <cmath>

#include "space/boundary/rigid_contact.hpp"

namespace stillpoint {

template <Kinematics K>
ContactState RigidContact<K>::state(double t, const double* u) const {
  ContactState state;
  double changes = 0, forces = 0;  // squares [N²]
  for (const RigidBody& rigid : bodies_) {
    std::vector<double> area(surface_.patches().size(), 0.0), gap = area, force = area;
    for_closed(rigid, rigid.finder.placement(t), u, [&](const Touch& touch) {
      area[touch.patch] += touch.area;
      gap[touch.patch] += touch.area * touch.at.distance;
      force[touch.patch] += touch.area * touch.p;
    });
    for (std::size_t k = 0; k < area.size(); ++k) {
      if (!(area[k] > 0)) continue;
      state.touches = true;
      state.misfit = std::max(state.misfit, std::abs(gap[k]) / area[k] / surface_.patches()[k].cell);
      changes += std::pow(force[k] - rigid.lambda[k] * area[k], 2);
      forces += std::pow(force[k], 2);
    }
  }
  state.change = forces > 0 ? std::sqrt(changes / forces) : 0;
  return state;
}

template <Kinematics K>
std::vector<RigidReport> RigidContact<K>::report(double t, const double* u) const {
  constexpr double rounding = 1e-6;  // of the limit: a piece whose anchor was dragged is at it
  std::vector<RigidReport> reports;
  for (const RigidBody& rigid : bodies_) {
    RigidReport& report = reports.emplace_back();
    report.name = rigid.finder.spec().name;
    const RigidPlacement<N> placement = rigid.finder.placement(t);
    const Position centre = placement.a + placement.u;
    double slipping = 0;
    for_closed(rigid, placement, u, [&](const Touch& touch) {
      const Position f = touch.area * (touch.p * touch.at.normal + touch.tau), arm = touch.x - centre;
      for (int i = 0; i < N; ++i) report.force[static_cast<std::size_t>(i)] += f[i];
      if constexpr (N == 3) {
        for (std::size_t i = 0; i < 3; ++i) {
          const auto j = static_cast<int>((i + 1) % 3), k = static_cast<int>((i + 2) % 3);
          report.moment[i] += arm[j] * f[k] - arm[k] * f[j];
        }
      } else {
        report.moment[2] += arm[0] * f[1] - arm[1] * f[0];
      }
      report.area += touch.area;
      if (touch.tau.norm() >= (1 - rounding) * rigid.friction * touch.p) slipping += touch.area;
      report.penetration = std::max(report.penetration, -touch.at.distance / surface_.patches()[touch.patch].cell);
    });
    report.slipping = report.area > 0 ? slipping / report.area : 0;
  }
  return reports;
}

template ContactState RigidContact<Kinematics::line>::state(double, const double*) const;
template ContactState RigidContact<Kinematics::plane>::state(double, const double*) const;
template ContactState RigidContact<Kinematics::axisymmetric>::state(double, const double*) const;
template ContactState RigidContact<Kinematics::space>::state(double, const double*) const;
template std::vector<RigidReport> RigidContact<Kinematics::line>::report(double, const double*) const;
template std::vector<RigidReport> RigidContact<Kinematics::plane>::report(double, const double*) const;
template std::vector<RigidReport> RigidContact<Kinematics::axisymmetric>::report(double, const double*) const;
template std::vector<RigidReport> RigidContact<Kinematics::space>::report(double, const double*) const;

}  // namespace stillpoint
