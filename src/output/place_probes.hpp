// Probes of places: one that moves with the material, and one that is fixed in space.
#pragma once

#include "output/point_fields.hpp"
#include "output/probe.hpp"

namespace stillpoint {

/// The fields that can be read at a place.
class PlaceFields {
 public:
  PlaceFields(const LagrangianPhase& phase, const std::vector<std::string>& names);
  std::size_t size() const { return fields_.size(); }
  /// Appends the value of each field at x, a position when the phase began. The displacement is the sum of that since
  /// then and moved_before, (dim).
  void read(const PlaceReader& places, const std::vector<double>& x, const std::vector<double>& moved_before,
            std::vector<double>& values) const;

 private:
  std::vector<PointFieldComponent> fields_;
};

/// A place that moves by x += Σ_a N_a(x) u_a when a phase ends. Once no material reaches it, it is lost: its values are
/// NaN.
class MovingPlace final : public Probe {
 public:
  MovingPlace(const LagrangianPhase& phase, const ProbeSpec& spec);
  void read(ProbedMoment& moment, std::vector<double>& values) override;
  std::vector<double> position() const override { return start_; }
  void end_phase(ProbedMoment& moment) override;
  void begin_phase(ProbedMoment& moment) override;
  void archive(const StateArchive& state) override;
  std::optional<std::string> note() const override;

 private:
  std::string name_;
  PlaceFields fields_;
  std::vector<double> start_, x_, next_;  // at the beginning of the run, of this phase and of the next [m]
  std::optional<double> lost_at_;         // time of the loss [s]
};

/// Reads the material at the place at each moment: that whose place X when the phase began has X + u(X) = x. NaN while
/// there is none.
class FixedPlace final : public Probe {
 public:
  FixedPlace(const LagrangianPhase& phase, const ProbeSpec& spec) : fields_(phase, spec.fields), x_(spec.at) {}
  void read(ProbedMoment& moment, std::vector<double>& values) override;

 private:
  PlaceFields fields_;
  std::vector<double> x_;  // [m]
};

}  // namespace stillpoint
