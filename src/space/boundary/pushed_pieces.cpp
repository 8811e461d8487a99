#include "space/boundary/pushed_pieces.hpp"

#include <algorithm>
#include <cmath>

namespace stillpoint {
namespace {

template <Kinematics K>
double number_in_effect(const std::vector<PushedPiece<K>>& pushed) {
  double sum = 0, squares = 0;
  for (const PushedPiece<K>& at : pushed) {
    sum += at.force.norm();
    squares += at.force.squaredNorm();
  }
  return squares > 0 ? sum * sum / squares : 0;
}

/// Whether the border has an untouched piece within a cell, on the same side.
template <Kinematics K>
bool goes_on_beside(const ContactSurface<K>& surface, const PushedPiece<K>& at, const std::vector<char>& is_pushed) {
  constexpr double beside = 1;   // [cells]
  constexpr double alike = 0.7;  // the cosine between the normals
  const auto position = [&](std::size_t s) { return TouchFinder<K>::position_of(surface.start(s)); };
  const auto normal = [&](std::size_t s) { return TouchFinder<K>::position_of(surface.normal(s)); };
  const auto patches = surface.patches();
  const auto& own = patches[at.patch];
  return std::ranges::any_of(patches, [&](const auto& patch) {
    for (std::size_t s = patch.begin; patch.body == own.body && s < patch.end; ++s)
      if (!is_pushed[s] && (position(s) - position(at.piece)).norm() <= beside * own.cell &&
          normal(s).dot(normal(at.piece)) > alike)
        return true;
    return false;
  });
}

}  // namespace

template <Kinematics K>
bool are_few(const std::vector<PushedPiece<K>>& pushed) {
  constexpr double few = 3;  // along each direction of the border
  const double number = number_in_effect(pushed);
  return number > 0 && number <= std::pow(few, dimensions(K) - 1);
}

template <Kinematics K>
double few_amid_border(const ContactSurface<K>& surface, const std::vector<PushedPiece<K>>& pushed) {
  if (!are_few(pushed)) return 0;
  std::vector<char> is_pushed(surface.size(), 0);
  for (const PushedPiece<K>& at : pushed) is_pushed[at.piece] = 1;
  const bool goes_on =
      std::ranges::any_of(pushed, [&](const auto& at) { return goes_on_beside(surface, at, is_pushed); });
  return goes_on ? number_in_effect(pushed) : 0;
}

template bool are_few(const std::vector<PushedPiece<Kinematics::line>>&);
template bool are_few(const std::vector<PushedPiece<Kinematics::plane>>&);
template bool are_few(const std::vector<PushedPiece<Kinematics::axisymmetric>>&);
template bool are_few(const std::vector<PushedPiece<Kinematics::space>>&);
template double few_amid_border(const ContactSurface<Kinematics::line>&,
                                const std::vector<PushedPiece<Kinematics::line>>&);
template double few_amid_border(const ContactSurface<Kinematics::plane>&,
                                const std::vector<PushedPiece<Kinematics::plane>>&);
template double few_amid_border(const ContactSurface<Kinematics::axisymmetric>&,
                                const std::vector<PushedPiece<Kinematics::axisymmetric>>&);
template double few_amid_border(const ContactSurface<Kinematics::space>&,
                                const std::vector<PushedPiece<Kinematics::space>>&);

}  // namespace stillpoint
