// Supports at which the basis interpolates: unknowns prescribed at a node, or along a face of the grid or a part of it,
// u_s = u_s(t). The other supports hold by springs, see weak_supports.hpp.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/support_kind.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/boundary_condition.hpp"
#include "space/boundary/touched_functions.hpp"

namespace stillpoint {

template <int Dim>
class Supports final : public BoundaryCondition<Dim> {
  using typename BoundaryCondition<Dim>::Functions;
  using typename BoundaryCondition<Dim>::Parts;

 public:
  Supports(const Problem& problem, double time_scale) : problem_(problem), rest_(Expression(0.0), time_scale) {
    for (const SupportSpec& support : problem.supports) motions_.emplace_back(support.motion, time_scale, support.at);
    touched_.resize(motions_.size());
  }

  void hold(const Functions& functions, const std::vector<char>& reached, const FaceGaps<Dim>& gaps,
            HeldUnknowns& held) override {
    for (std::size_t s = 0; s < motions_.size(); ++s) {
      if (holds_by_springs(problem_.grid, problem_.supports[s])) continue;
      if (problem_.supports[s].face) {
        hold_face(s, functions, reached, gaps, held);
      } else {
        hold_position(s, functions, reached, held);
      }
    }
  }
  void begin_phase(const Parts& phase, Vec /*F*/) override {
    waiting_.clear();
    for (std::size_t s = 0; s < touched_.size(); ++s) {
      if (!problem_.supports[s].face) continue;
      const int axis = axis_of(*problem_.supports[s].face);
      for (const auto& [function, gap] : touched_[s].waiting()) {
        const int dof = phase.dofs.number[static_cast<std::size_t>(Dim * function + axis)];
        if (phase.dofs.is_free(dof)) waiting_.push_back({static_cast<std::size_t>(dof), outward(s), gap});
      }
    }
  }
  std::string_view kind() const override { return "supports"; }
  bool varies() const override { return false; }
  // Material that reaches the face is held from then on, which needs a new phase.
  bool asks_for_next_phase(ConstVec u) const override {
    return std::ranges::any_of(waiting_, [u](const Waiting& one) { return one.outward * u[one.dof] >= one.gap; });
  }
  void renumber(const std::vector<int>& now_of, int functions) override {
    for (TouchedFunctions& touched : touched_)
      if (touched.has_begun()) touched.renumber(now_of, functions);
  }
  void archive(const StateArchive& state) override {
    for (std::size_t s = 0; s < touched_.size(); ++s) {
      const std::string name = fmt::format("support_{}", problem_.supports[s].number);
      if (problem_.phase.at_stages && state.restores() && !state.has_part(name)) continue;  // it begins with this stage
      touched_[s].archive(state.part(name));
    }
  }

 private:
  struct Waiting {
    std::size_t dof;
    double outward, gap;  // [m]
  };

  double outward(std::size_t s) const { return is_upper(*problem_.supports[s].face) ? 1 : -1; }

  void hold_position(std::size_t s, const Functions& functions, const std::vector<char>& reached,
                     HeldUnknowns& held) const {
    const std::string key = fmt::format("support[{}].at", s);
    const SupportSpec& support = problem_.supports[s];
    Point<Dim> at;
    std::copy_n(support.at.begin(), Dim, at.begin());
    const auto first = functions.interpolating(at);
    if (!first) {
      throw_scene_error(key, "the basis has no value of its own here; expected a stiffness, by which a spring holds");
    }
    bool holds = false;
    for (int field = 0; field < functions.fields(); ++field) {
      const int function = *first + field * functions.count_of_field(), unknown = Dim * function + support.component;
      if (!reached[static_cast<std::size_t>(function)]) continue;
      if (held.is_prescribed(unknown)) throw_scene_error(key, "this place is supported already");
      held.prescribe(unknown, motions_[s], s);
      holds = true;
    }
    if (!holds) throw_scene_error(key, "no material reaches this support");
  }

  // Holds every function that does not vanish on the face and whose material lies on it, and for a part of a face those
  // whose nodes are in the part: values move with the support, slopes along it stay.
  void hold_face(std::size_t s, const Functions& functions, const std::vector<char>& reached, const FaceGaps<Dim>& gaps,
                 HeldUnknowns& held) {
    const SupportSpec& support = problem_.supports[s];
    const int axis = axis_of(*support.face);
    const std::vector<int> values = functions.values_on_face(axis, is_upper(*support.face));
    std::vector<int> on_face = functions.on_face(axis, is_upper(*support.face));
    std::erase_if(on_face, [&](int function) {
      return !reached[static_cast<std::size_t>(function)] || !is_in_part(support, functions, function);
    });
    const bool is_first = held.start() == 0 || !touched_[s].has_begun();
    const int count = functions.count();
    const std::vector<int> touched = is_first ? touched_[s].first(*support.face, on_face, gaps, count)
                                              : touched_[s].next(*support.face, on_face, gaps, count);
    if (is_first && touched.empty() && !on_face.empty()) {
      throw_scene_error(fmt::format("support[{}].face", s),
                        gap_message("the nearest material", touched_[s].least(), gaps.cell_at(*support.face)) +
                            ", and a support holds what lies on it; expected a body that reaches the face, or a grid "
                            "that begins where the body does");
    }
    for (const int function : touched) {
      for (int component = 0; component < Dim; ++component) {
        const int unknown = Dim * function + component;
        const bool named = component == support.component;
        if ((!named && support.holds_one_component()) || held.is_prescribed(unknown)) continue;
        const bool moves = named && std::ranges::binary_search(values, function);
        const double from = component == axis ? outward(s) * touched_[s].gap_of_come(function) : 0;
        held.prescribe(unknown, moves ? motion_at(s, functions, function) : rest_, s, from);
      }
    }
  }

  // The motion of a function: of a formula in the position it is the function's coefficient, which is the value at its
  // node where the basis interpolates.
  const PrescribedMotion& motion_at(std::size_t s, const Functions& functions, int function) {
    if (!motions_[s].varies_in_space()) return motions_[s];
    const PrescribedMotion& motion =
        of_functions_.insert_or_assign({s, function}, motions_[s].summed_over(coefficient_of(functions, function)))
            .first->second;
    check_motion(s, motion);
    return motion;
  }

  // Σ_k weight_k f(X_k): the products of the axes' positions and weights.
  static std::vector<WeightedPlace> coefficient_of(const Functions& functions, int function) {
    std::vector<WeightedPlace> places{{{}, 1.0}};
    for (int d = 0; d < Dim; ++d) {
      const WeightedPositions along = functions.coefficient_along(function, d);
      std::vector<WeightedPlace> further;
      for (const WeightedPlace& place : places) {
        for (std::size_t k = 0; k < along.x.size(); ++k) {
          further.push_back({place.X, place.weight * along.weight[k]});
          further.back().X.push_back(along.x[k]);
        }
      }
      places = std::move(further);
    }
    return places;
  }

  bool is_in_part(const SupportSpec& support, const Functions& functions, int function) const {
    if (Dim == 1 || !support.on_part()) return true;
    constexpr double rounding = 1e-9;  // share of a cell
    return std::ranges::all_of(held_part(problem_.grid, support), [&](const FaceInterval& part) {
      const auto along = part.along;
      const double x = functions.centre(function, static_cast<int>(along));
      const double slack = rounding * cell_length_at(problem_.grid, along, x);
      return x >= part.from - slack && x <= part.to + slack;
    });
  }

  const Problem& problem_;
  PrescribedMotion rest_;
  std::vector<PrescribedMotion> motions_;  // motion of each support
  std::vector<TouchedFunctions> touched_;  // the held functions of each support on a face
  std::vector<Waiting> waiting_;           // normal unknowns whose material has not reached the face yet
  std::map<std::pair<std::size_t, int>, PrescribedMotion> of_functions_;  // that vary in space, by support and function
};

}  // namespace stillpoint
