#include "scene/point_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"

namespace stillpoint {
namespace {

constexpr std::size_t kMostProblems =
    20;  // most faults that are listed for one file: a table with a wrong separator is wrong in every line
constexpr std::size_t kMostPoints = 50'000'000;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // with which some programs begin a file

/// One value of a line, without the spaces around it.
struct Cell {
  std::string_view text;
  int column;  // 1-based
};

std::vector<Cell> cells_of(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::size_t first = begin, last = end;
    while (first < last && (line[first] == ' ' || line[first] == '\t')) ++first;
    while (last > first && (line[last - 1] == ' ' || line[last - 1] == '\t')) --last;
    cells.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
    begin = end + 1;
  }
  return cells;
}

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

class Reader {
 public:
  Reader(const std::filesystem::path& file, const std::vector<double>& min, const std::vector<double>& max,
         std::vector<Mistake>& problems)
      : file_(file), min_(min), max_(max), problems_(problems) {
    for (std::size_t d = 0; d < min.size(); ++d) names_.emplace_back(1, "xyz"[d]);
    names_.emplace_back("volume");
  }

  PointFile read() {
    points_.x.resize(min_.size());
    std::error_code error;
    if (!std::filesystem::exists(file_, error)) return refuse("there is no such file");
    if (!std::filesystem::is_regular_file(file_, error)) return refuse("is not a file of points");
    std::ifstream stream(file_, std::ios::binary);
    if (!stream) return refuse("cannot be opened for reading");
    std::string line;
    bool header = false, good = true;
    for (; good && std::getline(stream, line); ++line_) {
      std::string_view text = std::string_view(line).substr(0, line.find('#'));
      if (line_ == 1 && text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
      if (text.ends_with('\r')) text.remove_suffix(1);
      if (text.find_first_not_of(" \t") == std::string_view::npos) continue;
      good = header ? read_point(text) : read_header(text);
      header = true;
    }
    if (!header) return refuse(fmt::format("is empty: expected a line with the columns {}", fmt::join(names_, ", ")));
    if (good && points_.volume.empty() && found_ == 0) return refuse("holds no points");
    return std::move(points_);
  }

 private:
  PointFile refuse(const std::string& why) {
    problems_.push_back({{file_.string(), 0, 0}, why});
    return {};
  }

  /// False if the file's share of problems is full.
  bool report(int column, const std::string& message) {
    ++found_;
    if (found_ <= kMostProblems + 1)
      problems_.push_back({{file_.string(), line_, column},
                           found_ <= kMostProblems ? message : "from here on, more is wrong than is listed"});
    return found_ <= kMostProblems;
  }

  /// False if no point can be read under it.
  bool read_header(std::string_view text) {
    const std::size_t before = found_;
    for (const Cell& cell : cells_of(text)) {
      const std::string name(cell.text);
      const auto known = std::find(names_.begin(), names_.end(), name);
      if (known == names_.end()) {
        report(cell.column, unknown_word("unknown column", name, names_));
      } else if (std::find(order_.begin(), order_.end(), known - names_.begin()) != order_.end()) {
        report(cell.column, fmt::format("the column {} is there already", in_quotes(name)));
      }
      order_.push_back(known - names_.begin());
    }
    for (std::size_t k = 0; k < names_.size(); ++k)
      if (found_ == before && std::find(order_.begin(), order_.end(), static_cast<std::ptrdiff_t>(k)) == order_.end())
        report(1, fmt::format("the column '{}' is missing; expected {}", names_[k], fmt::join(names_, ", ")));
    return found_ == before;
  }

  /// False if reading on is no use.
  bool read_point(std::string_view text) {
    if (points_.volume.size() == kMostPoints) return report(1, fmt::format("more than {} points", kMostPoints)), false;
    const std::vector<Cell> cells = cells_of(text);
    if (cells.size() != order_.size())
      return report(1, fmt::format("expected {} values, found {}", order_.size(), cells.size()));
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto k = static_cast<std::size_t>(order_[c]);
      const auto value = number_in(cells[c].text);
      bool more = true;
      if (!value) {
        more = report(cells[c].column,
                      fmt::format("{}: expected a finite number, found {}", names_[k], in_quotes(cells[c].text)));
      } else if (k == min_.size()) {
        if (!(*value > 0))
          more = report(cells[c].column, fmt::format("volume: must be greater than 0, not {}", *value));
        points_.volume.push_back(*value);
      } else {
        more = add_coordinate(k, *value, cells[c].column);
      }
      if (!more) return false;
    }
    return true;
  }

  bool add_coordinate(std::size_t axis, double value, int column) {
    constexpr double rounding = 1e-12;  // as a share of the box and its distance from the origin
    const double low = min_[axis], high = max_[axis];
    const double slack =
        std::isfinite(high - low) ? rounding * std::max({high - low, std::abs(low), std::abs(high)}) : 0;
    points_.x[axis].push_back(std::clamp(value, low, high));
    if (value >= low - slack && value <= high + slack) return true;
    return report(column, fmt::format("{} = {} lies outside the grid, {} to {}", names_[axis], value, low, high));
  }

  const std::filesystem::path& file_;
  const std::vector<double>&min_, &max_;
  std::vector<Mistake>& problems_;
  std::vector<std::string> names_;     // the names of the columns: the coordinates, then volume
  std::vector<std::ptrdiff_t> order_;  // which of them each column of the file is
  PointFile points_;
  int line_ = 1;
  std::size_t found_ = 0;  // problems
};

}  // namespace

PointFile read_point_file(const std::filesystem::path& file, const std::vector<double>& min,
                          const std::vector<double>& max, std::vector<Mistake>& problems) {
  return Reader(file, min, max, problems).read();
}

}  // namespace stillpoint
