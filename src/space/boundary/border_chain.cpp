#include "space/boundary/border_chain.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace stillpoint {
namespace {

double way(const Point<2>& a, const Point<2>& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }
Point<2> middle(const Point<2>& a, const Point<2>& b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}; }

/// The mirror image at a face, or beyond a free end as far as the neighbour is on this side of it.
Point<2> beyond(const FaceEnd& end, const Point<2>& x, const Point<2>& neighbour) {
  Point<2> image = {2 * x[0] - neighbour[0], 2 * x[1] - neighbour[1]};
  if (!end.is_there()) return image;
  image = x;
  image[static_cast<std::size_t>(end.axis)] = 2 * end.at - x[static_cast<std::size_t>(end.axis)];
  return image;
}

/// Halfway between x and a face, on the line from the neighbour through x, but no steeper than three to one.
Point<2> between_face_and(const FaceEnd& end, const Point<2>& x, const Point<2>& neighbour) {
  constexpr double steepest = 3;
  const auto d = static_cast<std::size_t>(end.axis), along = 1 - d;
  const double step = (end.at - x[d]) / 2, rise = (x[along] - neighbour[along]) / (x[d] - neighbour[d]);
  Point<2> between = x;
  between[d] += step;
  if (std::isfinite(rise)) between[along] += std::clamp(rise, -steepest, steepest) * step;
  return between;
}

}  // namespace

template <Kinematics K>
auto BorderChain<K>::links_of(std::vector<LinkedPatch>& patches) -> Links {
  Links links;
  for (LinkedPatch& patch : patches)
    for (Link& link : patch.links) links.push_back(&link);
  return links;
}

template <Kinematics K>
Point<2> BorderChain<K>::before(const Links& links, std::size_t i) const {
  if (i > 0) return links[i - 1]->piece.at.x;
  if (closed_) return links.back()->piece.at.x;
  return beyond(ends_[0], links[0]->piece.at.x, links[1]->piece.at.x);
}

template <Kinematics K>
Point<2> BorderChain<K>::after(const Links& links, std::size_t i) const {
  const std::size_t last = links.size() - 1;
  if (i < last) return links[i + 1]->piece.at.x;
  if (closed_) return links.front()->piece.at.x;
  return beyond(ends_[1], links[last]->piece.at.x, links[last - 1]->piece.at.x);
}

// Not the first or the last piece of the chain, nor two that are neighbours, nor the only one of a patch.
template <Kinematics K>
bool BorderChain<K>::leave_out(std::vector<LinkedPatch>& patches) const {
  constexpr double shortest = 0.375;  // of the undeformed length
  const Links links = links_of(patches);
  std::vector<const Link*> out;
  for (std::size_t i = 1; i + 1 < links.size(); ++i) {
    const Point<2>& x = links[i]->piece.at.x;
    if (way(before(links, i), x) + way(x, after(links, i)) < 2 * shortest * links[i]->length) {
      out.push_back(links[i]);
      ++i;
    }
  }
  bool some = false;
  for (LinkedPatch& patch : patches) {
    std::vector<Link> kept;
    for (std::size_t i = 0; i < patch.links.size(); ++i) {
      const bool goes =
          std::ranges::find(out, &patch.links[i]) != out.end() && kept.size() + patch.links.size() - i > 1;
      if (!goes) kept.push_back(patch.links[i]);
      some = some || goes;
    }
    patch.links = std::move(kept);
  }
  return some;
}

template <Kinematics K>
bool BorderChain<K>::put_between(std::vector<LinkedPatch>& patches) const {
  const Links links = links_of(patches);
  const auto between = [](const Link& a, const Link& b, const Point<2>& x) {
    Link link = a;
    link.piece.at.x = x;
    link.piece.X = middle(a.piece.X, b.piece.X);
    link.piece.area = (a.piece.area + b.piece.area) / 2;
    link.length = (a.length + b.length) / 2;
    link.origin.piece[1] = b.origin.piece[1];
    link.origin.patch[1] = b.origin.patch[1];
    return link;
  };
  bool some = false;
  std::size_t i = 0;
  std::vector<LinkedPatch> next;
  for (const LinkedPatch& patch : patches) {
    const double longest = longest_ * patch.cell;
    LinkedPatch& cut = next.emplace_back(LinkedPatch{patch.cell, patch.depth, {}});
    const auto put = [&](const Link& link) { cut.links.push_back(link), some = true; };
    for (const Link& link : patch.links) {
      const Point<2>& x = link.piece.at.x;
      const bool first = i == 0 && !closed_, last = i + 1 == links.size() && !closed_;
      if (first && ends_[0].is_there() && way(before(links, 0), x) > 2 * longest)
        put(between(link, link, between_face_and(ends_[0], x, links[1]->piece.at.x)));
      cut.links.push_back(link);
      if (last) {
        if (ends_[1].is_there() && way(x, after(links, i)) > 2 * longest)
          put(between(link, link, between_face_and(ends_[1], x, links[i - 1]->piece.at.x)));
      } else if (way(x, after(links, i)) > longest) {
        const Link& other = *links[i + 1 < links.size() ? i + 1 : 0];
        put(between(link, other, middle(x, other.piece.at.x)));
      }
      ++i;
    }
  }
  patches = std::move(next);
  return some;
}

// The normal stays on its side.
template <Kinematics K>
void BorderChain<K>::measure(std::vector<LinkedPatch>& patches) const {
  const Links links = links_of(patches);
  std::size_t i = 0;
  for (LinkedPatch& patch : patches) {
    for (Link& link : patch.links) {
      const Point<2>&x = link.piece.at.x, from = before(links, i), to = after(links, i);
      const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * x[0] : patch.depth;
      const double chord = way(from, to), area = depth * (way(from, x) + way(x, to)) / 2;
      const Point<2> normal = {to[1] - from[1], from[0] - to[0]};
      auto& vector = link.piece.vector;
      const double side = normal[0] * vector[0] + normal[1] * vector[1] < 0 ? -1 : 1;
      if (chord > 0) vector = {side * area * normal[0] / chord, side * area * normal[1] / chord};
      ++i;
    }
  }
}

template <Kinematics K>
void BorderChain<K>::divide_and_join(std::vector<LinkedPatch>& patches) const {
  constexpr double longest = 1.5, shortest = 0.4;  // [cells]
  const auto length_of = [](const Link& link, const LinkedPatch& patch) {
    const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * link.piece.at.x[0] : patch.depth;
    return std::hypot(link.piece.vector[0], link.piece.vector[1]) / depth;
  };
  const auto length = [&](const LinkedPatch& patch) {
    double sum = 0;
    for (const Link& link : patch.links) sum += length_of(link, patch);
    return sum;
  };
  std::vector<LinkedPatch> next;
  for (LinkedPatch& patch : patches) {
    const double whole = length(patch);
    if (!next.empty() && std::min(whole, length(next.back())) < shortest * patch.cell) {
      std::ranges::move(patch.links, std::back_inserter(next.back().links));
      continue;
    }
    const double part = whole > longest * patch.cell ? whole / std::round(whole / patch.cell) : whole;
    double sum = part;
    for (Link& link : patch.links) {
      if (sum >= part) next.push_back({patch.cell, patch.depth, {}}), sum = 0;
      sum += length_of(link, patch);
      next.back().links.push_back(link);
    }
  }
  patches = std::move(next);
}

template <Kinematics K>
bool BorderChain<K>::cut(std::vector<LinkedPatch>& patches) const {
  constexpr std::size_t fewest = 3;  // pieces with neighbours to measure by
  if (links_of(patches).size() < fewest) return false;
  bool changed = leave_out(patches);
  changed = put_between(patches) || changed;
  measure(patches);
  if (changed) divide_and_join(patches);
  return changed;
}

template class BorderChain<Kinematics::plane>;
template class BorderChain<Kinematics::axisymmetric>;

}  // namespace stillpoint
