#include "space/grid/extrapolation.hpp"

#include <algorithm>
#include <cstdlib>

namespace stillpoint {

template <int Dim>
Extrapolator<Dim>::Extrapolator(const GridFunctions<Dim>& functions, const std::vector<double>& share)
    : functions_(functions), share_(share), degree_(functions.degree()), reach_(degree_ + 1) {
  int stride = 1;
  for (int d = 0; d < Dim; ++d) {
    stride_[d] = stride;
    count_[d] = functions.count_along(d);
    stride *= count_[d];
  }
}

template <int Dim>
std::optional<Extrapolation> Extrapolator<Dim>::operator()(int function) const {
  std::optional<Extrapolation> nearest;
  int distance = 2 * reach_ + 1;
  for (int d = 0; d < Dim; ++d) {
    for (const int sign : {-1, 1}) {
      for (int far = 2; far <= reach_ && far < distance; ++far) {
        Offset near{};
        near[static_cast<std::size_t>(d)] = sign * (far - 1);
        const auto found = from_box(function, near);
        if (!found) continue;
        nearest = found;
        distance = far;
      }
    }
  }
  if (nearest) return nearest;
  for (int axes = 2; axes <= Dim && !nearest; ++axes) nearest = from_nearest_box(function, axes);
  return nearest ? nearest : from_neighbour(function, share_[static_cast<std::size_t>(function)]);
}

// Extrapolates from the nearest box that extends along this number of axes.
template <int Dim>
std::optional<Extrapolation> Extrapolator<Dim>::from_nearest_box(int function, int axes) const {
  std::optional<Extrapolation> nearest;
  int distance = Dim * reach_;
  for (int signs = 0; signs < 1 << Dim; ++signs) {
    for (int k = 0; k < power(reach_, Dim); ++k) {
      Offset near{};
      int along = 0, away = 0;
      bool twice = false;  // an offset of 0 occurs with either sign
      for (int d = 0; d < Dim; ++d) {
        const int steps = k / power(reach_, Dim - 1 - d) % reach_;
        const bool upwards = (signs >> (Dim - 1 - d) & 1) != 0;
        twice = twice || (steps == 0 && upwards);
        near[static_cast<std::size_t>(d)] = upwards ? steps : -steps;
        along += steps > 0 ? 1 : 0;
        away += steps;
      }
      if (along != axes || twice || away >= distance) continue;
      const auto found = from_box(function, near);
      if (!found) continue;
      nearest = found;
      distance = away;
    }
  }
  return nearest;
}

// Extrapolates from the nearest function with a share above `best`.
template <int Dim>
std::optional<Extrapolation> Extrapolator<Dim>::from_neighbour(int function, double best) const {
  const int span = 2 * degree_ + 1;
  std::optional<Extrapolation> nearest;
  int distance = 0;
  for (int k = 0; k < power(span, Dim); ++k) {
    int other = function, away = 0;
    bool exists = true;
    for (int d = 0; d < Dim; ++d) {
      const int by = k / power(span, d) % span - degree_, at = index_along(function, d) + by;
      exists = exists && at >= 0 && at < count_[d];
      other += by * stride_[d];
      away += std::abs(by);
    }
    exists = exists && other != function;
    const double share = exists ? std::min(share_[static_cast<std::size_t>(other)], 1.0) : 0;
    if (!(share > best || (nearest && share == best && away < distance))) continue;
    nearest = Extrapolation{.functions = 1, .function = {other}, .weight = {1}};
    best = share;
    distance = away;
  }
  return nearest;
}

// Extrapolates from the box of the functions at this offset and the next ones along each axis whose offset is not 0.
template <int Dim>
std::optional<Extrapolation> Extrapolator<Dim>::from_box(int function, const Offset& near) const {
  Extrapolation box{.functions = 1, .function = {function}, .weight = {1}};
  for (int d = 0; d < Dim; ++d) {
    const int along = near[static_cast<std::size_t>(d)];
    if (along != 0 && !extend(box, function, d, along)) return std::nullopt;
  }
  for (int k = 0; k < box.functions; ++k) {
    if (!(share_[static_cast<std::size_t>(box.function[k])] >= 1)) return std::nullopt;
  }
  return box;
}

// Linear extrapolation along axis d: w_1 = (x − x_2)/(x_1 − x_2), w_2 = 1 − w_1
template <int Dim>
bool Extrapolator<Dim>::extend(Extrapolation& box, int function, int d, int near) const {
  const int here = index_along(function, d), first = here + near, second = first + (near > 0 ? 1 : -1);
  if (std::min(first, second) < 0 || std::max(first, second) >= count_[d]) return false;
  const auto centre_at = [&](int index) { return functions_.centre(function + (index - here) * stride_[d], d); };
  const double x = centre_at(here), x_1 = centre_at(first), x_2 = centre_at(second);
  const double w_1 = (x - x_2) / (x_1 - x_2);
  for (int k = 0; k < box.functions; ++k) {
    const int other = box.functions + k;
    box.function[other] = box.function[k] + (second - here) * stride_[d];
    box.weight[other] = box.weight[k] * (1 - w_1);
    box.function[k] += near * stride_[d];
    box.weight[k] *= w_1;
  }
  box.functions *= 2;
  return true;
}

template class Extrapolator<1>;
template class Extrapolator<2>;
template class Extrapolator<3>;

}  // namespace stillpoint
