// Probes of places: one that moves with the material, and one that is fixed in space.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <fmt/format.h>

#include "output/point_fields.hpp"
#include "output/probe.hpp"

namespace stillpoint {
namespace {

// Solves X + u(X) = x by X ← x − u(X), which contracts, since a phase strains by little.
std::optional<std::vector<double>> material_at(const std::vector<double>& x, const PlaceReader& places) {
  constexpr int most = 100;
  constexpr double rounding = 1e-12;
  std::vector<double> X = x, u(x.size());
  for (int k = 0; k < most; ++k) {
    places.displacement(X, u);
    double change = 0, size = 0;
    for (std::size_t d = 0; d < x.size(); ++d) {
      const double next = x[d] - u[d];
      change = std::max(change, std::abs(next - X[d]));
      size = std::max({size, std::abs(u[d]), std::abs(x[d])});
      X[d] = next;
      if (std::isnan(next)) return std::nullopt;
    }
    if (change <= rounding * size) break;
  }
  if (!places.holds(X)) return std::nullopt;
  return X;
}

/// The fields that can be read at a place.
class PlaceFields {
 public:
  PlaceFields(const LagrangianPhase& phase, const std::vector<std::string>& names)
      : has_water_(is_field(phase, "pore_pressure")) {
    for (const std::string& name : names) {
      fields_.push_back(find_point_field(phase, name));
      is_there_.push_back(is_field(phase, fields_.back().name));
    }
  }
  std::size_t size() const { return fields_.size(); }
  /// Appends the value of each field at x, a position when the phase began. The displacement is the sum of that since
  /// then and moved_before, (dim).
  void read(const PlaceReader& places, const std::vector<double>& x, const std::vector<double>& moved_before,
            std::vector<double>& values) const {
    std::map<std::string, std::vector<double>> read;  // each field once, whatever components are asked for
    for (std::size_t f = 0; f < fields_.size(); ++f) {
      const PointFieldComponent& field = fields_[f];
      const auto [all, is_new] =
          read.try_emplace(field.name, field.components, std::numeric_limits<double>::quiet_NaN());
      if (is_new && is_there_[f]) read_field(field.name, places, x, moved_before, all->second);
      values.push_back(all->second[field.component]);
    }
  }

 private:
  void read_field(const std::string& name, const PlaceReader& places, const std::vector<double>& x,
                  const std::vector<double>& moved_before, std::vector<double>& all) const {
    if (name == "u") {
      places.displacement(x, all);
      for (std::size_t d = 0; d < all.size(); ++d) all[d] += moved_before[d];
    } else if (name == "v") {
      places.velocity(x, all);
    } else if (name == "strain") {
      places.strain(x, all);
    } else if (name == "stress") {
      places.stress(x, all);
    } else if (name == "effective_stress") {
      places.stress(x, all);
      if (has_water_) make_effective(all, places.pore_pressure(x));
    } else if (name == "pore_pressure") {
      all[0] = places.pore_pressure(x);
    } else {
      all[0] = places.history(name, x);
    }
  }

  std::vector<PointFieldComponent> fields_;
  std::vector<bool> is_there_;  // not in a stage whose laws have no such field
  bool has_water_;
};

/// A place that moves by x += Σ_a N_a(x) u_a when a phase ends; under laws of small strain it stays, and what it moved
/// is counted. Once no material reaches it, it is lost: its values are
/// NaN.
class MovingPlace final : public Probe {
 public:
  MovingPlace(const LagrangianPhase& phase, const ProbeSpec& spec, bool waits)
      : name_(spec.name),
        fields_(phase, spec.fields),
        start_(spec.at),
        x_(spec.at),
        next_(spec.at),
        moved_in_place_(spec.at.size(), 0),
        stays_(phase.info().of_small_strain) {
    if (!waits) return;
    const std::vector<double> nothing(phase.size(), 0.0);
    waits_ = !phase.fields().read_places(0, nothing, nothing)->holds(start_);
  }
  void read(ProbedMoment& moment, std::vector<double>& values) override {
    if (lost_at_ || waits_)
      return values.resize(values.size() + fields_.size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<double> moved = x_;
    for (std::size_t d = 0; d < moved.size(); ++d) moved[d] += moved_in_place_[d] - start_[d];
    fields_.read(moment.places(), x_, moved, values);
  }
  std::vector<double> position() const override { return start_; }
  void end_phase(ProbedMoment& moment) override {
    if (lost_at_ || waits_) return;
    std::vector<double> u(x_.size());
    moment.places().displacement(x_, u);
    for (std::size_t d = 0; d < u.size(); ++d) (stays_ ? moved_in_place_[d] : next_[d] = x_[d]) += u[d];
  }
  // Called only now because the place is read once more if the next phase cannot begin.
  void begin_phase(ProbedMoment& moment) override {
    if (lost_at_ || waits_) return;
    x_ = next_;
    moment.places().put_back(x_);
    if (!moment.places().reaches(x_)) lost_at_ = moment.t();
  }
  void end_stage() override { x_ = next_; }
  void begin_stage(ProbedMoment& moment) override {
    waits_ = waits_ && !moment.places().holds(start_);
    next_ = x_;
    begin_phase(moment);
  }
  void archive(const StateArchive& state) override {
    state("x", Vec(x_));
    state("moved_in_place", Vec(moved_in_place_));
    state("lost_at", lost_at_, "waits", waits_);
  }
  std::optional<std::string> note() const override {
    if (waits_)
      return fmt::format(
          "probe {}: neither a stage nor another run has brought material to its place ({:.6g}) so far, and its values "
          "are nan",
          name_, fmt::join(start_, ", "));
    if (!lost_at_) return std::nullopt;
    return fmt::format(
        "probe {}: no material reaches its place ({:.6g}) since t = {:.6g} s, and its values are nan; "
        "expected a place further inside the body, or point = N, a material point",
        name_, fmt::join(x_, ", "), *lost_at_);
  }

 private:
  std::string name_;
  PlaceFields fields_;
  std::vector<double> start_, x_, next_;  // at the beginning of the run, of this phase and of the next [m]
  std::optional<double> lost_at_;         // time of the loss [s]
  std::vector<double> moved_in_place_;    // in the phases before this one [m]
  bool stays_;                            // whether the laws are those of small strain
  bool waits_ = false;                    // for a stage that brings material to the place
};

/// Reads the material at the place at each moment: that whose place X when the phase began has X + u(X) = x. NaN while
/// there is none.
class FixedPlace final : public Probe {
 public:
  FixedPlace(const LagrangianPhase& phase, const ProbeSpec& spec) : fields_(phase, spec.fields), x_(spec.at) {}
  void read(ProbedMoment& moment, std::vector<double>& values) override {
    const auto X = material_at(x_, moment.places());
    if (!X) return values.resize(values.size() + fields_.size(), std::numeric_limits<double>::quiet_NaN());
    fields_.read(moment.places(), *X, {}, values);
  }

 private:
  PlaceFields fields_;
  std::vector<double> x_;  // [m]
};

}  // namespace

std::unique_ptr<Probe> moving_place(const LagrangianPhase& phase, const ProbeSpec& spec, bool waits) {
  return std::make_unique<MovingPlace>(phase, spec, waits);
}
std::unique_ptr<Probe> fixed_place(const LagrangianPhase& phase, const ProbeSpec& spec) {
  return std::make_unique<FixedPlace>(phase, spec);
}

}  // namespace stillpoint
