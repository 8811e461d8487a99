// The ends of a stage or of a run at which no phase follows another, so that points do not move on by remap.hpp: those
// of bodies of small strain, and of a single phase.
#pragma once

#include <algorithm>
#include <vector>

#include "parallel/of_all.hpp"
#include "space/phase/internal_force.hpp"
#include "space/phase/phase_frame.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class StageEnd {
  static constexpr int dim = dimensions(K);
  using Block = PointBlock<K>;

 public:
  /// The arguments must outlive this object.
  StageEnd(PhaseFrame<B, K>& frame, const InternalForce<B, K>& force) : frame_(frame), force_(force) {}

  /// Adds the strain of a stage at (t, u) to that of the stages before. The points stay where they are, and at rest:
  /// the positions from which they have moved since the run began become others.
  void take_strains_in_place(double t, ConstVec u) const {
    std::vector<double> all_moved(frame_.origin.size(), 0.0);
    visit(
        t, u, [&](std::size_t m, Block& block) { frame_.body.materials[m]->end_phase(block); },
        [&](std::size_t, std::size_t number, int d, double moved) { all_moved[at(number, d)] = moved; });
    unite(frame_.ranks, Vec(all_moved));
    for (std::vector<double>* const from : {&frame_.origin, &frame_.placed})
      for (std::size_t i = 0; i < from->size(); ++i) (*from)[i] -= all_moved[i];
    for (auto& v : frame_.body.points.v) std::ranges::fill(v, 0.0);
    ++frame_.phase;
  }

  /// Ends the only phase of a run at (t, u): the points move on, where the strains are not small. Returns their
  /// displacement gradients.
  std::vector<TensorOf<K>> leave_single_phase(double t, ConstVec u) const {
    MaterialPoints<dim>& points = frame_.body.points;
    std::vector<TensorOf<K>> H(points.size());
    frame_.origin = frame_.account().positions();
    const bool in_place = frame_.is_of_small_strain();
    visit(
        t, u,
        [&](std::size_t, Block& block) {
          for (std::size_t q = 0; q < block.count; ++q) H[block.first + q] = block.H_at(q);
        },
        [&](std::size_t p, std::size_t number, int d, double moved) {
          if (in_place) {
            frame_.origin[at(number, d)] -= moved;
          } else {
            points.x[static_cast<std::size_t>(d)][p] += moved;
          }
        });
    for (std::size_t p = 0; p < points.size() && !in_place; ++p)
      points.volume[p] *= determinant<K>(plus_identity<K>(H[p]));
    return H;
  }

 private:
  static std::size_t at(std::size_t number, int d) {
    return static_cast<std::size_t>(dim) * number + static_cast<std::size_t>(d);
  }

  // Calls take(material, block) with the deformation of each block, and then move(point, its number, axis,
  // displacement).
  template <class Take, class Move>
  void visit(double t, ConstVec u, const Take& take, const Move& move) const {
    const auto work = force_.borrow();
    const double* const grid_u = work->u.data();
    frame_.unknowns.spread(t, u, work->u);
    force_.laws().take_means(grid_u, *work);
    force_.points().visit(grid_u, [&](std::size_t m, Block& block) {
      force_.laws().average(m, block, *work);
      take(m, block);
    });
    frame_.for_points([&](std::size_t k, std::size_t p, std::size_t number) {
      const auto moved = frame_.weights.value(grid_u, k, p);
      for (int d = 0; d < dim; ++d) move(p, number, d, moved[static_cast<std::size_t>(d)]);
    });
  }

  PhaseFrame<B, K>& frame_;
  const InternalForce<B, K>& force_;
};

}  // namespace stillpoint
