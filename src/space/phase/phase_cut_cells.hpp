// The extension of functions into cells that the body hardly reaches.
#pragma once

#include <algorithm>
#include <utility>

#include "space/grid/cut_cells.hpp"
#include "space/grid/sliver_extension.hpp"
#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

// Extends functions only in a body with a single phase: in later phases it is not known where in a cell the body ends.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::extend_into_slivers() {
  const std::vector<CellShares> covered = std::move(body_.covered);
  const CutCells<Dim> cut(grid_, covered, B::degree);
  if (cut.slivers().empty()) return;
  make_weights();
  const std::vector<char> reached = active_functions();
  const HeldUnknowns held = take_hold(0, reached);
  const auto is_held = [&](int function, int i) {
    const int unknown = Dim * function + i;
    return held.is_prescribed(unknown) || held.is_guided(unknown);
  };
  // A function may follow others only if each of its held components is held in them too.
  const auto may_follow = [&](int function, const auto& sources) {
    return std::ranges::all_of(sources, [&](const ExtendedFunctions::Source& source) {
      bool may = reached[static_cast<std::size_t>(source.function)] != 0;
      for (int i = 0; i < Dim; ++i) may = may && (!is_held(function, i) || is_held(source.function, i));
      return may;
    });
  };
  const SliverExtension<B, Dim> extension(grid_, cut, may_follow);
  body_.quadrature.slivers = extension.slivers();
  if (updated_lagrangian()) return;
  extension_ = extension.functions();
  body_.quadrature.joined = extension.joined();
}

}  // namespace stillpoint
