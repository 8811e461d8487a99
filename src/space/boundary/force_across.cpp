#include "space/boundary/force_across.hpp"

#include <algorithm>
#include <cmath>

namespace stillpoint {
namespace {

/// The least |F − Σ c_i e_i| over c ≥ 0, of unit vectors e_i, by one c_i after the other.
template <class Position>
double distance_from_cone(const Position& F, const std::vector<Position>& e) {
  constexpr double rounding = 1e-6;
  constexpr int sweeps = 10000;
  std::vector<double> c(e.size(), 0.0);
  Position left = F;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double most = 0;
    for (std::size_t i = 0; i < e.size(); ++i) {
      const double change = std::max(-c[i], e[i].dot(left));
      c[i] += change;
      left -= change * e[i];
      most = std::max(most, std::abs(change));
    }
    if (!(most > rounding * F.norm())) break;
  }
  return left.norm();
}

}  // namespace

template <Kinematics K>
double force_across(const ContactSurface<K>& surface, const std::vector<PushedPiece<K>>& pushed, const double* u) {
  constexpr double beside = 1, chord = 2;  // [cells]
  constexpr double alike = 0.7;            // the cosine between the normals of a chord
  using Position = typename TouchFinder<K>::Position;
  const auto direction = [](Position way) -> Position {
    if (K == Kinematics::axisymmetric) way[0] = 0;
    return way.normalized();
  };
  if (!are_few(pushed)) return 0;
  Position F = Position::Zero();
  for (const PushedPiece<K>& at : pushed) F += at.force;
  if (K == Kinematics::axisymmetric) F[0] = 0;
  const auto patches = surface.patches();
  std::vector<Position> inwards;
  for (const PushedPiece<K>& at : pushed) {
    const auto& own = patches[at.patch];
    const Position x = TouchFinder<K>::position_of(surface.start(at.piece)),
                   normal = TouchFinder<K>::position_of(surface.normal(at.piece));
    Position of_chord = Position::Zero();
    for (const auto& patch : patches) {
      for (std::size_t s = patch.begin; patch.body == own.body && s < patch.end; ++s) {
        const double away = (TouchFinder<K>::position_of(surface.start(s)) - x).norm() / own.cell;
        if (away > chord) continue;
        const Position b = TouchFinder<K>::position_of(surface.normal(s));
        if (away <= beside) inwards.push_back(direction(-b));
        if (b.dot(normal) >= alike) of_chord += TouchFinder<K>::position_of(surface.piece(s).deformed_area(u));
      }
    }
    inwards.push_back(direction(-of_chord));
  }
  return distance_from_cone(F, inwards);
}

template double force_across<Kinematics::line>(const ContactSurface<Kinematics::line>&,
                                               const std::vector<PushedPiece<Kinematics::line>>&, const double*);
template double force_across<Kinematics::plane>(const ContactSurface<Kinematics::plane>&,
                                                const std::vector<PushedPiece<Kinematics::plane>>&, const double*);
template double force_across<Kinematics::axisymmetric>(const ContactSurface<Kinematics::axisymmetric>&,
                                                       const std::vector<PushedPiece<Kinematics::axisymmetric>>&,
                                                       const double*);
template double force_across<Kinematics::space>(const ContactSurface<Kinematics::space>&,
                                                const std::vector<PushedPiece<Kinematics::space>>&, const double*);

}  // namespace stillpoint
