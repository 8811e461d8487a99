// Two bodies cannot be in the same place.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "scene/input/scene_check.hpp"
#include "scene/outline.hpp"
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
    rounding_ = kSliver * check.cell_length(0);
    for (std::size_t axis = 1; axis < static_cast<std::size_t>(check.scene().dim); ++axis)
      rounding_ = std::max(rounding_, kSliver * check.cell_length(axis));
  }

  void run() {
    for (std::size_t j = 1; j < bodies_.size(); ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        if (!boxes_meet(bodies_[j], bodies_[k])) continue;
        const std::string found = what_overlaps(bodies_[j], bodies_[k]);
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

  /// The part of a that lies in b, or of b in a, in words; empty: none.
  std::string what_overlaps(const BodySpec& a, const BodySpec& b) const {
    if (!a.file.empty() || !b.file.empty()) return points_that_overlap(a, b);
    if (check_.scene().dim != 2) return "a part";  // boxes that meet
    const Polygon of_a = outline_of(a), of_b = outline_of(b);
    // Borders that should be one may lie apart, or over each other, by rounding all along.
    const double of_rounding = rounding_ * std::min(perimeter(of_a), perimeter(of_b)) / 2;
    const double area = overlap_area(of_a, of_b);
    return area > of_rounding ? fmt::format("an area of {:.4g} m2", area) : "";
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
      if (is_inside(shape, x)) return point_at(x);
    return "";
  }

  static std::string point_at(const std::vector<double>& x) {
    return fmt::format("the point at {:.6g}", fmt::join(x, ", "));
  }

  /// By more than rounding.
  bool is_inside(const BodySpec& shape, const std::vector<double>& x) const {
    for (std::size_t axis = 0; axis < x.size(); ++axis)
      if (x[axis] <= shape.min[axis] + rounding_ || x[axis] >= shape.max[axis] - rounding_) return false;
    if (shape.polygon.empty()) return true;
    const Polygon outline = outline_of(shape);
    return contains(outline, {x[0], x[1]}) && distance_to_border(outline, {x[0], x[1]}) > rounding_;
  }

  std::vector<std::vector<double>> positions_of(const BodySpec& body) const {
    if (body.file.empty()) return {};
    std::vector<Problem> reported_already;
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
};

}  // namespace

void check_overlaps(SceneCheck& check) { OverlapCheck(check).run(); }

}  // namespace stillpoint
