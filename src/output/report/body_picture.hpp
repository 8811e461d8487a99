// The material points of a run at some moments, in the compact form in which the report draws them.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "output/hdf5_file.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// A body at one moment, whose fields are read one after the other: from memory, or from fields.h5.
struct BodyMoment {
  double t = 0;  // [s]
  int dim = 1;
  std::size_t points = 0;                  // P
  std::vector<std::string> history_names;  // history variables of the laws, besides the stress
  /// A field, (P × components): "position", "u", "v", "stress" or one of history_names.
  std::function<std::vector<double>(const std::string&)> field;
};

/// The body at (t, u, v); fields may be read as long as these and the phase are unchanged.
BodyMoment moment_of(const LagrangianPhase& phase, double t, ConstVec u, ConstVec v);
/// A frame of fields.h5, given by its group. It and its field() throw std::filesystem::filesystem_error if the file
/// cannot be read; the file has to stay open for field().
BodyMoment moment_of(const Hdf5File& fields, const std::string& frame);

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
  /// min + (max − min) k/4094; 4095 means no number. mark: the size of a drawn point along the axes [m]; beside it,
  /// where the cells along some axis are unequal, `sizes`: columns like x, by which those of each point are multiplied.
  /// The points are at x + u.
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
  void find_sizes(const GridSpec& grid);
  void keep(std::size_t number, const std::string& name, std::vector<float> values);

  int dim_;
  std::size_t all_;
  std::vector<std::size_t> points_;
  std::vector<double> mark_;
  std::vector<std::vector<float>> x_, sizes_;
  std::vector<Field> fields_;
  std::vector<double> times_;
};

}  // namespace stillpoint
