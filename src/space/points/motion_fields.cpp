#include "space/points/motion_fields.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/contact_bodies.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/grid/cells_around.hpp"

namespace stillpoint {
namespace {

/// How many cells further the functions of a cell reach.
int reach_of(const Problem& problem) {
  const int of_basis = problem.grid.basis == BasisKind::hermite ? 1 : degree_of(problem.grid.basis);
  return of_basis + (problem.phase.ends() && problem.phase.quadrature == Quadrature::domains ? 1 : 0);
}

/// Groups of bodies that are bonded, directly or through others.
class BondedBodies {
 public:
  explicit BondedBodies(std::size_t bodies) : next_(bodies) { std::iota(next_.begin(), next_.end(), std::size_t{0}); }

  /// The first body of the group of k.
  std::size_t group(std::size_t k) const {
    while (next_[k] != k) k = next_[k];
    return k;
  }
  void bond(std::size_t a, std::size_t b) {
    const std::size_t of_a = group(a), of_b = group(b);
    next_[std::max(of_a, of_b)] = std::min(of_a, of_b);
  }

 private:
  std::vector<std::size_t> next_;
};

}  // namespace

template <int Dim>
MotionFields motion_fields(const Problem& problem, const Grid<Dim>& grid,
                           const std::vector<MaterialPoints<Dim>>& points) {
  const std::size_t bodies = problem.bodies.size();
  if (problem.contacts.empty()) return {std::vector<int>(bodies, 0), 1};
  std::vector<std::vector<char>> apart(bodies, std::vector<char>(bodies, 0));
  for (const ContactSpec& contact : problem.contacts) {
    if (!are_there(problem, contact)) continue;
    const auto [a, b] = bodies_of(problem, contact);
    apart[a][b] = apart[b][a] = 1;
  }

  std::vector<std::set<int>> cells(bodies);
  for (std::size_t k = 0; k < bodies; ++k)
    for (std::size_t p = 0; p < points[k].size(); ++p)
      cells[k].insert(grid.cell_number(grid.cell_of(points[k].position(p))));
  const int reach = reach_of(problem);
  // Whether a cell of a shares a function with one of b.
  const auto share = [&](std::size_t a, std::size_t b) {
    std::set<int> around;  // the cells of a, and those next to them
    for (const int cell : cells[a])
      for_cells_around(grid, grid.cell_at(cell), reach, [&](int beside) { around.insert(beside); });
    return std::ranges::any_of(cells[b], [&](int cell) { return around.contains(cell); });
  };
  BondedBodies bonded(bodies);
  for (std::size_t b = 1; b < bodies; ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (!apart[a][b] && bonded.group(a) != bonded.group(b) && share(a, b)) bonded.bond(a, b);

  std::vector<std::set<std::size_t>> touches(bodies);  // the groups that a group touches
  for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
    if (!are_there(problem, problem.contacts[k])) continue;
    const auto [a, b] = bodies_of(problem, problem.contacts[k]);
    const std::size_t of_a = bonded.group(a), of_b = bonded.group(b);
    if (of_a == of_b) {
      throw_scene_error(fmt::format("contact[{}].bodies", k),
                        fmt::format("{} and {} are bonded through another body, which is within reach of the grid's "
                                    "functions from both; expected a contact between that body and one of them",
                                    in_quotes(problem.bodies[a].name), in_quotes(problem.bodies[b].name)));
    }
    touches[of_a].insert(of_b);
    touches[of_b].insert(of_a);
  }

  MotionFields fields{std::vector<int>(bodies, 0), 1};
  for (std::size_t k = 0; k < bodies; ++k) {
    if (bonded.group(k) != k) {
      fields.of_body[k] = fields.of_body[bonded.group(k)];
      continue;
    }
    const auto taken = [&](int field) {
      return std::ranges::any_of(touches[k],
                                 [&](std::size_t group) { return group < k && fields.of_body[group] == field; });
    };
    while (taken(fields.of_body[k])) ++fields.of_body[k];
    fields.count = std::max(fields.count, fields.of_body[k] + 1);
  }
  return fields;
}

template MotionFields motion_fields(const Problem&, const Grid<1>&, const std::vector<MaterialPoints<1>>&);
template MotionFields motion_fields(const Problem&, const Grid<2>&, const std::vector<MaterialPoints<2>>&);
template MotionFields motion_fields(const Problem&, const Grid<3>&, const std::vector<MaterialPoints<3>>&);

}  // namespace stillpoint
