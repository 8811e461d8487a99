// Supports where the basis has no value of its own to prescribe, or where a scene gives a stiffness: springs hold the
// body, see springs.hpp, and go with it from phase to phase.
//
// A spring is about as stiff as the body is for the functions of its position when the run begins: with
// G_a ≥ Σ_b |K_ab| (stiffness_bound)
//
//   k = β / Σ_a (w_a²/G_a)   at a position,
//   k = κ A                  for each piece A of a face, with one κ for all, the mean of β Σ_a w_a² / Σ_a (w_a²/G_a)
//                            over the cells' shares of the face.
//
// Then k wᵀM⁻¹w ≤ β max_a G_a/M_a, whatever little mass functions have, and as no mass is in it the answer does not
// depend on how the mass is scaled. With β = 1, about 8 (λ + 2μ)/(ρ h²) (wᵀM⁻¹w)⁻¹, the critical step falls to 0.6 of
// what it would be at least, and the gap on a face is about a tenth of h/L of the displacement, L the body's length: it
// falls as h. A position in the plane gives way by a share that hardly falls, as the body itself does there: under a
// point force its displacement has no limit. The stiffness stays what it is in later phases, so that the forces go on
// from one to the next; where the functions of a later one move less inertia, growth() says so.
#pragma once

#include <stillpoint/scene.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "scene/body_depth.hpp"
#include "scene/support_kind.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/boundary_condition.hpp"
#include "space/boundary/carried_point.hpp"
#include "space/boundary/face_pieces.hpp"
#include "space/boundary/springs.hpp"
#include "space/boundary/support_report.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class WeakSupports {
  static constexpr int dim = dimensions(K);
  using GridOf = Grid<dim>;
  using Parts = PhaseParts<B, K>;

 public:
  static constexpr double beta = 1;

  /// The scene outlives it; grid: the first one; time_scale: of PrescribedMotion.
  WeakSupports(const Scene& scene, const GridOf& grid, double time_scale) : scene_(scene) {
    motions_.reserve(scene.supports.size() + 1);
    motions_.emplace_back(Expression(0.0), time_scale);
    for (const SupportSpec& support : scene.supports) motions_.emplace_back(support.motion, time_scale, support.at);
    for (std::size_t s = 0; s < scene.supports.size(); ++s) {
      if (!holds_by_springs(scene.grid, scene.supports[s])) continue;
      if (scene.supports[s].face) {
        cut_face(s, grid);
      } else {
        Point<dim> x;
        std::copy_n(scene.supports[s].at.begin(), dim, x.begin());
        add(s, scene.supports[s].component, x, 1, 1);
      }
    }
  }

  bool empty() const { return held_.empty(); }
  const Springs& springs() const { return springs_; }
  /// The support of spring s, and the component that it holds.
  std::size_t owner(std::size_t s) const { return held_[s].support; }
  int component(std::size_t s) const { return held_[s].component; }
  /// Where spring s holds the body at u, over the grid's functions [m].
  Point<dim> place(std::size_t s, const double* u) const {
    CarriedPoint<B, K> at = held_[s].at;
    at.move(u);
    return at.x;
  }
  /// The largest ratio of a spring's k wᵀM⁻¹w to that of the first phase, at least 1: omega_max² grows by no more.
  double growth() const { return growth_; }

  /// stiffness_bound(): G of the phase, (functions) [N/m]. Throws SceneError if there is nothing to hold.
  template <class StiffnessBound>
  void begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound) {
    if (!has_begun_) drop_what_lies_outside(phase);
    if (empty()) return;
    if (has_phases(scene_)) {
      freeze_carried<B, K>(
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
  /// The phase ends with u.
  void end_phase(const double* u) {
    for (std::size_t s = 0; s < held_.size(); ++s) {
      held_[s].moved += springs_.displacement(s, u);
      held_[s].at.move(u);
    }
  }
  void archive(const StateArchive& state) {
    if (empty()) return;
    state.each(
        "positions", held_, [](Held & held) -> auto& { return held.at.x; });
    std::vector<double> moved;
    for (const Held& held : held_) moved.push_back(held.moved);
    state("moved", Vec(moved));
    for (std::size_t s = 0; s < held_.size(); ++s) held_[s].moved = moved[s];
  }

  /// Each of these supports at (t, u), u over the grid's functions.
  std::vector<WeakSupport> report(double t, const double* u) const {
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

 private:
  struct Held {
    std::size_t support;  // number in the scene
    int component;
    CarriedPoint<B, K> at;
    double area;           // of a piece of a face, undeformed [m²]; 1 at a position
    double share;          // of the cell's part of the face; 1 at a position
    double stiffness = 0;  // k [N/m]
    double moved = 0;      // displacement in the phases before [m]
    double frequency = 0;  // k wᵀM⁻¹w of the first phase, if the mass is lumped [1/s²]
    std::shared_ptr<const PrescribedMotion> motion{};  // its own, of a formula of where it was before the motion
  };

  void add(std::size_t support, int component, const Point<dim>& x, double area, double share) {
    CarriedPoint<B, K> at{};
    at.x = x;
    Held& held =
        held_.emplace_back(Held{.support = support, .component = component, .at = at, .area = area, .share = share});
    const PrescribedMotion& motion = motion_of(held);
    if (!motion.varies_in_space() || !scene_.supports[support].face) return;
    held.motion = std::make_shared<const PrescribedMotion>(motion.at({x.begin(), x.end()}));
    check_motion(scene_, support, *held.motion);
  }
  // Where bodies lie on it, some pieces to a cell.
  void cut_face([[maybe_unused]] std::size_t s, [[maybe_unused]] const GridOf& grid) {
    if constexpr (dim > 1) {
      const SupportSpec& support = scene_.supports[s];
      const auto normal = static_cast<std::size_t>(axis_of(*support.face));
      const Axis& across = grid.axes[normal];
      const double face = is_upper(*support.face) ? across.max() : across.min();
      for (const BodySpec& body : scene_.bodies) {
        const BodyDepth shape(body);
        const double inwards = touching * cell_width(grid, *support.face) * (is_upper(*support.face) ? -1 : 1);
        std::vector<FaceInterval> part = held_part(scene_.grid, support);
        for (FaceInterval& interval : part) {
          interval.from = std::max(interval.from, body.min[interval.along]);
          interval.to = std::min(interval.to, body.max[interval.along]);
        }
        const auto rule = [&](std::size_t along) {
          return face_rule(body, along, has_phases(scene_), scene_.phase.quadrature == Quadrature::domains);
        };
        for_face_pieces<dim>(grid, normal, face, part, rule, [&](const Point<dim>& x, double size, double share) {
          Point<dim> inside = x;
          inside[normal] += inwards;
          if (shape.is_known() && !shape.contains(inside)) return;  // nothing is held across a gap
          const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * x[0] : body.area;
          for (int i = 0; i < dim; ++i) {
            if (i == support.component || !support.roller) add(s, i, x, size * depth, share);
          }
        });
      }
    }
  }
  const PrescribedMotion& motion_of(const Held& held) const {
    if (held.motion) return *held.motion;
    const bool moves = held.component == scene_.supports[held.support].component;
    return motions_[moves ? held.support + 1 : 0];
  }

  // Pieces of a face that the material does not reach, or whose functions other supports hold; a position that has
  // neither is an error.
  void drop_what_lies_outside(const Parts& phase) {
    constexpr double rounding = 1e-12;
    enum { held, no_material, supported };
    const auto state_of = [&](Held& one) {
      one.at.freeze(cell_with_functions_at<B, dim>(phase.grid, one.at.x), phase);
      bool is_free = false;
      for (int a = 0; a < one.at.entries; ++a) {
        if (std::abs(one.at.w[a]) <= rounding) continue;
        if (one.at.function[a] < 0) return no_material;
        phase.dofs.for_sources(dim * one.at.function[a] + one.component,
                               [&](int, int dof, double) { is_free = is_free || phase.dofs.is_free(dof); });
      }
      return is_free ? held : supported;
    };
    std::vector<int> pieces(scene_.supports.size(), 0), states(scene_.supports.size(), held);
    std::erase_if(held_, [&](Held& one) {
      const auto state = state_of(one);
      states[one.support] = std::max<int>(states[one.support], state);
      pieces[one.support] += state == held ? 1 : 0;
      return state != held;
    });
    for (std::size_t s = 0; s < scene_.supports.size(); ++s) {
      if (pieces[s] > 0 || !holds_by_springs(scene_.grid, scene_.supports[s])) continue;
      throw_scene_error(
          scene_, fmt::format("support[{}].{}", s, scene_.supports[s].face ? "face" : "at"),
          states[s] == supported ? "this place is supported already" : "no material reaches this support");
    }
  }

  void choose_stiffness(const Parts& phase, const std::vector<double>& G) {
    struct Sum {
      double stiffness = 0, area = 0;
    };
    std::vector<Sum> of_support(scene_.supports.size());
    for (const Held& held : held_) {
      double ww = 0, compliance = 0;  // Σ w_a², Σ w_a²/G_a
      for (const auto& [unknown, dof, w] : weights_of(held, phase.dofs)) {
        if (!phase.dofs.is_free(dof)) continue;
        ww += w * w;
        compliance += w * w / G[static_cast<std::size_t>(unknown / dim)];
      }
      Sum& sum = of_support[held.support];
      sum.area += held.area;
      sum.stiffness += held.share * beta * (scene_.supports[held.support].face ? ww : 1) / compliance;
    }
    for (Held& held : held_) {
      const Sum& sum = of_support[held.support];
      held.stiffness = held.area * scene_.supports[held.support].stiffness.value_or(sum.stiffness / sum.area);
    }
  }

  static std::vector<Springs::Weight> weights_of(const Held& held, const DegreesOfFreedom& dofs) {
    std::vector<Springs::Weight> weights;
    for (int a = 0; a < held.at.entries; ++a) {
      if (held.at.function[a] < 0 || held.at.w[a] == 0) continue;
      dofs.for_sources(dim * held.at.function[a] + held.component, [&](int unknown, int dof, double share) {
        const double w = held.at.w[a] * share;
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
  static double square_of_frequency(double k, const std::vector<Springs::Weight>& weights, const Parts& phase) {
    if (!phase.mass.is_lumped()) return 0;
    double sum = 0;
    for (const Springs::Weight& weight : weights) {
      if (!phase.dofs.is_free(weight.dof)) continue;
      sum += weight.w * weight.w / phase.mass.diagonal()[static_cast<std::size_t>(weight.dof)];
    }
    return k * sum;
  }

  const Scene& scene_;
  std::vector<PrescribedMotion> motions_;  // at rest, and of each support
  std::vector<Held> held_;                 // of one support after the other
  Springs springs_;                        // of the present phase, likewise
  double growth_ = 1;
  bool has_begun_ = false;  // the first phase
};

}  // namespace stillpoint
