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

  /// Lets each point go to the rank of the cell that it lies in now; cells: their numbers in the grid, (points), which
  /// become those of the points that are here afterwards. The points are as they were sorted before they moved on, and
  /// have to be sorted anew.
  void run(const RankCells<dim>& cells_of_ranks, const Grid<dim>& grid, std::vector<int>& cells) {
    std::vector<int> rank(points_.size());
    for (std::size_t p = 0; p < rank.size(); ++p) rank[p] = cells_of_ranks.owner(grid.cell_at(cells[p]));
    if (!is_so_for_any(&ranks_, std::ranges::any_of(rank, [this](int to) { return to != ranks_.rank(); }))) return;
    exchange([&rank](std::size_t p, int to) { return rank[p] == to; }, cells);
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
    std::vector<int> from, material_begin;
    for (std::size_t m = 0; m < points_.materials(); ++m) {
      material_begin.push_back(static_cast<int>(from.size()));
      for (std::size_t p = begin_of(m); p < begin_of(m + 1); ++p)
        if (cells_of_ranks.owner(grid.cell_at(cells[p])) == ranks_.rank()) from.push_back(static_cast<int>(p));
    }
    material_begin.push_back(static_cast<int>(from.size()));
    points_.material_begin = std::move(material_begin);
    take_points(points_, from);
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

  // Sends each rank the points that go(point, rank) to it, and keeps those that go to this one; cells: as in run().
  template <class Go>
  void exchange(const Go& go, std::vector<int>& cells) {
    std::vector<int> before = cells_of_points();
    std::vector<Bytes> to(static_cast<std::size_t>(ranks_.count()));
    for (int r = 0; r < ranks_.count(); ++r)
      if (r != ranks_.rank()) to[static_cast<std::size_t>(r)] = packed(go, r, before, cells);
    std::vector<std::vector<int>> from(points_.materials());  // in their new order; those from elsewhere follow ours
    for (std::size_t m = 0; m < from.size(); ++m)
      for (std::size_t p = begin_of(m); p < begin_of(m + 1); ++p)
        if (go(p, ranks_.rank())) from[m].push_back(static_cast<int>(p));
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
    for (std::size_t m = 0; m < points_.materials(); ++m) {
      const std::size_t first = all.size();
      for (std::size_t p = begin_of(m); p < begin_of(m + 1); ++p)
        if (go(p, to)) all.push_back(static_cast<int>(p));
      of_material.push_back(static_cast<int>(all.size() - first));
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
    std::vector<int> all, material_begin;
    for (std::size_t m = 0; m < from.size(); ++m) {
      std::vector<std::size_t> place(
          from[m].size());  // in what `memory` and the present memory have one after the other
      for (std::size_t k = 0; k < place.size(); ++k) place[k] = k;
      std::ranges::stable_sort(place, {}, [&](std::size_t k) { return before[static_cast<std::size_t>(from[m][k])]; });
      material_begin.push_back(static_cast<int>(all.size()));
      for (const std::size_t k : place) all.push_back(from[m][k]);
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
      memory_.push_back(std::move(taken));
    }
    material_begin.push_back(static_cast<int>(all.size()));
    take_points(points_, all);
    cells = chosen(cells, all);
    points_.material_begin = std::move(material_begin);
    for (std::size_t m = 0; m < memory_.size(); ++m)
      body_.materials[m]->replace(std::move(memory_[m]), begin_of(m), count_of(m));
  }

  const Ranks& ranks_;
  Body<K>& body_;
  MaterialPoints<dim>& points_;
  std::vector<Rows> memory_;
};

}  // namespace stillpoint
