// What holds the body: supports, which prescribe unknowns, and walls, which push.
#pragma once

#include <stillpoint/scene.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"
#include "space/boundary/prescribed_motion.hpp"
#include "space/boundary/wall_contact.hpp"
#include "space/grid/basis.hpp"
#include "space/grid/degrees_of_freedom.hpp"

namespace stillpoint {

class Boundary {
 public:
  /// time_scale: of PrescribedMotion.
  Boundary(const Scene& scene, double time_scale) : rest_(Expression(0.0), time_scale) {
    for (const auto& support : scene.supports) motions_.emplace_back(support.motion, time_scale);
    for (const auto& wall : scene.walls) {
      walls_.emplace_back(wall.name, is_upper(wall.face), wall.friction, PrescribedMotion(wall.motion, time_scale));
      faces_.push_back(wall.face);
    }
  }

  /// Finds what the supports prescribe on this grid. reached: whether material reaches a function, (functions).
  template <class Basis, int Dim>
  void begin_phase(const Scene& scene, const Grid<Dim>& grid, const std::vector<char>& reached, double t) {
    start_ = t;
    prescribed_.clear();
    of_prescribed_.clear();
    for (std::size_t s = 0; s < scene.supports.size(); ++s) {
      if (scene.supports[s].face) {
        hold_face<Basis>(scene.supports[s], s, grid, reached);
      } else {
        hold_place<Basis>(scene, s, grid, reached);
      }
    }
    wall_functions_.clear();
    for (const Face face : faces_) {
      wall_functions_.push_back(Basis::face_values(grid, axis_of(face), is_upper(face)));
    }
    dim_ = Dim;
  }
  /// Lets the walls take hold of what touches them; v: (n).
  void begin_contact(double t, const DegreesOfFreedom& dofs, Vec v) {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const int normal = axis_of(faces_[w]);
      std::vector<WallContact::Node> nodes;
      for (const int function : wall_functions_[w]) {
        const auto free_dof = [&](int component) {
          const int dof = dofs.number[static_cast<std::size_t>(dim_ * function + component)];
          return dofs.is_free(dof) ? dof : -1;
        };
        const int tangential = dim_ == 1 || crossed_by_another_wall(function, w) ? -1 : free_dof(1 - normal);
        nodes.push_back({free_dof(normal), tangential});
      }
      walls_[w].begin_phase(t, std::move(nodes), v);
    }
  }

  /// Grid numbers of the prescribed unknowns, and how each moves.
  const std::vector<int>& prescribed() const { return prescribed_; }
  const PrescribedMotion& motion_of(std::size_t s) const {
    return of_prescribed_[s] < motions_.size() ? motions_[of_prescribed_[s]] : rest_;
  }
  double displacement_in_phase(std::size_t s, double t) const {
    const PrescribedMotion& motion = motion_of(s);
    return motion.displacement(t) - (start_ > 0 ? motion.displacement(start_) : 0);
  }

  std::vector<WallContact>& walls() { return walls_; }
  const std::vector<WallContact>& walls() const { return walls_; }
  /// Of a wall by name at t; 0 where there is none.
  double displacement_of(const std::string& name, double t) const {
    const auto wall = std::ranges::find(walls_, name, &WallContact::name);
    return wall == walls_.end() ? 0 : wall->motion().displacement(t);
  }

 private:
  static constexpr std::size_t at_rest = static_cast<std::size_t>(-1);

  bool is_prescribed(int unknown) const { return std::ranges::find(prescribed_, unknown) != prescribed_.end(); }
  bool crossed_by_another_wall(int function, std::size_t wall) const {
    for (std::size_t other = 0; other < walls_.size(); ++other) {
      if (other == wall || axis_of(faces_[other]) == axis_of(faces_[wall])) continue;
      if (std::ranges::binary_search(wall_functions_[other], function)) return true;
    }
    return false;
  }

  template <class Basis, int Dim>
  void hold_place(const Scene& scene, std::size_t s, const Grid<Dim>& grid, const std::vector<char>& reached) {
    const std::string key = fmt::format("support[{}].at", s);
    Point<Dim> at;
    std::copy_n(scene.supports[s].at.begin(), Dim, at.begin());
    const auto function = Basis::interpolating_function(grid, at);
    if (!function) {
      throw_scene_error(
          scene, key,
          "a support must lie where the basis has a value of its own: at a node of a linear or hermite grid, at "
          "an end of a quadratic or cubic one");
    }
    const int unknown = Dim * *function + scene.supports[s].component;
    if (!reached[static_cast<std::size_t>(*function)])
      throw_scene_error(scene, key, "no material reaches this support");
    if (is_prescribed(unknown)) throw_scene_error(scene, key, "this place is supported already");
    prescribed_.push_back(unknown);
    of_prescribed_.push_back(s);
  }

  // Every function that is not zero on the face: values move with the support, slopes along it stay.
  template <class Basis, int Dim>
  void hold_face(const SupportSpec& support, std::size_t s, const Grid<Dim>& grid, const std::vector<char>& reached) {
    const int axis = axis_of(*support.face);
    const std::vector<int> values = Basis::face_values(grid, axis, is_upper(*support.face));
    for (const int function : Basis::face_functions(grid, axis, is_upper(*support.face))) {
      if (!reached[static_cast<std::size_t>(function)]) continue;
      for (int component = 0; component < Dim; ++component) {
        const int unknown = Dim * function + component;
        if ((component != axis && support.roller) || is_prescribed(unknown)) continue;
        const bool moves = component == axis && std::ranges::binary_search(values, function);
        prescribed_.push_back(unknown);
        of_prescribed_.push_back(moves ? s : at_rest);
      }
    }
  }

  std::vector<PrescribedMotion> motions_;  // of the supports
  PrescribedMotion rest_;
  std::vector<Face> faces_;  // of the walls
  std::vector<WallContact> walls_;
  // Of the present phase:
  double start_ = 0;
  int dim_ = 1;
  std::vector<int> prescribed_;
  std::vector<std::size_t> of_prescribed_;        // support whose motion it follows, or at_rest
  std::vector<std::vector<int>> wall_functions_;  // value functions on each wall's face, ascending
};

}  // namespace stillpoint
