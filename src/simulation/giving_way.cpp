#include "simulation/giving_way.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/parallel_loop.hpp"
#include "base/text.hpp"

namespace stillpoint {

GivingWay::GivingWay(const Problem& problem, const LagrangianPhase& phase) : phase_(phase) {
  remembers_ = phase.info().remembers;
  yields_ = std::ranges::count(phase.info().law_fields, plastic_strain_name) > 0;
  for (const WallSpec& wall : problem.walls) shear_of_walls_.push_back({.friction = wall.friction});
  for (const RigidSpec& rigid : problem.rigid) {
    contacts_.push_back("rigid body " + in_quotes(rigid.name));
    shear_of_contacts_.push_back(rigid.shear);
  }
  for (const ContactSpec& contact : problem.contacts) {
    contacts_.push_back(in_quotes(contact.bodies[0]) + " on " + in_quotes(contact.bodies[1]));
    shear_of_contacts_.push_back(contact.shear);
  }
  has_friction_ = std::ranges::any_of(shear_of_walls_, &ShearLimit::ends) ||
                  std::ranges::any_of(shear_of_contacts_, &ShearLimit::ends);
  if (yields_) volumes_ = phase.fields().point_data().volumes;
}

double GivingWay::plastic_strain() const {
  if (!yields_) return 0;
  std::vector<double> of_points(volumes_.size());  // not kept: memory counts more than the time of a sample
  phase_.fields().point_history(plastic_strain_name, of_points);
  return sum_over(volumes_.size(), [&](std::size_t p) { return volumes_[p] * of_points[p]; });
}

std::vector<std::string> GivingWay::slides_along(double t, ConstVec u) const {
  if (!has_friction_) return {};
  std::vector<std::string> along = sliding_walls(t);
  std::ranges::move(sliding_contacts(t, u), std::back_inserter(along));
  return along;
}

std::vector<std::string> GivingWay::sliding_walls(double t) const {
  constexpr double sliding_share = 0.95;  // of the largest |T|, as a node here and there may stick for a moment
  std::vector<std::string> sliding;
  if (std::ranges::none_of(shear_of_walls_, &ShearLimit::ends)) return sliding;
  const std::vector<WallReaction> walls = phase_.supports().wall_reactions(t);
  for (std::size_t k = 0; k < std::min(walls.size(), shear_of_walls_.size()); ++k) {
    const double T = std::hypot(walls[k].shear[0], walls[k].shear[1]), N = std::abs(walls[k].normal);
    if (shear_of_walls_[k].ends() && N > 0 && T >= sliding_share * shear_of_walls_[k].at(N))
      sliding.push_back("wall " + in_quotes(walls[k].name));
  }
  return sliding;
}

std::vector<std::string> GivingWay::sliding_contacts(double t, ConstVec u) const {
  constexpr double sliding_share = 0.95;  // of the area
  std::vector<std::string> sliding;
  if (std::ranges::none_of(shear_of_contacts_, &ShearLimit::ends)) return sliding;
  const std::vector<ContactReport> reports = phase_.supports().contacts(t, u);
  for (std::size_t k = 0; k < std::min(reports.size(), contacts_.size()); ++k)
    if (shear_of_contacts_[k].ends() && reports[k].slipping >= sliding_share) sliding.push_back(contacts_[k]);
  return sliding;
}

}  // namespace stillpoint
