// Facets of a body's border, each opposite to a piece of another body's border while a phase lasts.
//
// With the piece at x_s and its foot x_m on the facet, whose normal n points out of the body there, the gap is
//
//   g = n·(x_s − x_m) + n·(w_s u_s − w_m u_m).
//
// The surface moves relative to the facets (ContactSurface::move_relative_to), so that its x is x_s + w_s u_s − w_m
// u_m.
#pragma once

#include <utility>
#include <vector>

#include "geometry/rigid_placement.hpp"
#include "space/boundary/contact_surface.hpp"
#include "space/boundary/touch_finder.hpp"

namespace stillpoint {

template <Kinematics K>
class FacetFinder {
 public:
  static constexpr int N = TouchFinder<K>::N;
  using Position = Eigen::Vector<double, N>;

  struct Facet {
    bool is_there = false;
    double gap = 0;                      // n·(x_s − x_m) [m]
    Position normal = Position::Zero();  // n
    std::size_t opposite = 0;            // its piece of the other border
  };

  /// The surface must outlive this object.
  explicit FacetFinder(const ContactSurface<K>& surface) : surface_(surface) {}

  /// The facets of the phase, (pieces).
  void oppose(std::vector<Facet> facets) { facets_ = std::move(facets); }
  bool has_facets() const { return !facets_.empty(); }
  bool is_there(std::size_t piece) const { return facets_[piece].is_there; }
  /// The piece of the other border whose facet a piece has.
  std::size_t opposite(std::size_t piece) const { return facets_[piece].opposite; }
  /// Whether a piece is closed at u, (pieces), so that it feels what it touches.
  std::vector<char> closed(const double* u) const {
    std::vector<char> closed(facets_.size(), 0);
    for_near(
        {}, u, [](std::size_t) { return 0.0; }, [&](const auto& near) { closed[near.piece] = 1; });
    return closed;
  }
  RigidPlacement<N> placement(double /*t*/) const { return {}; }
  bool is_free() const { return false; }
  Position load(double /*t*/) const { return Position::Zero(); }
  /// The gap of a piece when the phase began [m].
  double gap_at_start(std::size_t piece) const { return facets_[piece].gap; }

  /// Calls visit(near) for each piece with a facet and g ≤ reach(its patch).
  template <class Reach, class Visit>
  void for_near(const RigidPlacement<N>&, const double* u, const Reach& reach, const Visit& visit) const {
    const auto patches = surface_.patches();
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const double within = reach(k);
      for (std::size_t s = patches[k].begin; s < patches[k].end; ++s) {
        const Facet& facet = facets_[s];
        if (!facet.is_there) continue;
        // From the motion, which may be much smaller than the positions.
        const Position moved = TouchFinder<K>::position_of(surface_.motion(s, u));
        const double g = facet.gap + facet.normal.dot(moved);
        if (!(g <= within)) continue;
        const Position x = TouchFinder<K>::position_of(surface_.start(s)) + moved;
        visit(typename TouchFinder<K>::Near{k, s, x, x, nearest_on_face<N>(g, facet.normal)});
      }
    }
  }

 private:
  const ContactSurface<K>& surface_;
  std::vector<Facet> facets_;
};

}  // namespace stillpoint
