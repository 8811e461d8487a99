// What a border bears across its own normals, as only places that feel contact can.
//
// A smooth border bears what pushes into it, F = Σ A p n, by pressures along its own normals b alone: F is in the cone
// of the −b. Places that feel contact are pushed along the normals n of what touches them. A round body of the radius R
// stands in between two places that are a apart, and their n differ by a/R: it is held as by a friction of a/(2 R), at
// whatever place it has come to. What touches many places has none that holds it: there the border takes its shape.
//
// The border's normals are those of all places within a cell when the phase began, as beside a corner or in a hollow,
// and the present ones, of chords over four cells: that of a single cell tilts by what presses on one side of it.
#pragma once

#include <vector>

#include "space/boundary/pushed_pieces.hpp"

namespace stillpoint {

/// The distance of F from that cone at u [N]; 0 where more than few pieces bear it. Around an axis along the axis
/// alone.
template <Kinematics K>
double force_across(const ContactSurface<K>& surface, const std::vector<PushedPiece<K>>& pushed, const double* u);

}  // namespace stillpoint
