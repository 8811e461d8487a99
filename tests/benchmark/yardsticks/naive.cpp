#include "naive.hpp"

#include <algorithm>
#include <cmath>

namespace yardsticks {

namespace {

using Tensor = std::array<std::array<double, 3>, 3>;

// Value of function a along an axis at x, by its polynomial in the cell, which goes on outside of it.
double along_axis(int degree, int a, double x) {
  if (degree == 1) return a == 0 ? 1 - x : x;
  if (a == 0) return (1 - x) * (1 - x) / 2;
  if (a == 1) return 0.75 - (x - 0.5) * (x - 0.5);
  return x * x / 2;
}

// A central difference is exact for polynomials up to the second degree, over any distance.
double slope(int degree, int a, double x) { return along_axis(degree, a, x + 0.5) - along_axis(degree, a, x - 0.5); }

// σ + Δσ with Jaumann's rate, Δσ = W σ − σ W + λ tr(D) I + 2 G D, H = D + W.
Tensor elastic_trial(const Tensor& sigma, const Tensor& H) {
  Tensor D, W, next;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) D[i][j] = (H[i][j] + H[j][i]) / 2, W[i][j] = (H[i][j] - H[j][i]) / 2;
  const double volume_change = H[0][0] + H[1][1] + H[2][2];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      next[i][j] = sigma[i][j] + 2 * soil::shear * D[i][j] + (i == j ? soil::lambda * volume_change : 0);
      for (int k = 0; k < 3; ++k) next[i][j] += W[i][k] * sigma[k][j] - sigma[i][k] * W[k][j];
    }
  }
  return next;
}

// No tension, and √J₂ + η p ≤ 0 by a smaller deviator.
Answer return_to_cone(Tensor& sigma, double& plastic_strain) {
  const double p_trial = (sigma[0][0] + sigma[1][1] + sigma[2][2]) / 3;
  for (int i = 0; i < 3; ++i) sigma[i][i] -= p_trial;
  double J2 = 0;
  for (const auto& row : sigma)
    for (const double s : row) J2 += s * s / 2;
  const double p = std::min(p_trial, 0.0), strength = -soil::eta * p, root = std::sqrt(J2);
  const bool yields = root > strength;
  if (yields) {
    plastic_strain += (root - strength) / soil::shear;
    for (auto& row : sigma)
      for (double& s : row) s *= strength / root;
  }
  for (int i = 0; i < 3; ++i) sigma[i][i] += p;
  return p_trial > 0 ? Answer::cut : yields ? Answer::on_the_cone : Answer::elastic;
}

// det(f) f⁻ᵀ of f = I + H.
Tensor cofactors(const Tensor& H) {
  Tensor f = H, of;
  for (int i = 0; i < 3; ++i) f[i][i] += 1;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
      of[i][j] = f[k][m] * f[l][n] - f[k][n] * f[l][m];
    }
  }
  return of;
}

}  // namespace

FunctionsAt functions_at(const Grid& grid, const std::array<double, 3>& place) {
  FunctionsAt at;
  const int n = grid.degree + 1;
  for (int c = 0; c < (grid.dim == 3 ? n : 1); ++c) {
    for (int b = 0; b < n; ++b) {
      for (int a = 0; a < n; ++a) {
        const std::array<int, 3> function{a, b, c};
        double value = 1;
        std::array<double, 3> gradient{};
        for (int axis = 0; axis < grid.dim; ++axis) gradient[axis] = 1 / grid.side;
        for (int axis = 0; axis < grid.dim; ++axis) {
          const double along = along_axis(grid.degree, function[axis], place[axis]);
          value *= along;
          for (int other = 0; other < grid.dim; ++other)
            gradient[other] *= other == axis ? slope(grid.degree, function[axis], place[axis]) : along;
        }
        at.value.push_back(value);
        at.gradient.push_back(gradient);
      }
    }
  }
  return at;
}

std::vector<std::size_t> nodes_of_cell(const Grid& grid, std::size_t cell) {
  const auto nx = static_cast<std::size_t>(grid.cells[0]), ny = static_cast<std::size_t>(grid.cells[1]);
  const int i = static_cast<int>(cell % nx), j = static_cast<int>(cell / nx % ny), k = static_cast<int>(cell / nx / ny);
  std::vector<std::size_t> nodes;
  for (int c = 0; c <= (grid.dim == 3 ? grid.degree : 0); ++c)
    for (int b = 0; b <= grid.degree; ++b)
      for (int a = 0; a <= grid.degree; ++a) nodes.push_back(grid.node(i + a, j + b, k + c));
  return nodes;
}

std::vector<Answer> naive_forces(const Grid& grid, std::size_t cell, const std::vector<double>& du,
                                 std::vector<PointState>& points, std::vector<double>& R) {
  const auto nodes = nodes_of_cell(grid, cell);
  const auto stride = static_cast<std::size_t>(grid.stride), dim = static_cast<std::size_t>(grid.dim);
  std::vector<Answer> answers;
  for (PointState& point : points) {
    const auto functions = functions_at(grid, point.place);
    Tensor H{};
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j) H[i][j] += du[stride * nodes[a] + i] * functions.gradient[a][j];

    const auto& [xx, yy, zz, xy, yz, zx] = point.stress;
    Tensor sigma = elastic_trial({{{xx, xy, zx}, {xy, yy, yz}, {zx, yz, zz}}}, H);
    answers.push_back(return_to_cone(sigma, point.plastic_strain));
    point.stress = {sigma[0][0], sigma[1][1], sigma[2][2], sigma[0][1], sigma[1][2], sigma[2][0]};

    // P = σ cof f,   R_a = Σ_p V P ∇N_a
    const Tensor cof = cofactors(H);
    for (std::size_t i = 0; i < dim; ++i) {
      for (std::size_t j = 0; j < dim; ++j) {
        double P = 0;
        for (std::size_t k = 0; k < 3; ++k) P += sigma[i][k] * cof[k][j];
        for (std::size_t a = 0; a < nodes.size(); ++a)
          R[stride * nodes[a] + i] += point.volume * P * functions.gradient[a][j];
      }
    }
  }
  return answers;
}

}  // namespace yardsticks
