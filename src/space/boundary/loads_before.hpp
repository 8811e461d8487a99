// Where the parts of loads that go on from one stage to the next are among those that the stage before has saved:
// others have ended with it, or begin now.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace stillpoint {

class LoadsBefore {
 public:
  /// Saves the number in the scene of the load of each part, or expects them again.
  static void archive_numbers(const StateArchive& state, const std::vector<std::size_t>& numbers) {
    std::vector<std::size_t> same = numbers;
    state("numbers", same);
    if (same != numbers) throw StateError("it has other loads than the scene");
  }

  /// state: of the stage before; numbers: those of the parts that there are now.
  LoadsBefore(const StateArchive& state, const std::vector<std::size_t>& numbers) : place_(numbers.size()) {
    std::vector<std::size_t> before;
    state("numbers", before);
    count_ = before.size();
    const auto by_number = [](const std::vector<std::size_t>& of) {
      std::map<std::size_t, std::vector<std::size_t>> parts;
      for (std::size_t k = 0; k < of.size(); ++k) parts[of[k]].push_back(k);
      return parts;
    };
    const auto then = by_number(before);
    for (const auto& [number, parts] : by_number(numbers)) {
      const auto same = then.find(number);
      if (same == then.end()) continue;
      if (same->second.size() != parts.size()) throw StateError("a load has other parts than in the stage before");
      for (std::size_t k = 0; k < parts.size(); ++k) place_[parts[k]] = same->second[k];
    }
  }

  /// The place of part k among those before; empty: its load begins now.
  std::optional<std::size_t> place_of(std::size_t k) const { return place_[k]; }
  /// The values of a place of a list that has as many for each.
  template <std::size_t N>
  void copy_to(std::array<double, N>& to, const std::vector<double>& list, std::size_t place) const {
    if (list.size() != N * count_) throw StateError("loads and what they remember differ in number");
    std::copy_n(list.begin() + static_cast<std::ptrdiff_t>(N * place), N, to.begin());
  }

 private:
  std::size_t count_ = 0;                          // the number of parts before
  std::vector<std::optional<std::size_t>> place_;  // of each part now
};

}  // namespace stillpoint
