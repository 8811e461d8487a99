#include "space/phase/free_parts.hpp"

#include <map>
#include <numeric>
#include <utility>

namespace stillpoint {

template <int Dim>
std::vector<FreePart> find_free_parts(const BodyOnGrid<Dim>& body, int first_axis, const DegreesOfFreedom& dofs,
                                      const std::vector<char>& sprung, bool as_one) {
  const auto& [functions, points, weights] = body;
  const int per_cell = functions.per_cell();
  constexpr int nowhere = -1;
  // Functions of one cell belong to one part (a union-find structure): each points to another of its part, the first to
  // itself.
  std::vector<int> next(dofs.number.size() / Dim);
  std::iota(next.begin(), next.end(), 0);
  const auto first_of = [&next](int f) {
    while (next[static_cast<std::size_t>(f)] != f) {
      int& to = next[static_cast<std::size_t>(f)];
      f = to = next[static_cast<std::size_t>(to)];
    }
    return f;
  };
  int last = nowhere;
  for (std::size_t k = 0; k < points.cells(); ++k) {
    if (!as_one) last = nowhere;
    for (int a = 0; a < per_cell; ++a) {
      const int f = weights.function(k, a);
      dofs.for_sources(Dim * f, [&](int unknown, int, double) {
        const int source = unknown / Dim;
        if (last != nowhere) next[static_cast<std::size_t>(first_of(source))] = first_of(last);
        last = source;
      });
    }
  }

  struct Found {
    FreePart part;
    bool held = false;
  };
  std::map<std::pair<int, int>, Found> all;  // by first function and axis
  std::vector<char> seen(dofs.number.size(), 0);
  for (std::size_t k = 0; k < points.cells(); ++k) {
    for (int a = 0; a < per_cell; ++a) {
      const int f = weights.function(k, a);
      for (int i = first_axis; i < Dim && functions.is_value(f); ++i) {
        const auto unknown = static_cast<std::size_t>(Dim * f + i);
        const int dof = dofs.number[unknown];
        if (dof < 0 || dofs.is_extended(dof) || std::exchange(seen[unknown], 1)) continue;
        auto [found, is_new] = all.try_emplace({first_of(f), i});
        FreePart& part = found->second.part;
        if (is_new) part.axis = i, part.point = static_cast<std::size_t>(points.number[points.begin(k)]);
        if (!dofs.is_free(dof) || sprung[unknown]) found->second.held = true;
        part.unknowns.push_back(static_cast<std::size_t>(dof));
      }
    }
  }
  std::vector<FreePart> free;
  for (auto& [key, found] : all) {
    found.part.is_whole = all.begin()->first.first == all.rbegin()->first.first;
    if (!found.held) free.push_back(std::move(found.part));
  }
  return free;
}

template std::vector<FreePart> find_free_parts(const BodyOnGrid<1>&, int, const DegreesOfFreedom&,
                                               const std::vector<char>&, bool);
template std::vector<FreePart> find_free_parts(const BodyOnGrid<2>&, int, const DegreesOfFreedom&,
                                               const std::vector<char>&, bool);
template std::vector<FreePart> find_free_parts(const BodyOnGrid<3>&, int, const DegreesOfFreedom&,
                                               const std::vector<char>&, bool);

}  // namespace stillpoint
