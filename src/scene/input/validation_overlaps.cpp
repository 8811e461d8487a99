// The check that no two bodies overlap.
#include <algorithm>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "scene/body_solid.hpp"
#include "scene/contact_bodies.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/point_file.hpp"

namespace stillpoint {
namespace {

double perimeter(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const PlanePoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    sum += distance(a, b);
  }
  return sum;
}

class OverlapCheck {
 public:
  explicit OverlapCheck(SceneCheck& check) : check_(check), bodies_(check.scene().bodies) {
    rounding_ = kSliver * longest_cell(check.scene().grid);  // no border has been moved further onto a line
  }

  void run() {
    for (std::size_t j = 1; j < bodies_.size(); ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        if (!boxes_meet(bodies_[j], bodies_[k])) continue;
        const double pressed = have_contact(check_.scene(), j, k) ? longest_cell(check_.scene().grid) / 2 : 0;
        const std::string found = what_overlaps(bodies_[j], bodies_[k], pressed);
        if (found.empty()) continue;
        check_.add(fmt::format("body[{}]", j),
                   fmt::format("{} lies in body[{}]; two bodies cannot be in the same place: leave room for the one in "
                               "the other, as a polygon around it",
                               found, k));
        break;
      }
    }
  }

 private:
  bool boxes_meet(const BodySpec& a, const BodySpec& b) const {
    for (std::size_t axis = 0; axis < a.min.size(); ++axis) {
      const double slack = a.file.empty() && b.file.empty() ? rounding_ : -rounding_;  // points have no extent
      if (std::min(a.max[axis], b.max[axis]) - std::max(a.min[axis], b.min[axis]) <= slack) return false;
    }
    return true;
  }

  /// The part that a and b have in common, in words; empty if there is none. pressed: by how much they may overlap, as
  /// bodies that touch each other [m]; how deep one lies in the other is checked where contact begins.
  std::string what_overlaps(const BodySpec& a, const BodySpec& b, double pressed) const {
    if (!a.file.empty() || !b.file.empty()) return points_that_overlap(a, b);
    if (check_.scene().dim != 2) {
      for (std::size_t axis = 0; axis < a.min.size(); ++axis)
        if (std::min(a.max[axis], b.max[axis]) - std::max(a.min[axis], b.min[axis]) <= pressed) return "";
      return (a.is_box() && b.is_box()) || solids_meet(a, b, pressed) ? "a part" : "";
    }
    const Polygon of_a = outline_of(a), of_b = outline_of(b);
    // Borders that should be one may lie apart, or over each other, by rounding all along.
    const double of_rounding = std::max(rounding_, pressed) * std::min(perimeter(of_a), perimeter(of_b)) / 2;
    const double area = overlap_area(of_a, of_b);
    return area > of_rounding ? fmt::format("an area of {:.4g} m2", area) : "";
  }

  /// True if a position of a lattice in the box that a and b have in common lies in both, and by more than half of
  /// `pressed` in one. The lattice has an odd number of positions along each axis, so that one lies in the middle.
  bool solids_meet(const BodySpec& a, const BodySpec& b, double pressed) const {
    constexpr int n = 21;
    const double slack = std::max(rounding_, std::numbers::sqrt3 * pressed / 2);  // in the direction of any border
    const SpaceBox common = in_common(box_of(a), box_of(b));
    for (int k = 0; k < n * n * n; ++k) {
      std::vector<double> x(3);
      for (std::size_t d = 0, number = static_cast<std::size_t>(k); d < 3; ++d, number /= n)
        x[d] = common.low[d] + (common.high[d] - common.low[d]) * (static_cast<double>(number % n) + 0.5) / n;
      if (is_inside(a, x, slack) && is_inside(b, x, slack)) return true;
    }
    return false;
  }

  std::string points_that_overlap(const BodySpec& a, const BodySpec& b) const {
    const auto positions_a = positions_of(a), positions_b = positions_of(b);
    if (!positions_a.empty() && !positions_b.empty()) {
      const std::set<std::vector<double>> taken(positions_b.begin(), positions_b.end());
      for (const std::vector<double>& x : positions_a)
        if (taken.contains(x)) return point_at(x);
      return "";
    }
    const BodySpec& shape = positions_a.empty() ? a : b;
    const auto& positions = positions_a.empty() ? positions_b : positions_a;
    for (const std::vector<double>& x : positions)
      if (is_inside(shape, x, rounding_)) return point_at(x);
    return "";
  }

  static std::string point_at(const std::vector<double>& x) {
    return fmt::format("the point at {:.6g}", fmt::join(x, ", "));
  }

  /// True if x lies inside by more than the slack [m].
  bool is_inside(const BodySpec& shape, const std::vector<double>& x, double slack) const {
    for (std::size_t axis = 0; axis < x.size(); ++axis)
      if (x[axis] <= shape.min[axis] + slack || x[axis] >= shape.max[axis] - slack) return false;
    if (shape.is_box()) return true;
    if (x.size() == 3) return is_inside_solid(shape, {x[0], x[1], x[2]}, slack);
    const Polygon outline = outline_of(shape);
    return contains(outline, {x[0], x[1]}) && distance_to_border(outline, {x[0], x[1]}) > slack;
  }

  /// True if x and its neighbours along each axis, at the distance of the slack, lie inside.
  bool is_inside_solid(const BodySpec& shape, const SpacePoint& x, double slack) const {
    std::shared_ptr<const Solid>& solid = solids_[&shape];
    if (!solid) solid = solid_of(shape);
    if (!solid->contains(x)) return false;
    for (std::size_t d = 0; d < 3; ++d) {
      for (const double aside : {-slack, slack}) {
        SpacePoint next = x;
        next[d] += aside;
        if (!solid->contains(next)) return false;
      }
    }
    return true;
  }

  std::vector<std::vector<double>> positions_of(const BodySpec& body) const {
    if (body.file.empty()) return {};
    std::vector<Mistake> reported_already;
    const PointFile file =
        read_point_file(body.file, check_.scene().grid.min, check_.scene().grid.max, reported_already);
    std::vector<std::vector<double>> positions(file.volume.size());
    for (std::size_t p = 0; p < positions.size(); ++p)
      for (const std::vector<double>& along : file.x) positions[p].push_back(along[p]);
    return positions;
  }

  SceneCheck& check_;
  const std::vector<BodySpec>& bodies_;
  double rounding_ = 0;  // [m]
  mutable std::map<const BodySpec*, std::shared_ptr<const Solid>> solids_;
};

}  // namespace

void check_overlaps(SceneCheck& check) { OverlapCheck(check).run(); }

}  // namespace stillpoint
