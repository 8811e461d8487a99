#include "space/grid/cut_cells.hpp"

#include <utility>
#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

const Grid<1> even_line{{Axis::uniform(0, 5, 5)}};
const Grid<2> even_plane{{Axis::uniform(0, 4, 4), Axis::uniform(0, 3, 3)}};
const auto any = [](int, int) { return true; };

using Shares = std::vector<CellShares>;

CellShares of(const std::vector<double>& cells) {
  CellShares shares;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c] > 0) shares.emplace_back(static_cast<int>(c), cells[c]);
  }
  return shares;
}

}  // namespace

TEST_CASE("a sliver takes the functions of the cell next to it that has its part of the body") {
  for (const auto& [shares, host] : {std::pair{Shares{of({1, 1, 0.1, 0, 0})}, 1}, {Shares{of({0, 0, 0.1, 1, 1})}, 3}}) {
    const CutCells<1> cut(even_line, shares, 1);
    CHECK(cut.slivers() == std::vector<int>{2});
    CHECK(cut.host_of(2, any) == host);
  }
}

TEST_CASE("cells that parts of the body fill together are no slivers") {
  const Shares none;
  CHECK(CutCells<1>(even_line, Shares{of({1, 1, 0.1, 0, 0}), of({0, 0, 0.9, 1, 1})}, 3).slivers().empty());
  CHECK(CutCells<1>(even_line, none, 3).slivers().empty());
}

TEST_CASE("a sliver that joins two parts of a body stays a bridge between them, however long") {
  const Shares bridge = {of({1, 1, 0.1, 1, 1})}, bridges = {of({1, 0.1, 0.2, 0.1, 1})};
  CHECK(CutCells<1>(even_line, bridge, 1).host_of(2, any) == 2);
  const CutCells<1> longer(even_line, bridges, 1);
  for (const int sliver : longer.slivers()) CHECK(longer.host_of(sliver, any) == sliver);
}

TEST_CASE("a tip that is thin in two cells takes the functions of the last good one in both") {
  const Shares shares = {of({1, 1, 0.2, 0.1, 0})};
  const CutCells<1> tip(even_line, shares, 1);
  CHECK(tip.slivers() == std::vector<int>{2, 3});
  CHECK(tip.host_of(2, any) == 1);
  CHECK(tip.host_of(3, any) == 1);
}

TEST_CASE("slivers along two faces of a block take the cell behind their face, and the corner the one behind it") {
  const double e = 0.01;
  const Shares shares = {of({1, 1, e, 0,  //
                             1, 1, e, 0,  //
                             e, e, e * e, 0})};
  const CutCells<2> cut(even_plane, shares, 2);
  CHECK(cut.slivers() == std::vector<int>{2, 6, 8, 9, 10});
  CHECK(cut.host_of(2, any) == 1);
  CHECK(cut.host_of(6, any) == 5);
  CHECK(cut.host_of(8, any) == 4);
  CHECK(cut.host_of(9, any) == 5);
  CHECK(cut.host_of(10, any) == 5);
}

TEST_CASE("a sliver keeps its own functions where nothing may host it") {
  const Shares shares = {of({1, 1, 0.1, 0, 0})}, thin = {of({0.1, 0.1, 0.1, 0, 0})};
  CHECK(CutCells<1>(even_line, shares, 1).host_of(2, [](int, int) { return false; }) == 2);
  CHECK(CutCells<1>(even_line, thin, 1).host_of(1, any) == 1);
}

TEST_CASE("the functions of a basis of degree 3 need more of a cell than those of 1 and 2") {
  const Shares shares = {of({1, 1, 0.4, 0, 0})};
  CHECK(CutCells<1>(even_line, shares, 1).slivers().empty());
  CHECK(CutCells<1>(even_line, shares, 2).slivers().empty());
  CHECK(CutCells<1>(even_line, shares, 3).slivers() == std::vector<int>{2});
}
