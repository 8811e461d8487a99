// The functions of a face of the grid that a support there holds: those that move material lying on the face. A
// function reaches a cell into the grid, and material a cell away would hang from a function held there. Over the
// phases, other functions wait until their material has reached the face.
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

/// Such as "the nearest body is 0.4 m (0.8 of a cell) away from it".
inline std::string gap_message(const std::string& what, double gap, double cell) {
  return fmt::format("{} is {:.4g} m ({:.3g} of a cell) away from it", what, gap, gap / cell);
}

class TouchedFunctions {
 public:
  /// A function whose material is a gap away from the face [m]; below 0: past it.
  struct Apart {
    int function;
    double gap;
  };

  bool has_begun() const { return functions_ > 0; }
  /// The touched functions when the first phase begins, from the functions of a face that material reaches, in
  /// ascending order: nothing is held across a gap. If a body touches the face between its points, the functions of the
  /// points nearest to it.
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
  /// The touched functions when a later phase begins. Held functions stay held, and those whose material has reached
  /// the face are added. A different number of functions means that the grid lines have moved.
  template <int Dim>
  std::vector<int> next(Face face, const std::vector<int>& reached, const FaceGaps<Dim>& gaps, int functions) {
    constexpr double near = 0.01;  // share of a cell
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
  /// The functions have other numbers from now on, see BoundaryCondition::renumber().
  void renumber(const std::vector<int>& now_of, int functions) {
    const auto number = [&](int& function) { function = now_of[static_cast<std::size_t>(function)]; };
    for (int& function : held_) number(function);
    std::erase(held_, -1);
    for (std::vector<Apart>* list : {&waiting_, &come_}) {
      for (Apart& one : *list) number(one.function);
      std::erase_if(*list, [](const Apart& one) { return one.function < 0; });
    }
    functions_ = functions;
  }
  /// The functions that next() left free, in ascending order, with the gaps of their material.
  const std::vector<Apart>& waiting() const { return waiting_; }
  /// The gap of material that has reached the face since the last phase began, below 0: past it; 0 if the function has
  /// none.
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
  /// The least gap that first() found [m].
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

  std::vector<int> held_;              // at the last call of first() or next()
  std::vector<Apart> waiting_, come_;  // left free by it, and newly come to the face
  bool is_restored_ = false;           // whether archive() restored the state and the phase has not begun anew
  int functions_ = 0;
  double least_ = 0;
};

}  // namespace stillpoint
