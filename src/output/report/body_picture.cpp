#include "output/report/body_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_set>
#include <utility>

#include "output/point_fields.hpp"
#include "scene/dimensions.hpp"
#include "scene/grid_lines.hpp"

namespace stillpoint {
namespace {

constexpr std::size_t most_values = 1'150'000;  // at two bytes each a report stays below 3 MB
constexpr std::size_t fewest_moments = 6, most_moments = 60;

// The number of values of one point at one moment.
std::size_t width_of(const BodyMoment& body) {
  const std::size_t stress = body.dim == 1 ? 1 : body.dim == 2 ? 4 : 6;
  return static_cast<std::size_t>(body.dim) + 1 + stress + body.history_names.size();
}

using CellKey = std::uint64_t;
constexpr int bits_of_axis = 21;
constexpr std::uint64_t middle = std::uint64_t{1} << (bits_of_axis - 1);

// The cells of positions as numbers; a position beyond the range of numbers is in the last cell in its direction.
class CellKeys {
 public:
  CellKeys(const GridSpec& grid, int dim) : grid_(grid), lines_(static_cast<std::size_t>(dim)) {
    for (std::size_t axis = 0; axis < lines_.size(); ++axis)
      if (!has_equal_cells(grid, axis)) lines_[axis] = grid_lines(grid, axis);
  }
  CellKey of(const double* x) const {
    CellKey key = 0;
    for (std::size_t axis = 0; axis < lines_.size(); ++axis) {
      const double cell = number_along(axis, x[axis]), most = static_cast<double>(middle) - 2;
      const auto number = static_cast<std::int64_t>(std::isfinite(cell) ? std::clamp(cell, -most, most) : most);
      key |= (static_cast<std::uint64_t>(number) + middle) << (bits_of_axis * axis);
    }
    return key;
  }

 private:
  // Of unequal cells, those that lie outside the grid count as one on either side.
  double number_along(std::size_t axis, double x) const {
    const std::vector<double>& lines = lines_[axis];
    if (lines.empty() || !std::isfinite(x)) return std::floor(cells_before(grid_, axis, x));
    return static_cast<double>(std::ranges::upper_bound(lines, x) - lines.begin()) - 1;
  }

  const GridSpec& grid_;
  std::vector<std::vector<double>> lines_;  // of each axis; empty: the cells along it are equal
};

// Values are coded as min + (max − min) k/4094.
class Scale {
 public:
  void include(const std::vector<float>& values) {
    for (const float value : values) {
      if (!std::isfinite(value)) continue;
      min_ = std::min(min_, value);
      max_ = std::max(max_, value);
    }
  }
  double min() const { return min_; }
  double max() const { return max_; }
  std::string text(const std::vector<float>& values) const {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const double range = static_cast<double>(max_) - static_cast<double>(min_);
    std::string text;
    text.reserve(2 * values.size());
    for (const float value : values) {
      std::size_t k = 4095;
      if (std::isfinite(value))
        k = range > 0 ? static_cast<std::size_t>(std::lround(4094 * (value - min()) / range)) : 0;
      text += digits[k / 64];
      text += digits[k % 64];
    }
    return text;
  }
  Json json() const { return {{"min", number(min())}, {"max", number(max())}}; }

 private:
  float min_ = std::numeric_limits<float>::infinity(), max_ = -std::numeric_limits<float>::infinity();
};

// Columns of numbers, each with a scale of its own.
Json columns(const std::vector<std::vector<float>>& all) {
  Json coded = Json::array();
  for (const std::vector<float>& values : all) {
    Scale scale;
    scale.include(values);
    Json column = scale.json();
    column["values"] = scale.text(values);
    coded.push_back(std::move(column));
  }
  return coded;
}

// One component at the points that are drawn; component < 0: the length of the vector.
std::vector<float> picked(const std::vector<double>& values, std::size_t width, int component,
                          const std::vector<std::size_t>& points) {
  std::vector<float> some;
  some.reserve(points.size());
  for (const std::size_t p : points) {
    const double* row = &values[p * width];
    double value = component < 0 ? 0 : row[component];
    if (component < 0) {
      for (std::size_t k = 0; k < width; ++k) value = std::hypot(value, row[k]);
    }
    some.push_back(static_cast<float>(value));
  }
  return some;
}

std::vector<std::size_t> evenly(std::size_t all, std::size_t some) {
  std::vector<std::size_t> numbers;
  if (some >= all) some = all;
  for (std::size_t k = 0; k < some; ++k) numbers.push_back(some > 1 ? k * (all - 1) / (some - 1) : all - 1);
  return numbers;
}

// The first columns of an array (rows × columns).
std::vector<double> leading_columns(const std::vector<double>& array, std::size_t rows, std::size_t wanted) {
  const std::size_t columns = array.size() / rows;
  std::vector<double> leading(rows * wanted);
  for (std::size_t row = 0; row < rows; ++row)
    std::copy_n(array.begin() + static_cast<std::ptrdiff_t>(row * columns), wanted,
                leading.begin() + static_cast<std::ptrdiff_t>(row * wanted));
  return leading;
}

// A stress in the plane or in space is stored component by component.
std::vector<double> stored_stress(const Hdf5File& fields, const std::string& frame, std::size_t points, int dim) {
  constexpr std::array components = {"_xx", "_yy", "_zz", "_xy", "_yz", "_zx"};
  if (dim == 1) return fields.read(frame + "/stress");
  const std::size_t width = dim == 2 ? 4 : 6;
  std::vector<double> stress(points * width);
  for (std::size_t k = 0; k < width; ++k) {
    const std::vector<double> component = fields.read(frame + "/stress" + components[k]);
    for (std::size_t p = 0; p < points; ++p) stress[p * width + k] = component[p];
  }
  return stress;
}

bool is_always_there(const std::string& name) {
  constexpr std::array apart = {"place", "u", "v", "material", "volume"};
  if (std::ranges::find(apart, name) != apart.end() || name.starts_with("stress") || name == "strain") return true;
  return std::ranges::any_of(stress_names(6), [&](const std::string& ij) { return name == "strain_" + ij; });
}

}  // namespace

std::vector<std::size_t> drawn_moments(const BodyMoment& first, std::size_t all) {
  const std::size_t wanted = most_values / std::max<std::size_t>(1, first.points * width_of(first));
  return evenly(all, std::clamp(wanted, fewest_moments, most_moments));
}

BodyPicture::BodyPicture(const GridSpec& grid, const BodyMoment& first, std::size_t moments,
                         const std::vector<std::vector<double>>& at)
    : dim_(first.dim), all_(first.points) {
  Surface found = surface(grid, at);
  const std::size_t room = most_values / (static_cast<std::size_t>(dim_) + moments * width_of(first));
  for (const std::size_t k : evenly(found.points.size(), room)) points_.push_back(found.points[k]);
  // Only about half of the surface points of a body in space are in front of the others.
  const double share = static_cast<double>(found.cells) / static_cast<double>(std::max<std::size_t>(1, points_.size()));
  const double of_cell = dim_ == 1 ? share : std::sqrt(dim_ == 2 ? share : std::min(1.0, 2 * share));
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim_); ++k) mark_.push_back(of_cell * mean_cell(grid, k));
  for (int k = 0; k < dim_; ++k) x_.push_back(picked(at.front(), static_cast<std::size_t>(dim_), k, points_));
  find_sizes(grid);
}

// Points stand for as much as the cells have room for that they are in when the run begins.
void BodyPicture::find_sizes(const GridSpec& grid) {
  const std::size_t axes = x_.size();
  bool all_equal = true;
  for (std::size_t k = 0; k < axes; ++k) all_equal = all_equal && has_equal_cells(grid, k);
  for (std::size_t k = 0; k < axes && !all_equal; ++k) {
    std::vector<float>& along = sizes_.emplace_back();
    for (const float x : x_[k]) along.push_back(static_cast<float>(cell_length_at(grid, k, x) / mean_cell(grid, k)));
  }
}

BodyPicture::Surface BodyPicture::surface(const GridSpec& grid, const std::vector<std::vector<double>>& at) const {
  const auto width = static_cast<std::size_t>(dim_);
  Surface found;
  const CellKeys cells(grid, dim_);
  std::vector<char> is_seen(all_, dim_ < 3 ? 1 : 0);
  for (const std::vector<double>& position : at) {
    std::vector<CellKey> keys(all_);
    std::unordered_set<CellKey> occupied;
    for (std::size_t p = 0; p < all_; ++p) {
      keys[p] = cells.of(&position[p * width]);
      if (p == 0 || keys[p] != keys[p - 1]) occupied.insert(keys[p]);  // a cell's points are consecutive
    }
    if (found.cells == 0 && dim_ < 3) found.cells = occupied.size();
    if (dim_ < 3) continue;
    std::unordered_set<CellKey> outer;
    std::size_t faces = 0;
    for (const CellKey key : occupied) {
      for (int k = 0; k < dim_; ++k) {
        const CellKey step = CellKey{1} << (bits_of_axis * k);
        for (const CellKey neighbour : {key - step, key + step}) {
          if (occupied.contains(neighbour)) continue;
          ++faces;
          outer.insert(key);
        }
      }
    }
    if (found.cells == 0) found.cells = faces;
    bool is_outer = false;
    for (std::size_t p = 0; p < all_; ++p) {
      if (p == 0 || keys[p] != keys[p - 1]) is_outer = outer.contains(keys[p]);
      if (is_outer) is_seen[p] = 1;
    }
  }
  for (std::size_t p = 0; p < all_; ++p)
    if (is_seen[p]) found.points.push_back(p);
  return found;
}

void BodyPicture::keep(std::size_t number, const std::string& name, std::vector<float> values) {
  if (number == fields_.size()) fields_.push_back({name});
  fields_[number].values.push_back(std::move(values));
}

void BodyPicture::add(const BodyMoment& moment) {
  constexpr std::array axes = {".x", ".y", ".z"};
  constexpr std::array of_stress = {".xx", ".yy", ".zz", ".xy", ".yz", ".zx"};
  const auto width = static_cast<std::size_t>(dim_);
  std::size_t number = 0;
  {
    const std::vector<double> u = moment.field("u");
    for (int k = 0; times_.empty() && k < dim_; ++k) {  // initial positions
      const std::vector<float> moved = picked(u, width, k, points_);
      for (std::size_t p = 0; p < moved.size(); ++p) x_[static_cast<std::size_t>(k)][p] -= moved[p];
    }
    for (int k = 0; k < dim_; ++k)
      keep(number++, dim_ == 1 ? "u" : std::string("u") + axes[static_cast<std::size_t>(k)],
           picked(u, width, k, points_));
  }
  keep(number++, "v", picked(moment.field("v"), width, dim_ == 1 ? 0 : -1, points_));
  {
    const std::vector<double> stress = moment.field("stress");
    const std::size_t components = stress.size() / all_;
    for (std::size_t k = 0; k < components; ++k)
      keep(number++, components == 1 ? "stress" : std::string("stress") + of_stress[k],
           picked(stress, components, static_cast<int>(k), points_));
  }
  for (const std::string& name : moment.history_names) keep(number++, name, picked(moment.field(name), 1, 0, points_));
  times_.push_back(moment.t);
}

Json BodyPicture::json() const {
  Json fields = Json::array(), moments = Json::array();
  for (const double t : times_) moments.push_back({{"t", number(t)}, {"values", Json::array()}});
  for (const Field& field : fields_) {
    Scale scale;
    for (const std::vector<float>& values : field.values) scale.include(values);
    Json one = scale.json();
    one["name"] = field.name;
    fields.push_back(std::move(one));
    for (std::size_t m = 0; m < field.values.size(); ++m) moments[m]["values"].push_back(scale.text(field.values[m]));
  }
  Json all = {{"dim", dim_},      {"points", all_},   {"drawn", points_.size()}, {"mark", mark_},
              {"x", columns(x_)}, {"fields", fields}, {"moments", moments}};
  if (!sizes_.empty()) all["sizes"] = columns(sizes_);
  return all;
}

BodyMoment moment_of(const LagrangianPhase& phase, double t, ConstVec u, ConstVec v) {
  return {.t = t,
          .dim = phase.dim(),
          .points = phase.points(),
          .history_names = phase.info().law_fields,
          .field = [&phase, t, u, v](const std::string& name) {
            return name == "position" ? current_positions(phase, t, u) : point_field(phase, name, t, u, v);
          }};
}

BodyMoment moment_of(const Hdf5File& fields, const std::string& frame) {
  BodyMoment moment{.t = fields.read_attribute(frame, "t"),
                    .dim = static_cast<int>(fields.read_attribute(frame, "dim")),
                    .points = fields.rows_of(frame + "/place"),
                    .history_names = fields.names_in(frame),
                    .field = {}};
  std::erase_if(moment.history_names, is_always_there);
  moment.field = [&fields, frame, dim = moment.dim, points = moment.points](const std::string& name) {
    if (name == "stress") return stored_stress(fields, frame, points, dim);
    const std::vector<double> stored = fields.read(frame + "/" + (name == "position" ? "place" : name));
    const bool is_vector = name == "position" || name == "u" || name == "v";
    return is_vector ? leading_columns(stored, points, static_cast<std::size_t>(dim)) : stored;
  };
  return moment;
}

}  // namespace stillpoint
