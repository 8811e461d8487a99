// How a phase deals with cells that the body hardly reaches.
#pragma once

#include <algorithm>
#include <numeric>
#include <utility>

#include "space/grid/cut_cells.hpp"
#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

// Where the body does not move on: in later phases nobody knows where in a cell it ends.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::join_slivers() {
  const std::vector<CellShares> covered = std::move(body_.covered);
  const CutCells<Dim> cut(grid_, covered, B::degree);
  body_.quadrature.slivers = static_cast<int>(cut.slivers().size());
  if (cut.slivers().empty() || updated_lagrangian()) return;

  weights_.rebuild(grid_, body_.points);
  HeldUnknowns held(Dim * static_cast<std::size_t>(Basis::count(grid_)), 0);
  const std::vector<char> reached = active_functions();
  for (const auto& condition : boundary_) condition->hold(grid_, reached, held);
  // What holds the sliver has to hold its host.
  const auto may_host = [&](int sliver, int cell) {
    for (int i = 0; i < Dim; ++i) {
      if (is_held(held, sliver, i) && !is_held(held, cell, i)) return false;
    }
    return true;
  };
  std::vector<int> host(static_cast<std::size_t>(grid_.cells()));
  std::iota(host.begin(), host.end(), 0);
  for (const int sliver : cut.slivers()) {
    int& of_sliver = host[static_cast<std::size_t>(sliver)];
    of_sliver = cut.host_of(sliver, may_host);
    body_.quadrature.joined += of_sliver != sliver ? 1 : 0;
  }
  if (body_.quadrature.joined == 0) return;
  grid_.host = std::move(host);
  order_.sort(body_.points, grid_);
}

template <AxisBasis B, Kinematics K>
bool MaterialPointPhase<B, K>::is_held(const HeldUnknowns& held, int cell, int component) const {
  const int first = Basis::first(grid_, grid_.cell_at(cell));
  const auto offsets = Basis::offsets(grid_);
  return std::ranges::any_of(offsets, [&](int offset) {
    const int unknown = Dim * (first + offset) + component;
    return held.is_prescribed(unknown) || held.is_guided(unknown);
  });
}

}  // namespace stillpoint
