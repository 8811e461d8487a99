#include "space/phase/body_account.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "space/phase/place_of_ranks.hpp"

namespace stillpoint {
template <Kinematics K>
PhaseInfo BodyAccount<K>::describe(double total_mass, bool held_by_springs) const {
  std::set<std::string> names;
  bool remembers = false, finite_strain = false, follows_stress = false;
  for (const auto& material : body_.materials) {
    remembers = remembers || material->info().history_dependent;
    finite_strain = finite_strain || material->info().finite_strain;
    follows_stress = follows_stress || material->info().needs_pressure;
    if (material->info().pressure_by_deformation) names.insert("pore_pressure");
    for (const auto& [name, values] : material->shown_history()) names.insert(name);
  }
  return {.dim = dim,
          .gradient_components = stillpoint::gradient_components(K),
          .stress_components = stillpoint::stress_components(K),
          .points = body_.numbers(),
          .total_mass = total_mass,
          .law_fields = {names.begin(), names.end()},
          .updated_lagrangian = moves_on(),
          .remembers = remembers,
          .nonlinear = finite_strain || remembers,
          // With history the elastic part is small, and yielding only softens; but stiffness may follow the stress, and
          // that of springs may grow.
          .stiffens = finite_strain && (!remembers || follows_stress || (moves_on() && held_by_springs)),
          .points_stiffen = finite_strain && (!remembers || follows_stress)};
}

template <Kinematics K>
std::vector<PointArray> BodyAccount<K>::arrays(const std::vector<PointArray>& of_phase) const {
  constexpr double real = sizeof(double);
  const auto P = static_cast<double>(ranks_ ? body_.points.size() : body_.numbers());
  std::vector<PointArray> arrays = {
      {"position", dim * real}, {"mass", real}, {"volume", real}, {"number", sizeof(int)}};
  std::ranges::copy(of_phase, std::back_inserter(arrays));
  if (moves_on()) {
    arrays.push_back({"velocity", dim * real});
    arrays.push_back({"position at the start", dim * real});
    if (problem_.phase.transfer == Transfer::apic) arrays.push_back({"affine velocity", dim * dim * real});
    if (body_.points.has_domains()) arrays.push_back({"domain", ((dim << dim) + 2 * dim) * real});
  }
  for (std::size_t m = 0; m < body_.materials.size(); ++m) {
    const double share = (body_.points.material_begin[m + 1] - body_.points.material_begin[m]) / P;
    for (PointArray array : body_.materials[m]->arrays()) {
      array.bytes_per_point *= share;
      arrays.push_back(array);
    }
  }
  return arrays;
}

template <Kinematics K>
std::vector<double> BodyAccount<K>::positions() const {
  std::vector<double> out(dim * body_.numbers());
  write_points(body_, ranks_, out, [&](std::size_t, std::size_t p) { return body_.points.position(p); });
  return out;
}

template <Kinematics K>
double BodyAccount<K>::total_mass() const {
  return sum_over(body_.points.size(), [m = body_.points.mass.data()](std::size_t p) { return m[p]; });
}

template <Kinematics K>
PointData BodyAccount<K>::point_data(const std::vector<double>& origin) const {
  const std::vector<double> of_point(body_.numbers()), positions = this->positions();
  PointData data{positions, origin.empty() ? positions : origin, of_point,
                 of_point,  std::vector<int>(body_.numbers()),   std::vector<int>(body_.numbers())};
  std::vector<int> material{0};  // a material in two fields is one
  for (std::size_t m = 1; m < body_.material_names.size(); ++m)
    material.push_back(material.back() + (body_.material_names[m] == body_.material_names[m - 1] ? 0 : 1));
  for (std::size_t b = 0; b + 1 < body_.first_number.size(); ++b)
    std::fill(data.bodies.begin() + body_.first_number[b], data.bodies.begin() + body_.first_number[b + 1],
              static_cast<int>(b));
  for_points(body_.points, [&](std::size_t k, std::size_t p, std::size_t number) {
    data.volumes[number] += body_.points.volume[p];
    data.masses[number] += body_.points.mass[p];
    data.materials[number] = material[static_cast<std::size_t>(body_.points.material_of_cell(k))];
  });
  unite(ranks_, Vec(data.volumes));
  unite(ranks_, Vec(data.masses));
  unite(ranks_, std::span(data.materials));
  return data;
}

template <Kinematics K>
void BodyAccount<K>::history(const std::string& name, Vec out) const {
  std::ranges::fill(out, 0.0);
  for (std::size_t m = 0; m < body_.materials.size(); ++m) {
    const auto begin = static_cast<std::size_t>(body_.points.material_begin[m]);
    for (const auto& [shown, values] : body_.materials[m]->shown_history()) {
      if (shown != name) continue;
      for (std::size_t k = 0; k < values.size(); ++k)
        out[static_cast<std::size_t>(body_.points.number[begin + k])] = values[k];
    }
  }
  unite(ranks_, out);
}

// Where the strength is next to nothing, as at a free surface of ground without cohesion, a hundredth of the largest
// √J₂ takes its place.
template <Kinematics K>
std::optional<OverStress> BodyAccount<K>::over_stress() const {
  constexpr double share_of_largest = 0.01;
  const auto for_viscous = [&](const auto& visit) {
    for_points(body_.points, [&](std::size_t k, std::size_t p, std::size_t number) {
      const auto& material = *body_.materials[static_cast<std::size_t>(body_.points.material_of_cell(k))];
      if (!material.info().viscous) return;
      if (const auto state = material.yield_state(p))
        visit(*state, number);  // of a program's own law it may be unknown
    });
  };
  bool found = false;
  double largest = 0;
  for_viscous([&](const YieldState& at, std::size_t) {
    found = true;
    largest = std::max(largest, at.root_J2);
  });
  if (!is_so_for_any(ranks_, found)) return std::nullopt;
  largest = largest_of_all(ranks_, largest);
  OverStress worst{.share = -std::numeric_limits<double>::infinity()};
  const auto take = [&worst](const OverStress& other) {
    if (!std::isnan(worst.share) && !(other.share <= worst.share)) worst = other;
  };
  for_viscous([&](const YieldState& at, std::size_t number) {
    const double strength = std::max(at.strength, share_of_largest * largest);
    take({at.f == 0 ? 0 : at.f / strength, number});
  });
  for (const OverStress& of_rank : of_all(ranks_, worst)) take(of_rank);
  return worst;
}

template <Kinematics K>
PlaceInBody BodyAccount<K>::place_of(std::size_t number) const {
  PlaceInBody at;
  for_points(body_.points, [&](std::size_t k, std::size_t p, std::size_t n) {
    if (n == number) at = place(k, p);
  });
  return place_of_ranks(ranks_, at, {});
}

template <Kinematics K>
PlaceInBody BodyAccount<K>::place(std::size_t k, std::size_t p) const {
  const auto x = body_.points.position(p);
  PlaceInBody at{.what = fmt::format("material point {}", body_.points.number[p] + 1),
                 .position = {x.begin(), x.end()}};
  for (const int c : grid_.cell_at(body_.points.cell[k])) at.cell.push_back(c + 1);
  return at;
}

template <Kinematics K>
double BodyAccount<K>::shortest_time() const {
  double h = std::numeric_limits<double>::infinity(), shortest = h;
  for (const Axis& axis : grid_.axes) {
    for (int c = 0; c < axis.cells(); ++c) h = std::min(h, axis.nodes[c + 1] - axis.nodes[c]);
  }
  for (std::size_t m = 0; m < body_.materials.size(); ++m) {
    const double largest = body_.materials[m]->wave_modulus();
    shortest = std::min(shortest, h / 2 * std::sqrt(body_.smallest_density[m] / largest));
  }
  return shortest;
}

template class BodyAccount<Kinematics::line>;
template class BodyAccount<Kinematics::plane>;
template class BodyAccount<Kinematics::axisymmetric>;
template class BodyAccount<Kinematics::space>;

}  // namespace stillpoint
