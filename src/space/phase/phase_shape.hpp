// What a phase is made of: its arrays and cells, the positions of its unknowns, and the parts of its body.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "space/grid/layout_of_unknowns.hpp"
#include "space/phase/body_neighbours.hpp"
#include "space/phase/free_parts.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/phase_assembly.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class PhaseShapeOf final : public PhaseShape {
  static constexpr int dim = dimensions(K);

 public:
  /// all: must outlive this object.
  explicit PhaseShapeOf(const PhaseAssembly<B, K>& all) : all_(all), frame_(all.frame) {}

  Discretisation discretisation() const override {
    std::vector<PointArray> arrays = PointWeights<B, K>::arrays();
    for (PointArray& array : all_.force.laws().arrays()) arrays.push_back(std::move(array));
    if (const double moments = all_.force.bytes_of_elastic_cells(); moments > 0)
      arrays.push_back({"moments of cells", moments / static_cast<double>(frame_.body.numbers())});
    std::vector<int> cells;
    for (const Axis& axis : frame_.grid.axes) cells.push_back(axis.cells());
    const std::set<int> occupied(frame_.body.points.cell.begin(), frame_.body.points.cell.end());
    return {frame_.account().arrays(arrays), frame_.dofs().prescribed.size(), std::move(cells), occupied.size(),
            frame_.body.quadrature};
  }
  std::vector<std::vector<double>> grid_lines() const override {
    std::vector<std::vector<double>> lines;
    for (const Axis& axis : frame_.grid.axes) lines.push_back(axis.nodes);
    return lines;
  }
  NodalLayout layout() const override { return layout_of(frame_.functions, frame_.dofs()); }
  std::vector<FreePart> free_parts() const override {
    const std::vector<char> sprung = all_.conditions.are_sprung(frame_.dofs().number.size());
    return find_free_parts<dim>(cells_of_parts<dim>(frame_.body.points, frame_.weights, frame_.ranks), frame_.weights,
                                frame_.functions, K == Kinematics::axisymmetric ? 1 : 0, frame_.dofs(), sprung,
                                /*as_one=*/frame_.moves_on());
  }
  std::vector<BodyGap> body_gaps() const override {
    if (frame_.problem.bodies.size() < 2) return {};
    return BodyNeighbours<dim>(frame_.problem, frame_.functions, frame_.body.points, frame_.weights,
                               frame_.body.first_number, frame_.ranks)
        .find(frame_.phase == 0);
  }

 private:
  const PhaseAssembly<B, K>& all_;
  const PhaseFrame<B, K>& frame_;
};

}  // namespace stillpoint
