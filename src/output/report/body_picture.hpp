// The material points of a run at some moments, as the report draws them: in few bytes.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "output/report/body_moment.hpp"

namespace stillpoint {

/// Which of `all` moments are drawn, evenly: the first, the last, and between them no more than leaves room for the
/// points of a body like `first`.
std::vector<std::size_t> drawn_moments(const BodyMoment& first, std::size_t all);

/// In space the points at the surface are drawn alone: those in cells beside an empty one. Of what is more than there
/// is room for, points are left out evenly.
class BodyPicture {
 public:
  /// moments: how many will be added, `first` before the others. at: where the points are when the surface is looked
  /// for, each (P × dim), first of all in `first` [m].
  BodyPicture(const GridSpec& grid, const BodyMoment& first, std::size_t moments,
              const std::vector<std::vector<double>>& at);
  void add(const BodyMoment& moment);
  /// {dim, points, drawn, mark, x: […], fields: [{name, min, max}], moments: [{t, values: […]}]}. A column of numbers
  /// is a text: two letters each, the digits of base 64 (A–Z a–z 0–9 + /) of k in min + (max − min) k/4094; 4095 is no
  /// number. mark: how large a point is drawn, along the axes [m]. The points are at x + u.
  Json json() const;

 private:
  struct Field {
    std::string name;                          // "u.x", "stress.xy"
    std::vector<std::vector<float>> values{};  // by moments
  };
  struct Surface {
    std::vector<std::size_t> points;
    std::size_t cells = 0;  // in the plane that are occupied, in space their faces to empty ones
  };

  Surface surface(const GridSpec& grid, const std::vector<std::vector<double>>& at) const;
  void keep(std::size_t number, const std::string& name, std::vector<float> values);

  int dim_;
  std::size_t all_;
  std::vector<std::size_t> points_;
  std::vector<double> mark_;
  std::vector<std::vector<float>> x_;
  std::vector<Field> fields_;
  std::vector<double> times_;
};

}  // namespace stillpoint
