// The rigid walls of a scene along faces of the grid.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"
#include "space/boundary/boundary_condition.hpp"
#include "space/boundary/carried_point.hpp"
#include "space/boundary/touched_functions.hpp"
#include "space/boundary/wall_contact.hpp"

namespace stillpoint {

template <int Dim>
class Walls final : public BoundaryCondition<Dim>, private Contact {
  using typename BoundaryCondition<Dim>::Functions;
  using typename BoundaryCondition<Dim>::Parts;

 public:
  /// The problem must outlive this object.
  Walls(const Problem& problem, double time_scale) : problem_(problem) {
    for (const WallSpec& wall : problem.walls) {
      walls_.push_back(
          {wall.face, {}, {}, {wall.name, is_upper(wall.face), wall.friction, WallMotion({wall.motion, time_scale})}});
    }
  }

  void hold(const Functions& functions, const std::vector<char>& reached, const FaceGaps<Dim>& gaps,
            HeldUnknowns& held) override {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      Wall& wall = walls_[w];
      const std::vector<int> before =
          std::exchange(wall.functions, functions.values_on_face(axis_of(wall.face), is_upper(wall.face)));
      if (std::exchange(wall.has_other_numbers, false)) wall.contact.take_nodes(places_in(before, wall.functions));
      for (const int function : wall.functions) held.guide(Dim * function + axis_of(wall.face));
      if (!problem_.phase.ends()) check_gaps(w, gaps);
      take_gaps(wall, reached, gaps);
    }
  }
  void renumber(const std::vector<int>& now_of, int /*functions*/) override {
    for (Wall& wall : walls_) {
      for (int& function : wall.functions) function = now_of[static_cast<std::size_t>(function)];
      wall.has_other_numbers = true;
    }
  }
  // Where another wall crosses, only that wall acts along its normal.
  void begin_motion(const Parts& phase, double t, Vec v) override {
    const auto free_dof = [&](int unknown) {
      const int dof = phase.dofs.number[static_cast<std::size_t>(unknown)];
      return phase.dofs.is_free(dof) ? dof : -1;
    };
    for (Wall& wall : walls_) {
      const int normal = axis_of(wall.face);
      std::vector<WallContact::Node> nodes;
      for (const int function : wall.functions) {
        WallContact::Node node{.normal = free_dof(Dim * function + normal), .gap = wall.gaps[nodes.size()]};
        for (int axis = 0, k = 0; axis < Dim; ++axis) {
          if (axis == normal) continue;
          const int along = Dim * function + axis;
          node.along[static_cast<std::size_t>(k++)] = phase.held.is_guided(along) ? -1 : free_dof(along);
        }
        nodes.push_back(node);
      }
      wall.contact.begin_phase({.t = t,
                                .face_at = moved(wall.face, phase.grid),
                                .cell = cell_width(phase.grid, wall.face),
                                .most = furthest_in_step(cell_width(phase.grid, wall.face)),
                                .remembers = phase.remembers},
                               phase.mass.diagonal(), std::move(nodes), v);
    }
  }
  std::string_view kind() const override { return "walls"; }
  bool varies() const override { return false; }
  bool asks_for_next_phase(ConstVec /*u*/) const override {
    return std::ranges::any_of(walls_, [](const Wall& wall) { return wall.contact.asks_for_next_phase(); });
  }

  void archive(const StateArchive& state) override {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      walls_[w].contact.archive(state.part(fmt::format("wall_{}", w)));
    }
  }

  Contact* contact() override { return this; }
  void report(double t, std::vector<WallReaction>& to) const override {
    for (const Wall& wall : walls_) {
      to.push_back(wall.contact.reaction(t));
      to.back().axis = axis_of(wall.face);
    }
  }

 private:
  void add_force(double t, const LinearDamping& C, Vec Q) const override {
    for (const Wall& wall : walls_) wall.contact.add_force(t, C, Q);
  }
  void hold(Vec Q) const override {
    for (const Wall& wall : walls_) wall.contact.hold(Q);
  }
  ContactChange update(double t, Vec u, Vec v) override {
    ContactChange change = ContactChange::nothing;
    for (Wall& wall : walls_) change = std::max(change, wall.contact.update(t, u, v));
    return change;
  }
  bool is_settled() const override {
    return std::ranges::all_of(walls_, [](const Wall& wall) { return wall.contact.is_settled(); });
  }
  double squared_forces(double sum) const override {
    for (const Wall& wall : walls_) sum += wall.contact.square_of_forces();
    return sum;
  }

  struct Wall {
    Face face;
    std::vector<int> functions;  // value functions on the face of the present grid
    std::vector<double> gaps;    // gap of each function when the phase begins [m]
    WallContact contact;
    bool has_other_numbers = false;  // whether `functions` are those of the last phase by their new numbers
  };

  // The place of each number among those of `before`, ascending but for −1; WallContact::is_new: it is not there.
  static std::vector<std::size_t> places_in(const std::vector<int>& before, const std::vector<int>& numbers) {
    std::vector<std::size_t> places;
    for (const int number : numbers) {
      const auto found = std::ranges::find(before, number);
      places.push_back(found == before.end() ? WallContact::is_new : static_cast<std::size_t>(found - before.begin()));
    }
    return places;
  }

  // In a single phase functions keep their gaps: material that does not lie on a wall when the run begins would touch
  // it through a layer without material, or not at all.
  void check_gaps(std::size_t w, const FaceGaps<Dim>& gaps) const {
    const Face face = walls_[w].face;
    const double cell = gaps.cell_at(face), nearest = gaps.least_of_bodies(face);
    const auto refuse = [&](const std::string& what, double gap) {
      throw_scene_error(fmt::format("wall[{}].face", w),
                        gap_message(what, gap, cell) +
                            ", and in a single phase only what lies on a wall from the start can touch it; expected a "
                            "body on the wall, a grid that ends where the body does, or phase.max_motion");
    };
    if (nearest > touching * cell) refuse("the nearest body", nearest);
    for (std::size_t body = 0; body < problem_.bodies.size(); ++body) {
      const double gap = gaps.of_body(body, face);
      if (gap > touching * cell && gap < (1 - touching) * cell) refuse(fmt::format("body[{}]", body), gap);
    }
  }
  // Finds the gaps of the functions, but for those that are closed in contact with their material.
  static void take_gaps(Wall& wall, const std::vector<char>& reached, const FaceGaps<Dim>& gaps) {
    wall.gaps.assign(wall.functions.size(), 0);
    std::vector<int> asked;
    std::vector<std::size_t> place;
    for (std::size_t k = 0; k < wall.functions.size(); ++k) {
      if (wall.contact.stays(k) || !reached[static_cast<std::size_t>(wall.functions[k])]) continue;
      asked.push_back(wall.functions[k]);
      place.push_back(k);
    }
    if (asked.empty()) return;
    const std::vector<double> found = gaps.of(wall.face, asked);
    for (std::size_t k = 0; k < place.size(); ++k) wall.gaps[place[k]] = found[k];
  }
  // The largest displacement of a wall within a step [m]: limited only on the way to an equilibrium; otherwise the
  // motion itself is asked for.
  double furthest_in_step(double cell) const {
    constexpr double share = 0.02;
    return problem_.phase.ends() && problem_.stop.wants_equilibrium() ? share * cell : WallMotion::unlimited;
  }
  // Displacement of the grid's face since the start [m].
  double moved(Face face, const Grid<Dim>& grid) const {
    const auto axis = static_cast<std::size_t>(axis_of(face));
    return is_upper(face) ? grid.axes[axis].max() - problem_.grid.max[axis]
                          : grid.axes[axis].min() - problem_.grid.min[axis];
  }

  const Problem& problem_;
  std::vector<Wall> walls_;
};

}  // namespace stillpoint
