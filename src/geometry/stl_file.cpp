#include "geometry/stl_file.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.hpp"

namespace stillpoint {
namespace {

constexpr std::size_t kMostTriangles = 5'000'000;

// 80 bytes of title, the number of triangles, and for each of them 12 floats, of which the first 3 are a normal, and
// 2 bytes; little-endian.
constexpr std::size_t kTitle = 80, kHeader = 84, kNormal = 12, kTriangle = 50;

template <class T>
T number_at(std::string_view bytes, std::size_t at) {
  static_assert(std::endian::native == std::endian::little);
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

class StlReader {
 public:
  StlReader(const std::filesystem::path& file, std::vector<Mistake>& problems) : file_(file), problems_(problems) {}

  std::vector<Facet> read() {
    std::error_code error;
    if (!std::filesystem::exists(file_, error)) return refuse("there is no such file");
    if (!std::filesystem::is_regular_file(file_, error)) return refuse("is not a file of triangles");
    std::ifstream stream(file_, std::ios::binary);
    if (!stream) return refuse("cannot be opened for reading");
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (bytes.empty()) return refuse("is empty");
    if (!(is_binary(bytes) ? read_binary(bytes) : read_ascii(bytes))) return {};
    if (triangles_.empty()) return refuse("holds no triangles");
    return check() ? std::move(triangles_) : std::vector<Facet>{};
  }

 private:
  std::vector<Facet> refuse(const std::string& why) { return add({file_.string(), 0, 0}, why), triangles_; }
  bool wrong(const std::string& why) { return add({file_.string(), 0, 0}, why), false; }
  void add(Location where, const std::string& why) {
    problems_.push_back({std::move(where), why});
    triangles_.clear();
  }

  /// Some programs begin a binary title with "solid" too; text has no zero bytes.
  static bool is_binary(std::string_view bytes) {
    if (bytes.size() >= kHeader && bytes.size() == kHeader + kTriangle * number_at<std::uint32_t>(bytes, kTitle))
      return true;
    const bool has_zeros = bytes.substr(0, 4 * kHeader).find('\0') != std::string_view::npos;
    return has_zeros || !(bytes.starts_with("solid") || bytes.starts_with("SOLID"));
  }

  bool read_binary(std::string_view bytes) {
    if (bytes.size() < kHeader)
      return wrong("is no STL file: neither text that begins with 'solid', nor long enough for the binary form");
    const std::size_t count = number_at<std::uint32_t>(bytes, kTitle);
    if (bytes.size() != kHeader + kTriangle * count)
      return wrong(
          fmt::format("is not whole, or no STL file: as a binary one of {} triangles it would have {} bytes, not {}",
                      count, kHeader + kTriangle * count, bytes.size()));
    if (count > kMostTriangles) return wrong(too_many());
    for (std::size_t t = 0; t < count; ++t) {
      Facet triangle;
      for (std::size_t k = 0; k < 9; ++k) {
        const auto value = number_at<float>(bytes, kHeader + kTriangle * t + kNormal + sizeof(float) * k);
        if (!std::isfinite(value))
          return wrong(fmt::format("a coordinate of triangle {} of {} is not a finite number", t + 1, count));
        triangle[k / 3][k % 3] = value + 0.0;  // −0 is 0
      }
      triangles_.push_back(triangle);
    }
    return true;
  }

  static std::string too_many() { return fmt::format("more than {} triangles", kMostTriangles); }

  // --- text ---

  bool at_word(const std::string& why) {
    const auto begin_of_line = text_.rfind('\n', word_at_ == 0 ? 0 : word_at_ - 1);
    const std::size_t begin = begin_of_line == std::string_view::npos || word_at_ == 0 ? 0 : begin_of_line + 1;
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
    add({file_.string(), static_cast<int>(line), static_cast<int>(word_at_ - begin) + 1}, why);
    return false;
  }
  /// Empty at the end of the file.
  std::string_view next_word() {
    constexpr std::string_view spaces = " \t\r\n\v\f";
    word_at_ = std::min(text_.find_first_not_of(spaces, at_), text_.size());
    at_ = std::min(text_.find_first_of(spaces, word_at_), text_.size());
    return text_.substr(word_at_, at_ - word_at_);
  }
  std::string_view next_lower_word() {
    lower_ = next_word();
    std::ranges::transform(lower_, lower_.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return lower_;
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }

  bool expect(std::initializer_list<std::string_view> words) {
    for (const std::string_view word : words)
      if (next_lower_word() != word) return unexpected(fmt::format("'{}'", word));
    return true;
  }
  bool unexpected(const std::string& expected) {
    const std::string_view found = text_.substr(word_at_, at_ - word_at_);
    return at_word(found.empty() ? fmt::format("the file ends here; expected {}", expected)
                                 : fmt::format("expected {}, found {}", expected, in_quotes(found)));
  }
  std::optional<double> next_number() {
    std::string_view word = next_word();
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      return unexpected("a finite number"), std::nullopt;
    return value + 0.0;
  }

  // solid title, any number of: facet normal . . . outer loop vertex . . . (three times) endloop endfacet; endsolid
  // title. Some programs write several solids one after the other.
  bool read_ascii(std::string_view text) {
    text_ = text;
    for (int solids = 0;; ++solids) {
      const std::string_view word = next_lower_word();
      if (word.empty() && solids > 0) return true;
      if (word != "solid") return unexpected("'solid'");
      skip_line();
      if (!read_facets()) return false;
      skip_line();
    }
  }
  bool read_facets() {
    while (true) {
      const std::string_view word = next_lower_word();
      if (word == "endsolid") return true;
      if (word != "facet") return unexpected("'facet' or 'endsolid'");
      if (!expect({"normal"})) return false;
      for (int k = 0; k < 3; ++k) next_word();  // whatever it says
      if (!expect({"outer", "loop"})) return false;
      Facet triangle;
      for (SpacePoint& corner : triangle) {
        if (!expect({"vertex"})) return false;
        for (double& x : corner) {
          const std::optional<double> value = next_number();
          if (!value) return false;
          x = *value;
        }
      }
      if (!expect({"endloop", "endfacet"})) return false;
      if (triangles_.size() == kMostTriangles) return at_word(too_many());
      triangles_.push_back(triangle);
    }
  }

  // --- what it is the surface of ---

  bool check() {
    if (const auto edge = open_edge(triangles_))
      return wrong(fmt::format(
          "is not closed: the edge from ({:.9g}) to ({:.9g}) has no triangle, or one that is wound the other way, on "
          "one of its sides",
          fmt::join(edge->from, ", "), fmt::join(edge->to, ", ")));
    SpacePoint low = triangles_[0][0], high = low;
    for (const Facet& triangle : triangles_) {
      for (const SpacePoint& corner : triangle) {
        for (std::size_t d = 0; d < 3; ++d) {
          low[d] = std::min(low[d], corner[d]);
          high[d] = std::max(high[d], corner[d]);
        }
      }
    }
    constexpr double rounding = 1e-9;
    const double box = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
    const double volume = std::abs(signed_volume(triangles_));
    if (!std::isfinite(box)) return wrong("its coordinates are too large");
    if (!(volume > rounding * box) || !(box > 0)) return wrong("encloses no volume");
    return true;
  }

  const std::filesystem::path& file_;
  std::vector<Mistake>& problems_;
  std::vector<Facet> triangles_;
  std::string_view text_;
  std::size_t at_ = 0, word_at_ = 0;
  std::string lower_;
};

}  // namespace

std::vector<Facet> read_stl_file(const std::filesystem::path& file, std::vector<Mistake>& problems) {
  return StlReader(file, problems).read();
}

}  // namespace stillpoint
