// Which functions of a face of the grid a support there holds: those that move material which lies on the face. A
// function reaches a cell into the grid, and what it holds a cell away would hang there.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "space/boundary/face_gaps.hpp"

namespace stillpoint {

/// "the nearest body is 0.4 m (0.8 of a cell) away from it"
inline std::string gap_message(const std::string& what, double gap, double cell) {
  return fmt::format("{} is {:.4g} m ({:.3g} of a cell) away from it", what, gap, gap / cell);
}

class TouchedFunctions {
 public:
  /// Of these functions of a face, ascending, which material reaches, those that are touched, as the first phase
  /// begins: nothing is held across a gap. Of a body that touches the face in a position between its points, those
  /// nearest to it.
  template <AxisBasis B, Kinematics K>
  std::vector<int> first(Face face, const std::vector<int>& reached, const FaceGaps<B, K>& gaps, int functions) {
    functions_ = functions;
    const std::vector<double> gap = gaps.of(face, reached);
    least_ = gap.empty() ? 0 : *std::ranges::min_element(gap);
    const double slack = touching * gaps.cell_at(face);
    const double most = least_ > slack && gaps.least_of_bodies(face) <= slack ? least_ + slack : slack;
    return held_ = up_to(most, reached, gap);
  }
  /// The same as a later phase begins. What was held stays so; what has come near is held once it touches, as closely
  /// as a phase can tell. Where the number of functions is another one, the grid's lines have moved.
  template <AxisBasis B, Kinematics K>
  std::vector<int> next(Face face, const std::vector<int>& reached, const FaceGaps<B, K>& gaps, int functions) {
    constexpr double near = 0.05;  // of a cell
    if (std::exchange(functions_, functions) != functions || held_ == reached) return held_ = reached;
    std::vector<int> is_new;
    std::ranges::set_difference(reached, held_, std::back_inserter(is_new));
    std::vector<int> held = up_to(near * gaps.cell_at(face), is_new, gaps.of(face, is_new));
    std::vector<int> stays;
    std::ranges::set_intersection(reached, held_, std::back_inserter(stays));
    held_.clear();
    std::ranges::merge(held, stays, std::back_inserter(held_));
    return held_;
  }
  void archive(const StateArchive& state) {
    state("held", held_);
    state("functions", functions_);
  }
  /// How far the material was away that first() looked at [m].
  double least() const { return least_; }

 private:
  static std::vector<int> up_to(double most, const std::vector<int>& functions, const std::vector<double>& gap) {
    std::vector<int> touched;
    for (std::size_t k = 0; k < functions.size(); ++k)
      if (gap[k] <= most) touched.push_back(functions[k]);
    return touched;
  }

  std::vector<int> held_;  // at the last call
  int functions_ = 0;
  double least_ = 0;
};

}  // namespace stillpoint
