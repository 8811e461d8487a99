#include "block.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <random>

#include "naive.hpp"

namespace yardsticks {

namespace {

constexpr std::size_t beyond = 8;  // numbers after the last node, for loads of a whole register
constexpr double alpha = 0.5;      // of local damping

double largest(const std::vector<double>& of) {
  double largest = 0;
  for (const double x : of) largest = std::abs(x) <= largest ? largest : std::abs(x);  // NaN stays
  return largest;
}

}  // namespace

Block::Block(const Grid& grid) : grid_(grid) {
  const std::size_t size = static_cast<std::size_t>(grid.stride) * grid.nodes() + beyond;
  for (auto* of_nodes : {&du_, &R_, &v_, &load_, &rate_}) of_nodes->assign(size, 0.0);
  // A tenth of the time that a wave takes through a cell.
  h_ = 0.1 * grid.side / std::sqrt((soil::lambda + 2 * soil::shear) / soil::density);
}

void Block::fill() {
  const int in_cell = 1 << grid_.dim;
  const auto stride = static_cast<std::size_t>(grid_.stride), dim = static_cast<std::size_t>(grid_.dim);
  const auto nx = static_cast<std::size_t>(grid_.cells[0]), ny = static_cast<std::size_t>(grid_.cells[1]);
  const double near = 0.5 - 0.5 / std::numbers::sqrt3;
  std::vector<double> mass(grid_.nodes(), 0.0);
  for (std::size_t cell = 0; cell < grid_.cell_count(); ++cell) {
    const auto nodes = nodes_of_cell(grid_, cell);
    for (int q = 0; q < in_cell; ++q) {
      PointState state{};
      for (std::size_t axis = 0; axis < dim; ++axis) state.place[axis] = (q >> axis & 1) != 0 ? 1 - near : near;
      state.volume = std::pow(grid_.side, grid_.dim) / in_cell;
      const double depth = (static_cast<double>(ny - cell / nx % ny) - state.place[1]) * grid_.side;
      const double vertical = -soil::density * soil::gravity * depth;
      state.stress = {soil::at_rest * vertical, vertical, soil::at_rest * vertical, 0, 0, 0};
      set_point(cell, q, state);
      const auto N = functions_at(grid_, state.place).value;
      for (std::size_t a = 0; a < nodes.size(); ++a) mass[nodes[a]] += N[a] * soil::density * state.volume;
    }
  }
  // The lowest nodes are held, and the sides are smooth walls.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-0.01, 0.01);
  for (int k = 0; k < grid_.nodes(2); ++k) {
    for (int j = 0; j < grid_.nodes(1); ++j) {
      for (int i = 0; i < grid_.nodes(0); ++i) {
        const std::array<int, 3> at{i, j, k};
        const std::size_t node = grid_.node(i, j, k);
        for (std::size_t axis = 0; axis < dim; ++axis) {
          const bool beside = axis != 1 && (at[axis] == 0 || at[axis] == grid_.nodes(static_cast<int>(axis)) - 1);
          if (j == 0 || beside) continue;
          v_[stride * node + axis] = any(random);
          rate_[stride * node + axis] = h_ / mass[node];
          du_[stride * node + axis] = h_ * v_[stride * node + axis];
        }
        load_[stride * node + 1] = -soil::gravity * mass[node];
      }
    }
  }
}

void Block::move_nodes() {
  double *du = du_.data(), *R = R_.data(), *v = v_.data();
  const double *load = load_.data(), *rate = rate_.data(), h = h_;
  for (std::size_t i = 0; i < du_.size(); ++i) {
    const double out_of_balance = load[i] - R[i];
    v[i] += rate[i] * (out_of_balance - std::copysign(alpha * std::abs(out_of_balance), v[i]));
    du[i] = h * v[i];
    R[i] = 0;
  }
}

std::string Block::wrong() {
  for (int k = 0; k < 100; ++k) step();
  const double speed = largest(v_);
  if (!(speed > 0) || !(speed < 1)) return "a velocity after 100 steps is " + std::to_string(speed) + " m/s";

  // Stresses and an increment of some size, so that all answers of the law occur, and products of an increment count.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  const int in_cell = 1 << grid_.dim;
  const auto stride = static_cast<std::size_t>(grid_.stride);
  for (std::size_t node = 0; node < grid_.nodes(); ++node)
    for (std::size_t i = 0; i < static_cast<std::size_t>(grid_.dim); ++i)
      du_[stride * node + i] = 0.01 * grid_.side * any(random);
  std::vector<double> R(R_.size(), 0.0), stress, expected_stress, strain, expected_strain;
  std::array<std::size_t, 3> times{};
  std::vector<std::vector<PointState>> expected(grid_.cell_count());
  for (std::size_t cell = 0; cell < grid_.cell_count(); ++cell) {
    for (int q = 0; q < in_cell; ++q) {
      PointState state = point(cell, q);
      for (double& at : state.place) at = std::clamp(at + 0.1 * any(random), 0.0, 1.0);
      if (grid_.dim == 2) state.place[2] = 0;
      state.volume *= 1 + 0.1 * any(random);
      const double p = 3e5 * any(random) - 2e5;
      for (std::size_t c = 0; c < 6; ++c) state.stress[c] = (c < 3 ? p : 0) + 2e5 * any(random);
      if (grid_.dim == 2) state.stress[4] = state.stress[5] = 0;
      state.plastic_strain = 0.1 + 0.1 * any(random);
      set_point(cell, q, state);
      expected[cell].push_back(state);
    }
    for (const Answer answer : naive_forces(grid_, cell, du_, expected[cell], R))
      ++times[static_cast<std::size_t>(answer)];
  }
  std::fprintf(stderr, "%zu points elastic, %zu on the cone, %zu cut: ", times[0], times[1], times[2]);
  if (*std::ranges::min_element(times) < points() / 50) return "the check leaves one of the law's answers out";

  std::ranges::fill(R_, 0.0);
  forces();
  commit();
  for (std::size_t cell = 0; cell < grid_.cell_count(); ++cell) {
    for (int q = 0; q < in_cell; ++q) {
      const PointState state = point(cell, q), &of = expected[cell][static_cast<std::size_t>(q)];
      stress.insert(stress.end(), state.stress.begin(), state.stress.end());
      expected_stress.insert(expected_stress.end(), of.stress.begin(), of.stress.end());
      strain.push_back(state.plastic_strain);
      expected_strain.push_back(of.plastic_strain);
    }
  }
  std::string wrong;
  const auto compare = [&wrong](const char* what, const std::vector<double>& found, const std::vector<double>& naive) {
    std::vector<double> off(naive.size());
    for (std::size_t i = 0; i < off.size(); ++i) off[i] = found[i] - naive[i];
    const double by = largest(off) / largest(naive);
    std::fprintf(stderr, "%s off by %.1e, ", what, by);
    if (!(by < 1e-12)) wrong += std::string(what) + " differ from those of a naive loop; ";
  };
  compare("stresses", stress, expected_stress);
  compare("plastic strains", strain, expected_strain);
  compare("forces", R_, R);
  return wrong;
}

}  // namespace yardsticks
