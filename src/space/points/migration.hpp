// Points that go to other ranks with the cells that they lie in.
//
// In a run of one process the points of a cell are in the order in which they were before they moved on, by their cells
// of then. Those that come from another rank are put where they would be in that order: a cell was on one rank alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "parallel/of_all.hpp"
#include "space/points/body.hpp"
#include "space/points/point_order.hpp"
#include "space/points/rank_cells.hpp"

namespace stillpoint {

template <Kinematics K>
class Migration {
  static constexpr int dim = dimensions(K);

 public:
  /// All arguments must outlive this object.
  Migration(const Ranks& ranks, Body<K>& body) : ranks_(ranks), body_(body), points_(body.points) {}

  /// Shares out cells anew if a rank has many more points than others; cells: as in run().
  void even_out(RankCells<dim>& cells_of_ranks, const Grid<dim>& grid, const std::vector<int>& cells) const {
    if (is_uneven()) cells_of_ranks.share_out(joined_lists(&ranks_, points_of_cells(cells_of_ranks, grid, cells)));
  }
  /// Lets each point go to the rank of the cell that it lies in now; cells: their numbers in the grid, (points), which
  /// become those of the points that are here afterwards. The points are as they were sorted before they moved on, and
  /// have to be sorted anew.
  void run(const RankCells<dim>& cells_of_ranks, const Grid<dim>& grid, std::vector<int>& cells) {
    std::vector<int> rank(points_.size());
    for (std::size_t p = 0; p < rank.size(); ++p) rank[p] = cells_of_ranks.owner(grid.cell_at(cells[p]));
    if (!is_so_for_any(&ranks_, std::ranges::any_of(rank, [this](int to) { return to != ranks_.rank(); }))) return;
    exchange([&rank](std::size_t p, int to) { return rank[p] == to; }, cells);
  }

  /// Shares out the cells of the points, all of which each rank has, and leaves it with those of its own.
  void share_out(RankCells<dim>& cells_of_ranks, const Grid<dim>& grid) {
    cells_of_ranks.share_out(points_of_cells(cells_of_ranks, grid, cells_of_points()));
    keep_own(cells_of_ranks, grid);
  }
  /// Gives each rank the points of all, as one process would have them.
  void gather(const Grid<dim>& grid) {
    PointOrder<dim> order;
    order.cells() = cells_of_points();
    exchange([](std::size_t, int) { return true; }, order.cells());
    order.sort_by_cells(points_, grid);
  }
  /// Leaves each rank with those of its own cells.
  void keep_own(const RankCells<dim>& cells_of_ranks, const Grid<dim>& grid) {
    const std::vector<int> cells = cells_of_points();
    const std::vector<int> from = take_chosen(
        chosen_points([&](std::size_t p) { return cells_of_ranks.owner(grid.cell_at(cells[p])) == ranks_.rank(); }));
    take_materials(body_, from);
    PointOrder<dim> order;
    order.cells() = chosen(cells, from);
    order.sort_by_cells(points_, grid);
  }

 private:
  // The cell in which each point is listed.
  std::vector<int> cells_of_points() const {
    std::vector<int> cells(points_.size());
    for_points(points_, [&](std::size_t k, std::size_t p, std::size_t) { cells[p] = points_.cell[k]; });
    return cells;
  }

  // The points for which is_one(point) holds, of each material.
  template <class IsOne>
  std::vector<std::vector<int>> chosen_points(const IsOne& is_one) const {
    std::vector<std::vector<int>> all(points_.materials());
    for (std::size_t m = 0; m < all.size(); ++m)
      for (std::size_t p = begin_of(m); p < begin_of(m + 1); ++p)
        if (is_one(p)) all[m].push_back(static_cast<int>(p));
    return all;
  }
  // Replaces the points by those that are listed for each material; returns the lists, one after the other.
  std::vector<int> take_chosen(const std::vector<std::vector<int>>& of_materials) {
    std::vector<int> all, material_begin;
    for (const std::vector<int>& list : of_materials) {
      material_begin.push_back(static_cast<int>(all.size()));
      all.insert(all.end(), list.begin(), list.end());
    }
    material_begin.push_back(static_cast<int>(all.size()));
    points_.material_begin = std::move(material_begin);
    take_points(points_, all);
    return all;
  }
  // How many points are in the cells, those that follow each other in one cell together; cells: as in run().
  static std::vector<PointsOfCell> points_of_cells(const RankCells<dim>& cells_of_ranks, const Grid<dim>& grid,
                                                   const std::vector<int>& cells) {
    std::vector<PointsOfCell> all;
    for (const int cell : cells) {
      const std::int64_t place = cells_of_ranks.place(grid.cell_at(cell));
      if (all.empty() || all.back().place != place) all.push_back({place, 0});
      ++all.back().points;
    }
    return all;
  }
  bool is_uneven() const {
    double all = 0, most = 0;
    for (const double points : of_all(&ranks_, static_cast<double>(points_.size()))) {
      all += points;
      most = std::max(most, points);
    }
    return most > RankCells<dim>::most_over_mean * all / ranks_.count();
  }

  // Sends each rank the points that go(point, rank) to it, and keeps those that go to this one; cells: as in run().
  template <class Go>
  void exchange(const Go& go, std::vector<int>& cells) {
    std::vector<int> before = cells_of_points();
    std::vector<Bytes> to(static_cast<std::size_t>(ranks_.count()));
    for (int r = 0; r < ranks_.count(); ++r)
      if (r != ranks_.rank()) to[static_cast<std::size_t>(r)] = packed(go, r, before, cells);
    // In their new order; those from elsewhere follow ours.
    std::vector<std::vector<int>> from = chosen_points([&](std::size_t p) { return go(p, ranks_.rank()); });
    std::vector<std::vector<Rows>> memory(points_.materials());
    for (const Bytes& bytes : ranks_.deliver(to)) unpack(bytes, from, memory, before, cells);
    take(from, memory, before, cells);
  }

  // What the points of a material that come from one rank remember, (rows × points).
  using Rows = std::vector<double>;

  class Reader {
   public:
    explicit Reader(const Bytes& bytes) : bytes_(bytes) {}
    bool is_at_end() const { return at_ == bytes_.size(); }
    template <class T>
    std::vector<T> next() {
      std::size_t count = 0;
      copy(&count, sizeof(count));
      std::vector<T> values(count);
      if (count > 0) copy(values.data(), count * sizeof(T));
      return values;
    }

   private:
    void copy(void* to, std::size_t size) {
      std::memcpy(to, bytes_.data() + at_, size);
      at_ += size;
    }
    const Bytes& bytes_;
    std::size_t at_ = 0;
  };
  template <class T>
  static void write(const std::vector<T>& values, Bytes& to) {
    const std::size_t count = values.size(), begin = to.size();
    to.resize(begin + sizeof(count) + count * sizeof(T));
    std::memcpy(to.data() + begin, &count, sizeof(count));
    if (count > 0) std::memcpy(to.data() + begin + sizeof(count), values.data(), count * sizeof(T));
  }
  template <class T>
  static std::vector<T> chosen(const std::vector<T>& values, const std::vector<int>& which) {
    std::vector<T> some;
    if (values.empty()) return some;
    some.reserve(which.size());
    for (const int p : which) some.push_back(values[static_cast<std::size_t>(p)]);
    return some;
  }

  std::size_t begin_of(std::size_t m) const { return static_cast<std::size_t>(points_.material_begin[m]); }
  std::size_t count_of(std::size_t m) const { return begin_of(m + 1) - begin_of(m); }

  template <class Go>
  Bytes packed(const Go& go, int to, const std::vector<int>& before, const std::vector<int>& cells) {
    std::vector<int> all, of_material;
    for (const std::vector<int>& list : chosen_points([&](std::size_t p) { return go(p, to); })) {
      all.insert(all.end(), list.begin(), list.end());
      of_material.push_back(static_cast<int>(list.size()));
    }
    Bytes bytes;
    if (all.empty()) return bytes;
    write(of_material, bytes);
    write(chosen(before, all), bytes);
    write(chosen(cells, all), bytes);
    for_point_arrays(points_, [&](auto& values) { write(chosen(values, all), bytes); });
    auto next = all.begin();
    for (std::size_t m = 0; m < points_.materials(); ++m) {
      const Vec of_all = body_.materials[m]->memory();
      const auto end = next + of_material[m];
      Rows rows;
      for (std::size_t row = 0; row < body_.materials[m]->memory_rows(); ++row)
        for (auto p = next; p != end; ++p)
          rows.push_back(of_all[row * count_of(m) + static_cast<std::size_t>(*p) - begin_of(m)]);
      write(rows, bytes);
      next = end;
    }
    return bytes;
  }
  // Appends the points to those that are here.
  void unpack(const Bytes& bytes, std::vector<std::vector<int>>& from, std::vector<std::vector<Rows>>& memory,
              std::vector<int>& before, std::vector<int>& cells) {
    Reader reader(bytes);
    if (reader.is_at_end()) return;
    const auto of_material = reader.template next<int>();
    int next = static_cast<int>(before.size());
    for (std::size_t m = 0; m < of_material.size(); ++m)
      for (int k = 0; k < of_material[m]; ++k) from[m].push_back(next++);
    const auto append = [&reader]<class T>(std::vector<T>& values) {
      const auto more = reader.template next<T>();
      values.insert(values.end(), more.begin(), more.end());
    };
    append(before);
    append(cells);
    for_point_arrays(points_, append);
    for (std::size_t m = 0; m < of_material.size(); ++m) memory[m].push_back(reader.template next<double>());
  }
  // Puts the points in their order.
  void take(std::vector<std::vector<int>>& from, const std::vector<std::vector<Rows>>& memory,
            const std::vector<int>& before, std::vector<int>& cells) {
    std::vector<Rows> memory_now;
    for (std::size_t m = 0; m < from.size(); ++m) {
      // In what `memory` and the present memory have one after the other.
      std::vector<std::size_t> place(from[m].size());
      for (std::size_t k = 0; k < place.size(); ++k) place[k] = k;
      std::ranges::stable_sort(place, {}, [&](std::size_t k) { return before[static_cast<std::size_t>(from[m][k])]; });
      const std::size_t first = begin_of(m), end = begin_of(m + 1);
      std::size_t ours = 0;
      while (ours < from[m].size() && static_cast<std::size_t>(from[m][ours]) < end) ++ours;
      const std::size_t rows = body_.materials[m]->memory_rows();
      const Vec of_ours = body_.materials[m]->memory();
      Rows taken(rows * place.size());
      for (std::size_t row = 0; row < rows; ++row) {
        std::vector<double> pool;
        for (std::size_t k = 0; k < ours; ++k)
          pool.push_back(of_ours[row * count_of(m) + static_cast<std::size_t>(from[m][k]) - first]);
        for (const Rows& of_rank : memory[m]) {
          const std::size_t count = of_rank.size() / rows;
          pool.insert(pool.end(), of_rank.begin() + static_cast<std::ptrdiff_t>(row * count),
                      of_rank.begin() + static_cast<std::ptrdiff_t>((row + 1) * count));
        }
        for (std::size_t k = 0; k < place.size(); ++k) taken[row * place.size() + k] = pool[place[k]];
      }
      memory_now.push_back(std::move(taken));
      const std::vector<int> unsorted = from[m];
      for (std::size_t k = 0; k < place.size(); ++k) from[m][k] = unsorted[place[k]];
    }
    cells = chosen(cells, take_chosen(from));
    for (std::size_t m = 0; m < memory_now.size(); ++m)
      body_.materials[m]->replace(std::move(memory_now[m]), begin_of(m), count_of(m));
  }

  const Ranks& ranks_;
  Body<K>& body_;
  MaterialPoints<dim>& points_;
};

}  // namespace stillpoint
