// The pieces of a border that something pushes, and how many they are in effect,
//
//   n = (Σ |f|)²/Σ |f|²,
//
// which is their number where all are pushed alike. Where a contact ends between two pieces cannot be told: where few
// bear, which of them do is decided by the way to rest, and there may be several states of rest.
#pragma once

#include <vector>

#include "space/boundary/contact_surface.hpp"
#include "space/boundary/touch_finder.hpp"

namespace stillpoint {

/// A piece of a border that is touched, with what pushes it, A p n [N].
template <Kinematics K>
struct PushedPiece {
  std::size_t patch, piece;
  typename TouchFinder<K>::Position force;
};

/// n ≤ 3 in the plane, 9 in space. False where nothing is pushed.
template <Kinematics K>
bool are_few(const std::vector<PushedPiece<K>>& pushed);

/// n where they are few and the border goes on beside them, within a cell, without being touched; else 0.
template <Kinematics K>
double few_amid_border(const ContactSurface<K>& surface, const std::vector<PushedPiece<K>>& pushed);

}  // namespace stillpoint
