// The material points of a run at some moments, in the compact form in which the report draws them.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "output/report/body_moment.hpp"

namespace stillpoint {

/// The numbers of the moments out of `all` that are drawn, evenly spaced: the first, the last, and between them as many
/// as leave room for the points of a body like `first`.
std::vector<std::size_t> drawn_moments(const BodyMoment& first, std::size_t all);

/// In space only the points at the surface are drawn, those in cells beside an empty one. If there is no room for all,
/// points are left out evenly.
class BodyPicture {
 public:
  /// moments: the number of moments that will be added, beginning with `first`. at: the positions of the points at
  /// which the surface is looked for, each (P × dim), beginning with those in `first` [m].
  BodyPicture(const GridSpec& grid, const BodyMoment& first, std::size_t moments,
              const std::vector<std::vector<double>>& at);
  void add(const BodyMoment& moment);
  /// {dim, points, drawn, mark, x: […], fields: [{name, min, max}], moments: [{t, values: […]}]}. A column of numbers
  /// is a text with two letters for each number, the digits of base 64 (A–Z a–z 0–9 + /) of k in
  /// min + (max − min) k/4094; 4095 means no number. mark: the size of a drawn point along the axes [m]. The points are
  /// at x + u.
  Json json() const;

 private:
  struct Field {
    std::string name;                          // "u.x", "stress.xy"
    std::vector<std::vector<float>> values{};  // one vector for each moment
  };
  struct Surface {
    std::vector<std::size_t> points;
    std::size_t cells = 0;  // occupied cells in the plane; in space their faces to empty ones
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
