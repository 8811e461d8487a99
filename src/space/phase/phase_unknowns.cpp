#include "space/phase/phase_unknowns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel_loop.hpp"

namespace stillpoint {

// Unknowns keep their numbers from phase to phase if material reaches the same functions and the same ones are held.
void PhaseUnknowns::begin_phase(std::vector<char> reached, HeldUnknowns held, const ExtendedFunctions& extension) {
  held_ = std::move(held);
  untouched_.assign(reached.size(), 1);
  for (std::size_t f = 0; f < untouched_.size(); ++f) {
    for (int i = 0; i < dim_; ++i) {
      const int unknown = dim_ * static_cast<int>(f) + i;
      if (held_.is_prescribed(unknown) || held_.is_guided(unknown)) untouched_[f] = 0;
    }
  }
  if (dofs_ && reached == reached_ && held_.prescribed() == dofs_->prescribed) return;
  dofs_.emplace(reached, dim_, held_.prescribed(), extension);
  reached_ = std::move(reached);
}

void PhaseUnknowns::spread(double t, ConstVec u, std::vector<double>& grid) const {
  for_each_index(u.size(), [u, to = grid.data(), number = dofs_->free.data()](std::size_t k) { to[number[k]] = u[k]; });
  spread_others(t, grid);
}

void PhaseUnknowns::spread_others(double t, std::vector<double>& grid) const {
  for (const std::size_t s : held_.displaced())
    grid[static_cast<std::size_t>(dofs_->prescribed[s])] = held_.displacement(s, t);
  dofs_->extend(grid.data());
}

void PhaseUnknowns::spread_start(std::vector<double>& grid) const {
  std::ranges::fill(grid, 0.0);
  for (std::size_t s = 0; s < dofs_->prescribed.size(); ++s)
    grid[static_cast<std::size_t>(dofs_->prescribed[s])] = held_.from(s);
  dofs_->extend(grid.data());
}

double PhaseUnknowns::spread_and_measure(double t, ConstVec u, const std::vector<double>& weight,
                                         std::vector<double>& grid) const {
  const auto spread_one = [u = u.data(), to = grid.data(), number = dofs_->free.data(),
                           weight = weight.data()](std::size_t k) {
    to[number[k]] = u[k];
    return std::abs(u[k]) * weight[k];
  };
  const double largest = reduce(u.size(), 0.0, spread_one, [](double a, double b) { return a > b ? a : b; });
  spread_others(t, grid);
  return largest;
}

void PhaseUnknowns::spread_direction(ConstVec du, std::vector<double>& grid) const {
  std::ranges::fill(grid, 0.0);
  for (std::size_t k = 0; k < du.size(); ++k) grid[static_cast<std::size_t>(dofs_->free[k])] = du[k];
  dofs_->extend(grid.data());
}

std::vector<double> PhaseUnknowns::velocities(double t, ConstVec v) const {
  std::vector<double> grid(dofs_->number.size(), 0.0);
  for_each_index(v.size(), [from = v.data(), to = grid.data(), number = dofs_->free.data()](std::size_t k) {
    to[number[k]] = from[k];
  });
  for (std::size_t s = 0; s < dofs_->prescribed.size(); ++s)
    grid[static_cast<std::size_t>(dofs_->prescribed[s])] = held_.motion(s).velocity(t);
  dofs_->extend(grid.data());
  return grid;
}

std::vector<double> PhaseUnknowns::free_values(const std::vector<double>& grid) const {
  std::vector<double> values(size());
  for_each_index(values.size(), [to = values.data(), from = grid.data(), number = dofs_->free.data()](std::size_t k) {
    to[k] = from[number[k]];
  });
  return values;
}

}  // namespace stillpoint
