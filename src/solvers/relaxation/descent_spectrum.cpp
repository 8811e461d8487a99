#include "solvers/relaxation/descent_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace stillpoint {
namespace {

// Whether T − x I has a factor L D Lᵀ with D > 0, that is, no eigenvalue of T is at or below x.
bool is_above(std::span<const double> diagonal, std::span<const double> off_diagonal_squared, double x) {
  double d = diagonal[0] - x;
  for (std::size_t j = 1; j < diagonal.size(); ++j) {
    if (!(d > 0)) return false;
    d = diagonal[j] - x - off_diagonal_squared[j - 1] / d;
  }
  return d > 0;
}

// The lowest eigenvalue of T from below to 0.1 %, by bisection of its exponent.
double lowest_eigenvalue(std::span<const double> diagonal, std::span<const double> off_diagonal_squared) {
  constexpr double accuracy = 1e-3, least = 1e-20;  // values below `least` are rounding
  double above = std::ranges::min(diagonal), below = above;
  while (below > least * above && !is_above(diagonal, off_diagonal_squared, below)) below /= 16;
  while (above > (1 + accuracy) * below) {
    const double middle = std::sqrt(above * below);
    (is_above(diagonal, off_diagonal_squared, middle) ? below : above) = middle;
  }
  return below;
}

}  // namespace

DescentSpectrum::DescentSpectrum() {
  diagonal_.reserve(most);
  off_diagonal_squared_.reserve(most);
}

void DescentSpectrum::begin() {
  diagonal_.clear();
  off_diagonal_squared_.clear();
  carried_ = 0;
}

// Without its first rows T is that of the same descent, begun later: when T is full its first half is dropped.
void DescentSpectrum::add(double alpha, double beta) {
  if (diagonal_.size() == most) {
    const auto half = static_cast<std::ptrdiff_t>(most / 2);
    diagonal_.erase(diagonal_.begin(), diagonal_.begin() + half);
    off_diagonal_squared_.erase(off_diagonal_squared_.begin(), off_diagonal_squared_.begin() + half);
  }
  diagonal_.push_back(1 / alpha + carried_);
  off_diagonal_squared_.push_back(beta / (alpha * alpha));
  carried_ = beta / alpha;
}

std::optional<double> DescentSpectrum::lowest(double share) const {
  constexpr std::size_t fewest = 6;
  const std::size_t m = diagonal_.size();
  if (m < fewest) return std::nullopt;
  const std::span diagonal(diagonal_), off_diagonal_squared(off_diagonal_squared_);
  const double now = lowest_eigenvalue(diagonal, off_diagonal_squared);
  const double before = lowest_eigenvalue(diagonal.first(m - m / 3), off_diagonal_squared);
  if (!(now > 0) || !(before <= (1 + share) * now)) return std::nullopt;
  return now;
}

void DescentSpectrum::archive(const StateArchive& state) {
  state("diagonal", diagonal_);
  state("off_diagonal_squared", off_diagonal_squared_);
  state("carried", carried_);
  if (diagonal_.size() != off_diagonal_squared_.size() || diagonal_.size() > most)
    throw StateError("the rows of its T do not fit together");
}

}  // namespace stillpoint
