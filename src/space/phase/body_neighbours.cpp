#include "space/phase/body_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "scene/contact_bodies.hpp"
#include "scene/grid_lines.hpp"
#include "space/grid/cells_around.hpp"

namespace stillpoint {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

}  // namespace

template <int Dim>
std::vector<BodyGap> BodyNeighbours<Dim>::find(bool at_start) const {
  const std::vector<std::vector<std::size_t>> bodies = bodies_of_functions();
  const auto of_field = static_cast<std::size_t>(functions_.count_of_field());
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t f = 0; f < of_field; ++f) {
    std::vector<std::size_t> together;  // in any field
    for (std::size_t k = f; k < bodies.size(); k += of_field)
      together.insert(together.end(), bodies[k].begin(), bodies[k].end());
    for (std::size_t j = 1; j < together.size(); ++j)
      for (std::size_t i = 0; i < j; ++i)
        if (!have_contact(problem_, together[i], together[j])) pairs.insert(std::minmax(together[i], together[j]));
  }
  std::vector<BodyGap> found;
  if (pairs.empty()) return found;
  std::vector<BodyDepth> shapes;
  for (const BodySpec& body : problem_.bodies) shapes.emplace_back(body);
  const std::vector<Near> points = points_near_others(bodies);
  for (const auto& [a, b] : pairs) {
    const bool surfaces = at_start && shapes[a].is_known() && shapes[b].is_known();
    found.push_back(gap_between(a, b, points, surfaces ? &shapes : nullptr));
    found.back().bonded = points_.field_of(a) == points_.field_of(b);
  }
  return found;
}

template <int Dim>
std::vector<std::vector<std::size_t>> BodyNeighbours<Dim>::bodies_of_functions() const {
  struct Reach {
    int function;
    std::size_t body;
    auto operator<=>(const Reach&) const = default;  // NOLINT(modernize-use-nullptr): of the compiler's own 0
  };
  std::vector<Reach> all;
  for (std::size_t k = 0; k < points_.cells(); ++k) {
    std::size_t last = none;
    for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) {
      const std::size_t body = body_of(first_number_, points_.number[p]);
      if (std::exchange(last, body) == body) continue;
      for (int a = 0; a < functions_.per_cell(); ++a) all.push_back({weights_.function(k, a), body});
    }
  }
  const auto leave_one_of_each = [&all] {
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
  };
  leave_one_of_each();
  all = joined_lists(ranks_, std::move(all));
  if (ranks_) leave_one_of_each();
  std::vector<std::vector<std::size_t>> bodies(static_cast<std::size_t>(functions_.count()));
  for (const Reach& one : all) bodies[static_cast<std::size_t>(one.function)].push_back(one.body);
  return bodies;
}

// In the order of the cells in the whole body.
template <int Dim>
auto BodyNeighbours<Dim>::points_near_others(const std::vector<std::vector<std::size_t>>& bodies) const
    -> std::vector<Near> {
  const auto of_field = static_cast<std::size_t>(functions_.count_of_field());
  const auto meets_others = [&](std::size_t k) {
    for (int a = 0; a < functions_.per_cell(); ++a) {
      std::size_t there = 0;  // bodies in any field
      for (std::size_t f = static_cast<std::size_t>(weights_.function(k, a)) % of_field; f < bodies.size();
           f += of_field)
        there += bodies[f].size();
      if (there > 1) return true;
    }
    return false;
  };
  std::vector<Near> near;
  for (std::size_t k = 0; k < points_.cells(); ++k) {
    if (!meets_others(k)) continue;
    for (std::size_t p = points_.begin(k); p < points_.end(k); ++p)
      near.push_back({place_of_cell(points_, k), body_of(first_number_, points_.number[p]), points_.position(p)});
  }
  near = joined_lists(ranks_, std::move(near));
  if (ranks_) std::ranges::stable_sort(near, {}, &Near::of);
  return near;
}

// The smallest gap from the points of a to the nearest ones of b, over the cells that share functions.
template <int Dim>
BodyGap BodyNeighbours<Dim>::gap_between(std::size_t a, std::size_t b, const std::vector<Near>& points,
                                         const std::vector<BodyDepth>* shapes) const {
  std::unordered_map<int, std::vector<const Near*>> of_b;
  for (const Near& point : points)
    if (point.body == b) of_b[point.of.cell].push_back(&point);
  BodyGap found{.a = a, .b = b, .gap = std::numeric_limits<double>::infinity()};
  const int reach = functions_.per_axis() - 1;
  std::vector<const Near*> near;
  const CellPlace* last = nullptr;
  for (const Near& p : points) {
    if (p.body != a) continue;
    if (!last || *last != p.of) {
      if (found.cells <= touching && std::isfinite(found.gap)) break;
      last = &p.of;
      near.clear();
      for_cells_around(grid_, grid_.cell_at(p.of.cell), reach, [&](int cell) {
        if (const auto there = of_b.find(cell); there != of_b.end())
          near.insert(near.end(), there->second.begin(), there->second.end());
      });
    }
    if (near.empty()) continue;
    const Near& q = **std::ranges::min_element(near, {}, [&](const Near* at) { return distance(p, *at); });
    const double gap =
        shapes ? gap_along(p, q, (*shapes)[a], (*shapes)[b]) : distance(p, q) - half_spacing(p) - half_spacing(q);
    if (gap >= found.gap) continue;
    found.gap = std::max(0.0, gap);
    found.cells = 0;
    const double share = found.gap / distance(p, q);
    for (int d = 0; d < Dim; ++d)
      found.cells = std::max(found.cells, share * std::abs(p.x[d] - q.x[d]) / cell_length(d, p));
  }
  return found;
}

template <int Dim>
double BodyNeighbours<Dim>::distance(const Near& p, const Near& q) {
  double square = 0;
  for (int d = 0; d < Dim; ++d) square += (p.x[d] - q.x[d]) * (p.x[d] - q.x[d]);
  return std::sqrt(square);
}

template <int Dim>
double BodyNeighbours<Dim>::cell_length(int d, const Near& p) const {
  return cell_length_at(problem_.grid, static_cast<std::size_t>(d), p.x[d]);
}

// Half the initial spacing of a body's points where point p is, along the widest of its sides.
template <int Dim>
double BodyNeighbours<Dim>::half_spacing(const Near& p) const {
  const std::vector<int>& along = problem_.bodies[p.body].points_per_cell;
  double widest = 0;
  for (std::size_t d = 0; d < Dim; ++d)
    widest = std::max(widest, cell_length(static_cast<int>(d), p) / (d < along.size() ? along[d] : 1));
  return widest / 2;
}

// The gap on the line from p, in a, to q, in b: from the end of a to the beginning of b. 0 if they touch there.
template <int Dim>
double BodyNeighbours<Dim>::gap_along(const Near& p, const Near& q, const BodyDepth& a, const BodyDepth& b) const {
  const double way = distance(p, q);
  const auto at = [&](double share) {
    Point<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = p.x[d] + share * (q.x[d] - p.x[d]);
    return x;
  };
  // The share of the line, from one end, that lies in the body at that end.
  const auto last_in = [&](const BodyDepth& body, bool from_p) {
    constexpr int halvings = 48;
    double inside = 0, outside = 1;
    for (int halving = 0; halving < halvings; ++halving) {
      const double middle = (inside + outside) / 2;
      (body.contains(at(from_p ? middle : 1 - middle)) ? inside : outside) = middle;
    }
    return inside;
  };
  const double rounding = 1e-12 * way;
  const double gap = way * (1 - last_in(a, true) - last_in(b, false));
  return gap <= rounding ? 0 : gap;
}

template class BodyNeighbours<1>;
template class BodyNeighbours<2>;
template class BodyNeighbours<3>;

}  // namespace stillpoint
