// A border that is cut anew as it stretches and shrinks.
#include "space/boundary/border_chain.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace stillpoint::test {
namespace {

constexpr Kinematics plane = Kinematics::plane;
using Chain = BorderChain<plane>;
using Patches = std::vector<Chain::LinkedPatch>;

/// Pieces at these positions, two to a patch, of cells of length 1; each half a cell long at first, below the body.
Patches patches_at(const std::vector<Point<2>>& positions) {
  Patches patches;
  for (std::size_t s = 0; s < positions.size(); ++s) {
    if (s % 2 == 0) patches.push_back({1, 1, {}});
    const std::size_t patch = patches.size() - 1;
    patches.back().links.push_back(
        {BorderPiece<plane>::make(positions[s], 0.5, {0, -1}), 0.5, {{s, s}, {patch, patch}}});
  }
  return patches;
}
Patches on_a_line(std::size_t count, double first, double apart) {
  std::vector<Point<2>> positions;
  for (std::size_t s = 0; s < count; ++s) positions.push_back({first + static_cast<double>(s) * apart, 0});
  return patches_at(positions);
}

struct Measures {
  std::size_t count = 0;
  double length = 0, furthest = 0, longest_patch = 0, shortest_patch = 1e9;
};
Measures measures_of(const Patches& patches) {
  Measures all;
  const Chain::Link* before = nullptr;
  for (const auto& patch : patches) {
    double length = 0;
    for (const auto& link : patch.links) {
      ++all.count;
      length += link.piece.size();
      const Point<2>& x = link.piece.at.x;
      if (before)
        all.furthest = std::max(all.furthest, std::hypot(x[0] - before->piece.at.x[0], x[1] - before->piece.at.x[1]));
      before = &link;
    }
    all.length += length;
    all.longest_patch = std::max(all.longest_patch, length);
    all.shortest_patch = std::min(all.shortest_patch, length);
  }
  return all;
}
void cut_to_the_end(const Chain& chain, Patches& patches) {
  for (int k = 0; k < 20; ++k)
    if (!chain.cut(patches)) return;
  FAIL("a border is cut anew for ever");
}

}  // namespace

TEST_CASE("a border as it was at first is left as it is") {
  Patches patches = on_a_line(8, 0.25, 0.5);
  CHECK_FALSE(Chain(false, {}, 0.75).cut(patches));
  CHECK(measures_of(patches).length == Approx(4));
  CHECK(patches[1].links[0].piece.vector[1] == Approx(-0.5));
}

TEST_CASE("a border that is drawn to five times its length gets pieces and patches, and keeps the sum of its areas") {
  Patches patches = on_a_line(8, 1.25, 2.5);
  cut_to_the_end(Chain(false, {}, 0.75), patches);
  const Measures all = measures_of(patches);
  CHECK(all.furthest <= 0.75);
  CHECK(all.length == Approx(7 * 2.5 + 2.5 / 4));  // the ends of a free border are as far off as half a way to the next
  CHECK(all.longest_patch <= 1.5 + 0.75);
  CHECK(all.shortest_patch >= 0.4);
}

TEST_CASE("a piece between two others comes from both") {
  Patches patches = on_a_line(4, 0, 1);
  REQUIRE(Chain(false, {}, 0.75).cut(patches));
  const auto& link = patches[0].links[1];
  CHECK(link.piece.at.x[0] == Approx(0.5));
  CHECK(link.origin.piece == std::array<std::size_t, 2>{0, 1});
  CHECK(link.length == Approx(0.5));
}

TEST_CASE("a closed border that is drawn together to a fifth loses pieces, and its sum of areas stays what it is") {
  constexpr std::size_t count = 24;
  const double radius = static_cast<double>(count) * 0.5 / (2 * std::acos(-1.0)) / 5;
  std::vector<Point<2>> positions;
  for (std::size_t s = 0; s < count; ++s) {
    const double angle = 2 * std::acos(-1.0) * static_cast<double>(s) / count;
    positions.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  Patches patches = patches_at(positions);
  cut_to_the_end(Chain(true, {}, 0.75), patches);
  const Measures all = measures_of(patches);
  CHECK(all.count <= count / 2);
  CHECK(all.length == Approx(2 * std::acos(-1.0) * radius).epsilon(0.1));  // by chords
  CHECK(all.shortest_patch > 0);
}

TEST_CASE("a border that is drawn away from a plane of symmetry reaches it") {
  std::array<FaceEnd, 2> ends;
  ends[0] = {0, 0.0};
  Patches patches = patches_at({{3, 0.3}, {3.5, 0.35}, {4, 0.4}, {4.5, 0.45}});
  cut_to_the_end(Chain(false, ends, 0.75), patches);
  const Measures all = measures_of(patches);
  const Point<2>& first = patches[0].links[0].piece.at.x;
  CHECK(first[0] <= 0.75);
  CHECK(first[1] == Approx(0.1 * first[0]));  // on the line of the border
  CHECK(all.furthest <= 1.5 * 0.75);
  CHECK(all.length == Approx(4.75 * std::hypot(1, 0.1)).epsilon(0.01));
}

}  // namespace stillpoint::test
