// Which functions of a face of the grid a support there holds: those that move material which lies on the face. A
// function reaches a cell into the grid, and what it holds a cell away would hang there. In phases others wait until
// their material has come to the face.
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
  /// One whose material is a gap away from the face [m]; below 0: past it.
  struct Apart {
    int function;
    double gap;
  };

  /// Of these functions of a face, ascending, which material reaches, those that are touched, as the first phase
  /// begins: nothing is held across a gap. Of a body that touches the face in a position between its points, those
  /// nearest to it.
  template <int Dim>
  std::vector<int> first(Face face, const std::vector<int>& reached, const FaceGaps<Dim>& gaps, int functions) {
    functions_ = functions;
    const std::vector<double> gap = gaps.of(face, reached);
    least_ = gap.empty() ? 0 : *std::ranges::min_element(gap);
    const double slack = touching * gaps.cell_at(face);
    const double most = least_ > slack && gaps.least_of_bodies(face) <= slack ? least_ + slack : slack;
    held_.clear();
    waiting_.clear();
    for (std::size_t k = 0; k < reached.size(); ++k) {
      if (gap[k] <= most) {
        held_.push_back(reached[k]);
      } else {
        waiting_.push_back({reached[k], gap[k]});
      }
    }
    return held_;
  }
  /// The same as a later phase begins. What was held stays so; what has come to the face is held from now on. Where the
  /// number of functions is another one, the grid's lines have moved.
  template <int Dim>
  std::vector<int> next(Face face, const std::vector<int>& reached, const FaceGaps<Dim>& gaps, int functions) {
    constexpr double near = 0.01;  // of a cell
    if (!std::exchange(is_restored_, false)) come_.clear();
    const std::vector<Apart> waited = std::exchange(waiting_, {});
    if (std::exchange(functions_, functions) != functions || held_ == reached) return held_ = reached;
    std::vector<int> is_new, held;
    std::ranges::set_difference(reached, held_, std::back_inserter(is_new));
    const std::vector<double> gap = gaps.of(face, is_new);
    for (std::size_t k = 0; k < is_new.size(); ++k) {
      if (gap[k] > near * gaps.cell_at(face)) {
        waiting_.push_back({is_new[k], gap[k]});
        continue;
      }
      held.push_back(is_new[k]);
      if (std::ranges::binary_search(waited, is_new[k], {}, &Apart::function)) come_.push_back({is_new[k], gap[k]});
    }
    std::vector<int> stays;
    std::ranges::set_intersection(reached, held_, std::back_inserter(stays));
    held_.clear();
    std::ranges::merge(held, stays, std::back_inserter(held_));
    return held_;
  }
  /// Of those that next() left, ascending: how far their material has to go.
  const std::vector<Apart>& waiting() const { return waiting_; }
  /// How far past the face, or before it, the material lies that has come since the last phase began; 0: it has not.
  double gap_of_come(int function) const {
    const auto found = std::ranges::lower_bound(come_, function, {}, &Apart::function);
    return found != come_.end() && found->function == function ? found->gap : 0;
  }
  void archive(const StateArchive& state) {
    state("held", held_);
    state("functions", functions_);
    archive(state, "waiting", waiting_);
    archive(state, "come", come_);
    is_restored_ = state.restores();
  }
  /// How far the material was away that first() looked at [m].
  double least() const { return least_; }

 private:
  static void archive(const StateArchive& state, const std::string& name, std::vector<Apart>& apart) {
    std::vector<int> functions;
    std::vector<double> gaps;
    for (const Apart& one : apart) functions.push_back(one.function), gaps.push_back(one.gap);
    state(name + "_functions", functions);
    state(name + "_gaps", gaps);
    apart.clear();
    for (std::size_t k = 0; k < functions.size(); ++k) apart.push_back({functions[k], gaps.at(k)});
  }

  std::vector<int> held_;              // at the last call
  std::vector<Apart> waiting_, come_;  // likewise
  bool is_restored_ = false;           // before the phase of then begins anew
  int functions_ = 0;
  double least_ = 0;
};

}  // namespace stillpoint
