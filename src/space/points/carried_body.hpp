// What the material points of one stage hand on to the next: where they are, how they move, and what they remember.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "space/materials/point_material.hpp"
#include "space/points/body.hpp"
#include "space/points/carried_points.hpp"
#include "space/points/material_points.hpp"
#include "space/points/point_order.hpp"
#include "space/points/value_by_place.hpp"

namespace stillpoint {

/// The rows of PointMaterial::memory() that are of the points themselves: not what parameters are by place, which is a
/// matter of the material that they have.
template <Kinematics K>
std::vector<std::size_t> remembered_rows(PointMaterial<K>& material, const MaterialSpec& spec, std::size_t count) {
  if (count == 0) return {};
  const Vec memory = material.memory();
  std::vector<char> is_by_place(memory.size() / count);
  for (const auto& [parameter, value] : spec.parameters) {
    const Vec row = material.by_place(parameter);
    if (!row.empty()) is_by_place[static_cast<std::size_t>(row.data() - memory.data()) / count] = 1;
  }
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < is_by_place.size(); ++row)
    if (!is_by_place[row]) rows.push_back(row);
  return rows;
}

/// The stored states of the points of a material.
template <Kinematics K>
struct CarriedMaterial {
  static constexpr std::size_t stresses = stress_components(K);

  std::string law;  // with the library that it comes from
  bool undrained = false, remembers = false;
  std::size_t begin = 0, count = 0;  // its points are begin … begin + count − 1
  std::vector<double> memory{};      // remembered_rows() of PointMaterial::memory(), (rows × count)
  std::vector<double> stress{};      // without a pore pressure, (count × stress components) [Pa]
  std::vector<std::string> names{};  // of the history that is shown
  std::vector<double> shown{};       // (names × count)

  static std::string law_of(const MaterialSpec& spec) { return spec.law + spec.library.string(); }
  /// H: the displacement gradients of all points in a phase that is not over; empty: the phase has ended.
  static CarriedMaterial of(PointMaterial<K>& material, const MaterialSpec& spec, std::size_t begin, std::size_t count,
                            const std::vector<TensorOf<K>>& H) {
    CarriedMaterial carried{.law = law_of(spec),
                            .undrained = spec.undrained,
                            .remembers = material.info().history_dependent,
                            .begin = begin,
                            .count = count};
    const Vec memory = material.memory();
    for (const std::size_t row : remembered_rows(material, spec, count)) {
      const ConstVec values = ConstVec(memory).subspan(count * row, count);
      carried.memory.insert(carried.memory.end(), values.begin(), values.end());
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto sigma = material.cauchy(H.empty() ? TensorOf<K>{} : H[begin + k], begin + k);
      carried.stress.insert(carried.stress.end(), sigma.begin(), sigma.end());
    }
    if (!carried.remembers && !H.empty()) {  // an elastic law in its only phase, which has not kept the deformation
      std::vector<double> rows;
      for (std::size_t c = 0; c < H[0].size(); ++c)
        for (std::size_t k = 0; k < count; ++k) rows.push_back(H[begin + k][c]);
      carried.memory.insert(carried.memory.begin(), rows.begin(), rows.end());
    }
    std::vector<double> pressure;
    for (std::size_t k = 0; k < count; ++k) {
      pressure.push_back(material.pore_pressure(H.empty() ? TensorOf<K>{} : H[begin + k], begin + k));
      for (std::size_t a = 0; a < std::min<std::size_t>(3, stresses); ++a)
        carried.stress[stresses * k + a] += pressure[k];
    }
    const auto show = [&carried](const std::string& name, ConstVec values) {
      carried.names.push_back(name);
      carried.shown.insert(carried.shown.end(), values.begin(), values.end());
    };
    for (const auto& [name, values] : material.shown_history()) show(name, values);
    if (material.info().pressure_by_deformation) show("pore_pressure", pressure);
    return carried;
  }
  std::array<double, stresses> stress_at(std::size_t k) const {
    std::array<double, stresses> sigma;
    std::copy_n(stress.begin() + static_cast<std::ptrdiff_t>(stresses * k), stresses, sigma.begin());
    return sigma;
  }
  /// Whether points of another material of the same law remember the same, in so many rows.
  bool is_like(const MaterialSpec& spec, std::size_t rows) const {
    return law == law_of(spec) && undrained == spec.undrained && count > 0 && memory.size() == rows * count;
  }
  void archive(const StateArchive& state) {
    state("law", law, "undrained", undrained, "remembers", remembers, "begin", begin, "count", count, "memory", memory,
          "stress", stress, "names", names, "shown", shown);
    if (stress.size() != stresses * count || shown.size() != names.size() * count)
      throw StateError("what points of a material remember is not that of its points");
  }
};

template <Kinematics K>
class CarriedBodyOf final : public CarriedBody {
  static constexpr int dim = dimensions(K);

 public:
  CarriedBodyOf() = default;
  /// Of bodies that have come to the end of a phase; origin, placed: see PhaseFrame; in_place: of small strain, whose
  /// points stay where they are; H: see CarriedMaterial.
  CarriedBodyOf(const Problem& problem, Body<K>& body, const std::vector<double>& origin,
                const std::vector<double>& placed, bool in_place, double grid_moved, long phase,
                const std::vector<TensorOf<K>>& H)
      : points_(body.points),
        first_number_(body.first_number),
        origin_(origin),
        placed_(placed),
        in_place_(in_place),
        grid_moved_(grid_moved),
        phase_(phase) {
    for (const BodySpec& spec : problem.bodies) {
      fields.push_back(points_.field_of(bodies_.size()));
      bodies_.push_back(spec.number);
    }
    for (std::size_t m = 0; m < body.materials.size(); ++m) {
      const MaterialSpec& spec = problem.materials.at(body.material_names[m]);
      const auto begin = static_cast<std::size_t>(points_.material_begin[m]);
      const auto count = static_cast<std::size_t>(points_.material_begin[m + 1]) - begin;
      materials_.push_back(CarriedMaterial<K>::of(*body.materials[m], spec, begin, count, H));
      for (std::size_t p = begin; p < begin + count; ++p)
        density_.push_back(value_by_place(spec, "rho", initial_position(p)));
    }
  }

  /// The place of a body of the problem among those that are carried on; empty: it is new.
  std::optional<std::size_t> find(const BodySpec& spec) const {
    const auto found = std::ranges::find(bodies_, spec.number);
    if (found == bodies_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - bodies_.begin());
  }
  /// The fields of motion before, of those now; empty unless they are as many, of the same bodies.
  std::vector<int> fields_before(const Problem& problem, const MaterialPoints<dim>& points, int count) const {
    std::vector<int> before(static_cast<std::size_t>(count), -1);
    for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
      const auto b = find(problem.bodies[k]);
      int& field = before[static_cast<std::size_t>(points.field_of(k))];
      if (!b || field == fields[*b]) continue;
      if (field >= 0) return {};
      field = fields[*b];
    }
    std::vector<int> sorted = before;
    std::ranges::sort(sorted);
    return std::ranges::adjacent_find(sorted) == sorted.end() ? before : std::vector<int>();
  }
  /// The points of body b, with their numbers in it. material: theirs from now on; source: where each is among all that
  /// are carried on.
  MaterialPoints<dim> points_of(std::size_t b, const MaterialSpec& material, std::vector<int>& source) const {
    std::vector<int> from;
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (points_.number[p] >= first_number_[b] && points_.number[p] < first_number_[b + 1])
        from.push_back(static_cast<int>(p));
    MaterialPoints<dim> points = points_;
    take_points(points, from);
    for (std::size_t k = 0; k < from.size(); ++k) {
      points.number[k] -= first_number_[b];
      const auto p = static_cast<std::size_t>(from[k]);
      const double density = value_by_place(material, "rho", initial_position(p));
      if (density != density_[p]) points.mass[k] *= density / density_[p];
    }
    source.insert(source.end(), from.begin(), from.end());
    return points;
  }
  std::size_t numbers_of(std::size_t b) const {
    return static_cast<std::size_t>(first_number_[b + 1] - first_number_[b]);
  }
  /// The position of point p when the run began, by which parameters are evaluated.
  std::vector<double> initial_position(std::size_t p) const {
    const auto first = origin_.begin() + static_cast<std::ptrdiff_t>(dim) * points_.number[p];
    return {first, first + dim};
  }
  const CarriedMaterial<K>& material_of(std::size_t p) const {
    std::size_t m = 0;
    while (p >= materials_[m].begin + materials_[m].count) ++m;
    return materials_[m];
  }
  /// Where the points of body b were placed, and how far each has moved since [m].
  std::pair<MaterialPoints<dim>, std::array<std::vector<double>, dim>> ways_of(std::size_t b) const {
    const std::vector<double>& from = where_placed();
    MaterialPoints<dim> placed;
    std::array<std::vector<double>, dim> moved;
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const int number = points_.number[p];
      if (number < first_number_[b] || number >= first_number_[b + 1]) continue;
      for (std::size_t d = 0; d < dim; ++d) {
        const double X = from[dim * static_cast<std::size_t>(number) + d];
        moved[d].push_back(points_.x[d][p] - X);
        placed.x[d].push_back(in_place_ ? points_.x[d][p] : X);
      }
      placed.volume.push_back(points_.volume[p]);
      placed.mass.push_back(points_.mass[p]);
      placed.number.push_back(number);
    }
    return {std::move(placed), std::move(moved)};
  }
  /// Whether they have moved so by displacements that left them in place, at small strain.
  bool is_in_place() const { return in_place_; }
  /// Replaces the positions at the start of the run of those points that are carried on; body: as it goes on.
  void take_origin(const Problem& problem, const std::vector<int>& first_number, std::vector<double>& origin) const {
    take(origin_, problem, first_number, origin);
  }
  /// The same of where their bodies were placed, which another run may have begun after.
  void take_placed(const Problem& problem, const std::vector<int>& first_number, std::vector<double>& placed) const {
    take(where_placed(), problem, first_number, placed);
  }
  /// Whether displacements count from later on.
  bool has_forgotten() const { return !placed_.empty(); }
  void begin_other_run(const std::vector<std::size_t>& numbers, bool forgets) override {
    bodies_ = numbers;
    for (auto& v : points_.v) std::ranges::fill(v, 0.0);
    for (auto& B : points_.B_apic) std::ranges::fill(B, 0.0);
    if (forgets && placed_.empty()) placed_ = origin_;
    for (std::size_t p = 0; p < points_.size() && forgets; ++p) {
      for (std::size_t d = 0; d < dim; ++d)
        origin_[dim * static_cast<std::size_t>(points_.number[p]) + d] = points_.x[d][p];
    }
    conditions.clear();
    out_of_balance.clear();
    rest = {};
    grid_moved_ = 0;
    phase_ = 0;
  }
  double grid_moved() const { return grid_moved_; }
  long phase() const { return phase_; }

  void archive(const StateArchive& state) override {
    for (int d = 0; d < dim; ++d) {
      state(fmt::format("x_{}", d), points_.x[d]);
      state(fmt::format("v_{}", d), points_.v[d]);
    }
    for (std::size_t ij = 0; ij < points_.B_apic.size(); ++ij) state(fmt::format("B_{}", ij), points_.B_apic[ij]);
    const StateArchive domains = state.part("domains");
    if (state.restores() ? state.has_part("domains") : points_.has_domains()) archive_domains(domains);
    if (state.restores() ? state.has_part("placed") : !placed_.empty()) state.part("placed")("positions", placed_);
    state("volume", points_.volume, "mass", points_.mass, "density", density_, "number", points_.number, "bodies",
          bodies_, "first_number", first_number_, "origin", origin_, "in_place", in_place_, "grid_moved", grid_moved_,
          "phase", phase_);
    std::size_t count = materials_.size();
    state("materials", count);
    if (count > points_.size()) throw StateError("it has more materials than points");
    materials_.resize(count);
    for (std::size_t m = 0; m < count; ++m) materials_[m].archive(state.part(fmt::format("material_{}", m)));
    state("out_of_balance", out_of_balance, "fields", fields);
    rest.archive(state.part("rest"));
    state.part("conditions").everything(conditions);
    if (state.restores()) check();
  }

 private:
  const std::vector<double>& where_placed() const { return placed_.empty() ? origin_ : placed_; }
  void take(const std::vector<double>& from, const Problem& problem, const std::vector<int>& first_number,
            std::vector<double>& to) const {
    for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
      if (const auto b = find(problem.bodies[k]))
        std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(dim) * first_number_[*b], dim * numbers_of(*b),
                    to.begin() + static_cast<std::ptrdiff_t>(dim) * first_number[k]);
    }
  }
  void archive_domains(const StateArchive& state) {
    for (std::size_t c = 0; c < points_.corner.size(); ++c) state(fmt::format("corner_{}", c), points_.corner[c]);
    for (std::size_t d = 0; d < dim; ++d)
      state(fmt::format("half_{}", d), points_.half[d], fmt::format("rest_{}", d), points_.rest[d]);
  }

  // Throws StateError unless loops over the points and their numbers stay within what there is.
  void check() const {
    const std::size_t n = points_.size();
    bool fits = points_.mass.size() == n && density_.size() == n && points_.number.size() == n &&
                first_number_.size() == bodies_.size() + 1 && !first_number_.empty() && first_number_.front() == 0 &&
                std::ranges::is_sorted(first_number_) &&
                origin_.size() == static_cast<std::size_t>(dim) * static_cast<std::size_t>(first_number_.back());
    fits = fits && (placed_.empty() || placed_.size() == origin_.size());
    for (int d = 0; d < dim; ++d)
      fits = fits && points_.x[d].size() == n && (points_.v[d].empty() || points_.v[d].size() == n);
    for (const auto& B : points_.B_apic) fits = fits && (B.empty() || B.size() == n);
    const std::size_t domains = points_.has_domains() ? n : 0;
    for (const auto& x : points_.corner) fits = fits && x.size() == domains;
    for (std::size_t d = 0; d < dim; ++d)
      fits = fits && points_.half[d].size() == domains && points_.rest[d].size() == domains;
    for (const int number : points_.number) fits = fits && number >= 0 && number < first_number_.back();
    std::size_t end = 0;
    for (const CarriedMaterial<K>& material : materials_) {
      fits = fits && material.begin == end;
      end += material.count;
    }
    fits = fits && fields.size() == bodies_.size();
    if (!fits || end != n) throw StateError("the points that a stage took over were altered");
  }

  MaterialPoints<dim> points_;
  std::vector<std::size_t> bodies_;  // BodySpec::number of each
  std::vector<int> first_number_;
  std::vector<CarriedMaterial<K>> materials_;
  std::vector<double> origin_;   // (P × dim) [m]
  std::vector<double> placed_;   // where bodies were placed, if displacements count from later on; else empty
  bool in_place_ = false;        // see the constructor
  std::vector<double> density_;  // of each point [kg/m³]
  double grid_moved_ = 0;
  long phase_ = 0;
};

}  // namespace stillpoint
