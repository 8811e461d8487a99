// What supports with a name bear.
#include "space/boundary/conditions.hpp"

namespace stillpoint {

// The reactions R_s − F_s at the prescribed values and −k g of springs. The reaction of a prescribed slope is a moment
// and no force, and is left out.
template <Kinematics K>
std::vector<SupportReaction> Conditions<K>::support_reactions(const Parts& phase, double t, const double* u,
                                                              ConstVec reactions) const {
  std::vector<SupportReaction> named;
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place(problem_.supports.size(), none);
  for (std::size_t s = 0; s < place.size(); ++s) {
    if (problem_.supports[s].name.empty()) continue;
    place[s] = named.size();
    named.push_back({problem_.supports[s].name, {}});
  }
  const HeldUnknowns& held = phase.held;
  const std::size_t prescribed = held.prescribed().size();
  std::vector<double> F_s(prescribed, 0);
  for (const auto& condition : all_) condition->add_load_on_supports(phase, t, u, F_s);
  load_control_.add_load_on_supports(phase, t, u, F_s);
  // Adds the force f along axis i at x, and its moment x × f e_i.
  const auto bear = [&](SupportReaction& support, int i, double f, [[maybe_unused]] const auto& place_of) {
    support.force[static_cast<std::size_t>(i)] += f;
    if constexpr (dim == 3) {
      const Point<dim> x = place_of();
      const auto next = static_cast<std::size_t>((i + 1) % 3), last = static_cast<std::size_t>((i + 2) % 3);
      support.moment[next] += x[last] * f;
      support.moment[last] -= x[next] * f;
    }
  };
  for (std::size_t s = 0; s < prescribed; ++s) {
    const int function = held.prescribed()[s] / dim, i = held.prescribed()[s] % dim;
    const std::size_t support = held.owner(s), owner = support == HeldUnknowns::nobody ? none : place[support];
    if (owner == none || !phase.functions.is_value(function)) continue;
    bear(named[owner], i, reactions[s] - F_s[s], [&] {
      Point<dim> x;
      for (int d = 0; d < dim; ++d) x[d] = phase.functions.centre(function, d) + u[dim * function + d];
      return x;
    });
  }
  for (std::size_t s = 0; s < weak_supports_.springs().size(); ++s) {
    if (const std::size_t owner = place[weak_supports_.owner(s)]; owner != none)
      bear(named[owner], weak_supports_.component(s), reactions[prescribed + s],
           [&] { return weak_supports_.place(s, u); });
  }
  return named;
}

template std::vector<SupportReaction> Conditions<Kinematics::line>::support_reactions(const Parts&, double,
                                                                                      const double*, ConstVec) const;
template std::vector<SupportReaction> Conditions<Kinematics::plane>::support_reactions(const Parts&, double,
                                                                                       const double*, ConstVec) const;
template std::vector<SupportReaction> Conditions<Kinematics::axisymmetric>::support_reactions(const Parts&, double,
                                                                                              const double*,
                                                                                              ConstVec) const;
template std::vector<SupportReaction> Conditions<Kinematics::space>::support_reactions(const Parts&, double,
                                                                                       const double*, ConstVec) const;

}  // namespace stillpoint
