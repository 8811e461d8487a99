#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace stillpoint {
namespace {

// What other programs call things, in lower case.
constexpr std::array<std::pair<std::string_view, std::string_view>, 56> other_words{{
    {"gravity", "body_force"},
    {"gravitation", "body_force"},
    {"g", "body_force"},
    {"solver", "solve"},
    {"boundary", "support"},
    {"boundary_condition", "support"},
    {"bc", "support"},
    {"dirichlet", "support"},
    {"constraint", "support"},
    {"neumann", "traction"},
    {"pressure", "traction"},
    {"surface_load", "traction"},
    {"mesh", "grid"},
    {"domain", "grid"},
    {"geometry", "body"},
    {"time", "stop"},
    {"parameters", "constants"},
    {"variables", "constants"},
    {"obstacle", "rigid"},
    {"tolerance", "residual"},
    {"tol", "residual"},
    {"max_steps", "steps"},
    {"iterations", "steps"},
    {"sigma", "stress"},
    {"s", "stress"},
    {"epsilon", "strain"},
    {"eps", "strain"},
    {"displacement", "u"},
    {"disp", "u"},
    {"velocity", "v"},
    {"vel", "v"},
    {"young", "E"},
    {"youngs_modulus", "E"},
    {"poisson", "nu"},
    {"density", "rho"},
    {"cohesion", "c"},
    {"friction_angle", "phi"},
    {"dilation_angle", "psi"},
    {"diagonal", "lumped"},
    {"clamped", "fixed"},
    {"pinned", "fixed"},
    {"encastre", "fixed"},
    {"sliding", "roller"},
    {"north", "top"},
    {"south", "bottom"},
    {"east", "right"},
    {"west", "left"},
    {"critical", "viscous"},
    {"rayleigh", "viscous"},
    {"flac", "cundall"},
    {"von-mises", "drucker-prager"},
    {"tresca", "mohr-coulomb"},
    {"explicit", "leapfrog"},
    {"verlet", "leapfrog"},
    {"runge-kutta", "erk:rk4"},
    {"dormand-prince", "erk:dormand-prince-7-4-5"},
}};

std::string lower_case(std::string word) {
  for (char& letter : word)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return word;
}

/// The number of letters to insert, delete, change or swap with a neighbour that turns a into b (restricted
/// Damerau–Levenshtein distance).
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

// The candidate for which a word stands elsewhere, or whose end it is; empty if there is none.
std::string meant_by(const std::string& word, const std::vector<std::string>& candidates) {
  const auto there = [&](const std::string& candidate) {
    return std::ranges::find(candidates, candidate) != candidates.end();
  };
  const auto by_end = std::ranges::find_if(candidates, [&](const std::string& candidate) {
    return candidate.size() > word.size() + 1 && candidate.ends_with(lower_case(word)) &&
           std::string_view(".:-").find(candidate[candidate.size() - word.size() - 1]) != std::string_view::npos;
  });
  if (!word.empty() && by_end != candidates.end()) return *by_end;
  // A component may be written in many ways: sigma_yy, sigma.yy, sigmayy.
  const std::string lower = lower_case(word);
  for (const auto& [elsewhere, here] : other_words) {
    if (!lower.starts_with(elsewhere)) continue;
    std::string rest = lower.substr(elsewhere.size());
    if (!rest.empty() && (rest.front() == '_' || rest.front() == '.' || rest.front() == '-')) rest.erase(0, 1);
    std::string meant = rest.empty() ? std::string(here) : fmt::format("{}.{}", here, rest);
    if (there(meant)) return meant;
  }
  return {};
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\x{:02x}", code);
    } else {
      result += letter;
    }
  }
  return result;
}

std::string counted(std::size_t number, std::string_view what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  text = text.substr(0, longest);
  // A UTF-8 character is never cut in its middle.
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.remove_suffix(1);
  if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0xC0) text.remove_suffix(1);
  return std::string(text) + "…";
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t longest = 80;
  return fmt::format("'{}'", one_line(shortened(word, longest)));
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 100;  // longer words are not typing errors
  constexpr std::size_t most = 1000;    // a search among more would take long
  if (word.size() > longest || candidates.size() > most) return {};
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

std::string unknown_word(const std::string& what, const std::string& word, const std::vector<std::string>& candidates) {
  const std::string said = fmt::format("{} {}", what, in_quotes(word));
  std::string meant = nearest(word, candidates);
  if (meant.empty()) meant = meant_by(word, candidates);
  if (!meant.empty()) return fmt::format("{}; did you mean '{}'?", said, meant);
  constexpr std::size_t most = 30;
  const auto shown = static_cast<std::ptrdiff_t>(std::min(most, candidates.size()));
  return candidates.empty()
             ? said
             : fmt::format("{}; expected one of {}{}", said,
                           fmt::join(candidates.begin(), candidates.begin() + shown, ", "),
                           candidates.size() > most ? fmt::format(" … ({} in all)", candidates.size()) : "");
}

bool is_plain_word(std::string_view name) {
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  return !name.empty() && is_letter(name.front()) &&
         std::ranges::all_of(name, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-'; });
}

}  // namespace stillpoint
