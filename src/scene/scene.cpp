#include <stillpoint/scene.hpp>

#include <algorithm>
#include <numeric>
#include <string_view>

#include <fmt/format.h>

namespace stillpoint {
namespace {

std::string all_of(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "\n", to_string(problem.where), problem.message);
  return text;
}

std::string lower_case(std::string word) {
  for (char& letter : word)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return word;
}

/// The number of letters to insert, delete, change or swap with their neighbour that make a into b
/// (restricted Damerau–Levenshtein distance).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

}  // namespace

std::string_view to_string(StressState state) {
  switch (state) {
    case StressState::uniaxial_stress:
      return "uniaxial-stress";
    case StressState::uniaxial_strain:
      return "uniaxial-strain";
    case StressState::plane_strain:
      return "plane-strain";
    case StressState::plane_stress:
      return "plane-stress";
    case StressState::axisymmetric:
      return "axisymmetric";
  }
  return "";
}

std::string to_string(const Location& where) {
  return where.line > 0 ? fmt::format("{}:{}:{}", where.file, where.line, where.column) : where.file;
}

SceneError::SceneError(std::vector<Problem> problems)
    : std::runtime_error(all_of(problems)), problems_(std::move(problems)) {}

Location Scene::location(const std::string& key) const {
  for (std::string around = key; !around.empty();) {
    if (const auto found = where.find(around); found != where.end()) return found->second;
    // "support[0].at" lies in "support[0]", which lies in "support".
    const auto end = around.find_last_of(".[");
    around.resize(end == std::string::npos ? 0 : end);
  }
  return {file.string(), 0, 0};
}

std::vector<std::string> probe_fields(int dim) {
  if (dim == 1) return {"u", "v", "strain", "stress"};
  return {"u.x",       "u.y",       "v.x",       "v.y",       "stress.xx", "stress.yy",     "stress.zz",
          "stress.xy", "strain.xx", "strain.xy", "strain.yx", "strain.yy", "plastic_strain"};
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 100;  // longer words are no slips of the pen
  if (word.size() > longest) return {};
  // A third of the letters may differ, but never all of them.
  std::size_t best = word.size() < 2 ? 1 : std::min(word.size(), std::max<std::size_t>(2, word.size() / 3 + 1));
  std::string result;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest) continue;
    const std::size_t distance = edit_distance(lower_case(word), lower_case(candidate));
    if (distance < best) {
      best = distance;
      result = candidate;
    }
  }
  return result;
}

}  // namespace stillpoint
