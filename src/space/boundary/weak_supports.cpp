#include "space/boundary/weak_supports.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "scene/body_depth.hpp"
#include "scene/support_kind.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/face_pieces.hpp"

namespace stillpoint {

template <Kinematics K>
WeakSupports<K>::WeakSupports(const Problem& problem, const GridOf& grid, double time_scale) : problem_(problem) {
  motions_.reserve(problem.supports.size() + 1);
  motions_.emplace_back(Expression(0.0), time_scale);
  for (const SupportSpec& support : problem.supports) motions_.emplace_back(support.motion, time_scale, support.at);
  for (std::size_t s = 0; s < problem.supports.size(); ++s) {
    if (!holds_by_springs(problem.grid, problem.supports[s])) continue;
    if (problem.supports[s].face) {
      cut_face(s, grid);
    } else {
      Point<dim> x;
      std::copy_n(problem.supports[s].at.begin(), dim, x.begin());
      add(s, problem.supports[s].component, x, 1, 1);
    }
  }
}

template <Kinematics K>
auto WeakSupports<K>::place(std::size_t s, const double* u) const -> Point<dim> {
  CarriedPoint<dim> at = held_[s].at;
  at.move(u);
  return at.x;
}

template <Kinematics K>
void WeakSupports<K>::begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound) {
  if (!has_begun_) drop_what_lies_outside(phase);
  if (empty()) return;
  if (problem_.phase.ends()) {
    freeze_carried(
        held_, [](Held & held) -> auto& { return held.at; }, !has_begun_, phase);
  }
  if (!has_begun_) choose_stiffness(phase, stiffness_bound());
  growth_ = 1;
  springs_.clear();
  for (Held& held : held_) {
    const std::vector<Springs::Weight> weights = weights_of(held, phase.dofs);
    const double frequency = square_of_frequency(held.stiffness, weights, phase);
    if (!has_begun_) held.frequency = frequency;
    if (held.frequency > 0) growth_ = std::max(growth_, frequency / held.frequency);
    springs_.add(held.stiffness, held.moved, motion_of(held), weights);
  }
  has_begun_ = true;
}

template <Kinematics K>
void WeakSupports<K>::end_phase(const double* u, bool in_place) {
  for (std::size_t s = 0; s < held_.size(); ++s) {
    held_[s].moved += springs_.displacement(s, u);
    if (!in_place) held_[s].at.move(u);
  }
}

template <Kinematics K>
void WeakSupports<K>::archive(const StateArchive& state) {
  if (empty()) return;
  state.each(
      "positions", held_, [](Held & held) -> auto& { return held.at.x; });
  std::vector<double> moved;
  for (const Held& held : held_) moved.push_back(held.moved);
  state("moved", Vec(moved));
  for (std::size_t s = 0; s < held_.size(); ++s) held_[s].moved = moved[s];
}

template <Kinematics K>
std::vector<WeakSupport> WeakSupports<K>::report(double t, const double* u) const {
  std::vector<WeakSupport> all;
  for (std::size_t s = 0; s < held_.size(); ++s) {
    if (all.empty() || all.back().support != owner(s))
      all.push_back({.support = owner(s), .stiffness = held_[s].stiffness / held_[s].area});
    WeakSupport& support = all.back();
    ++support.springs;
    support.gap = std::max(support.gap, std::abs(springs_.gap(s, t, u)));
  }
  return all;
}

template <Kinematics K>
void WeakSupports<K>::add(std::size_t support, int component, const Point<dim>& x, double area, double share) {
  CarriedPoint<dim> at{};
  at.x = x;
  Held& held =
      held_.emplace_back(Held{.support = support, .component = component, .at = at, .area = area, .share = share});
  const PrescribedMotion& motion = motion_of(held);
  if (!motion.varies_in_space() || !problem_.supports[support].face) return;
  held.motion = std::make_shared<const PrescribedMotion>(motion.at({x.begin(), x.end()}));
  check_motion(support, *held.motion);
}

// Cuts the part of the face on which bodies lie into pieces, several in each cell.
template <Kinematics K>
void WeakSupports<K>::cut_face([[maybe_unused]] std::size_t s, [[maybe_unused]] const GridOf& grid) {
  if constexpr (dim > 1) {
    const SupportSpec& support = problem_.supports[s];
    const auto normal = static_cast<std::size_t>(axis_of(*support.face));
    const Axis& across = grid.axes[normal];
    const double face = is_upper(*support.face) ? across.max() : across.min();
    for (const BodySpec& body : problem_.bodies) {
      const BodyDepth shape(body);
      const double inwards = touching * cell_width(grid, *support.face) * (is_upper(*support.face) ? -1 : 1);
      std::vector<FaceInterval> part = held_part(problem_.grid, support);
      for (FaceInterval& interval : part) {
        interval.from = std::max(interval.from, body.min[interval.along]);
        interval.to = std::min(interval.to, body.max[interval.along]);
      }
      const auto rule = [&](std::size_t along) {
        return face_rule(body, along, problem_.phase.ends(), problem_.phase.quadrature == Quadrature::domains);
      };
      for_face_pieces<dim>(grid, normal, face, part, rule, [&](const Point<dim>& x, double size, double share) {
        Point<dim> inside = x;
        inside[normal] += inwards;
        if (shape.is_known() && !shape.contains(inside)) return;  // nothing is held across a gap
        const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * x[0] : body.area;
        for (int i = 0; i < dim; ++i) {
          if (i == support.component || !support.holds_one_component()) add(s, i, x, size * depth, share);
        }
      });
    }
  }
}

template <Kinematics K>
const PrescribedMotion& WeakSupports<K>::motion_of(const Held& held) const {
  if (held.motion) return *held.motion;
  const bool moves = held.component == problem_.supports[held.support].component;
  return motions_[moves ? held.support + 1 : 0];
}

// Drops pieces of a face that the material does not reach, or whose functions are held by other supports; for a
// position either is an error.
template <Kinematics K>
void WeakSupports<K>::drop_what_lies_outside(const Parts& phase) {
  constexpr double rounding = 1e-12;
  enum { held, no_material, supported };
  const auto state_of = [&](Held& one) {
    one.at.freeze(cell_with_functions_at<dim>(phase.functions, one.at.x), phase);
    bool is_free = false;
    for (const auto& a : one.at.entries) {
      if (std::abs(a.w) <= rounding) continue;
      if (a.function < 0) return no_material;
      phase.dofs.for_sources(dim * a.function + one.component,
                             [&](int, int dof, double) { is_free = is_free || phase.dofs.is_free(dof); });
    }
    return is_free ? held : supported;
  };
  std::vector<int> pieces(problem_.supports.size(), 0), states(problem_.supports.size(), held);
  std::erase_if(held_, [&](Held& one) {
    const auto state = state_of(one);
    states[one.support] = std::max<int>(states[one.support], state);
    pieces[one.support] += state == held ? 1 : 0;
    return state != held;
  });
  for (std::size_t s = 0; s < problem_.supports.size(); ++s) {
    if (pieces[s] > 0 || !holds_by_springs(problem_.grid, problem_.supports[s])) continue;
    throw_scene_error(fmt::format("support[{}].{}", s, problem_.supports[s].face ? "face" : "at"),
                      states[s] == supported ? "this place is supported already" : "no material reaches this support");
  }
}

template <Kinematics K>
void WeakSupports<K>::choose_stiffness(const Parts& phase, const std::vector<double>& G) {
  struct Sum {
    double stiffness = 0, area = 0;
  };
  std::vector<Sum> of_support(problem_.supports.size());
  for (const Held& held : held_) {
    StiffnessAt at;
    for (const auto& [unknown, dof, w] : weights_of(held, phase.dofs))
      if (phase.dofs.is_free(dof)) at.add(w, G[static_cast<std::size_t>(unknown / dim)]);
    Sum& sum = of_support[held.support];
    sum.area += held.area;
    sum.stiffness += held.share * beta * (problem_.supports[held.support].face ? at.ww : 1) / at.compliance;
  }
  for (Held& held : held_) {
    const Sum& sum = of_support[held.support];
    held.stiffness = held.area * problem_.supports[held.support].stiffness.value_or(sum.stiffness / sum.area);
  }
}

template <Kinematics K>
std::vector<Springs::Weight> WeakSupports<K>::weights_of(const Held& held, const DegreesOfFreedom& dofs) {
  std::vector<Springs::Weight> weights;
  for (const auto& a : held.at.entries) {
    if (a.function < 0 || a.w == 0) continue;
    dofs.for_sources(dim * a.function + held.component, [&](int unknown, int dof, double share) {
      const double w = a.w * share;
      const auto known = std::ranges::find(weights, dof, &Springs::Weight::dof);
      if (known == weights.end()) {
        weights.push_back({unknown, dof, w});
      } else {
        known->w += w;
      }
    });
  }
  return weights;
}

template <Kinematics K>
double WeakSupports<K>::square_of_frequency(double k, const std::vector<Springs::Weight>& weights, const Parts& phase) {
  if (!phase.mass.is_lumped()) return 0;
  double sum = 0;
  for (const Springs::Weight& weight : weights) {
    if (!phase.dofs.is_free(weight.dof)) continue;
    sum += weight.w * weight.w / phase.mass.diagonal()[static_cast<std::size_t>(weight.dof)];
  }
  return k * sum;
}

template class WeakSupports<Kinematics::line>;
template class WeakSupports<Kinematics::plane>;
template class WeakSupports<Kinematics::axisymmetric>;
template class WeakSupports<Kinematics::space>;

}  // namespace stillpoint
