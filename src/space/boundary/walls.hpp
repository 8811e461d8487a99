// The rigid walls of a scene along faces of the grid.
#pragma once

#include <stillpoint/scene.hpp>

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "space/boundary/boundary_condition.hpp"
#include "space/boundary/wall_contact.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class Walls final : public BoundaryCondition<B, K>, private Contact {
  static constexpr int dim = dimensions(K);
  using Basis = TensorBasis<B, dim>;
  using typename BoundaryCondition<B, K>::GridOf;
  using typename BoundaryCondition<B, K>::Parts;

 public:
  Walls(const Scene& scene, double time_scale) {
    for (const WallSpec& wall : scene.walls) {
      walls_.push_back({wall.face, {}, {wall.name, is_upper(wall.face), wall.friction, {wall.motion, time_scale}}});
    }
  }

  void hold(const GridOf& grid, const std::vector<char>&, HeldUnknowns& held) override {
    for (Wall& wall : walls_) {
      wall.functions = Basis::face_values(grid, axis_of(wall.face), is_upper(wall.face));
      for (const int function : wall.functions) held.guide(dim * function + axis_of(wall.face));
    }
  }
  // Where another wall crosses, that one alone acts along it.
  void begin_motion(const Parts& phase, double t, Vec v) override {
    const auto free_dof = [&](int unknown) {
      const int dof = phase.dofs.number[static_cast<std::size_t>(unknown)];
      return phase.dofs.is_free(dof) ? dof : -1;
    };
    for (Wall& wall : walls_) {
      const int normal = axis_of(wall.face);
      std::vector<WallContact::Node> nodes;
      for (const int function : wall.functions) {
        WallContact::Node node{.normal = free_dof(dim * function + normal)};
        for (int axis = 0, k = 0; axis < dim; ++axis) {
          if (axis == normal) continue;
          const int along = dim * function + axis;
          node.along[static_cast<std::size_t>(k++)] = phase.held.is_guided(along) ? -1 : free_dof(along);
        }
        nodes.push_back(node);
      }
      wall.contact.begin_phase(t, phase.mass.diagonal(), std::move(nodes), v);
    }
  }
  bool varies() const override { return false; }

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
  bool update(double t, ConstVec u, Vec v) override {
    bool changed = false;
    for (Wall& wall : walls_) changed = wall.contact.update(t, u, v) || changed;
    return changed;
  }
  double squared_forces(double sum) const override {
    for (const Wall& wall : walls_) sum += wall.contact.square_of_forces();
    return sum;
  }

  struct Wall {
    Face face;
    std::vector<int> functions;  // value functions on the face of the present grid
    WallContact contact;
  };
  std::vector<Wall> walls_;
};

}  // namespace stillpoint
