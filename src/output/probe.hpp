// The interface of all kinds of probes, and the moment at which they are read.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/state_archive.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/place_reader.hpp"

namespace stillpoint {

/// The data that probes read, each field made once and only if a probe asks for it. The state is that of the last
/// commit.
class ProbedMoment {
 public:
  /// All arguments have to outlive this object.
  ProbedMoment(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u, ConstVec v)
      : problem_(problem), phase_(phase), t_(t), u_(u), v_(v) {}

  double t() const { return t_; }
  const LagrangianPhase& phase() const { return phase_; }
  /// A field at the material points, as point_field() gives it, and also "position".
  const std::vector<double>& field(const std::string& name);
  const PlaceReader& places();
  /// The angle of the free surface's slope [degrees].
  double slope_angle();

 private:
  const Problem& problem_;
  const LagrangianPhase& phase_;
  double t_;
  ConstVec u_, v_;
  std::map<std::string, std::vector<double>> fields_;
  std::unique_ptr<PlaceReader> places_;
  std::optional<double> slope_angle_;
};

class Probe {
 public:
  virtual ~Probe() = default;
  /// Appends a value for each field.
  virtual void read(ProbedMoment& moment, std::vector<double>& values) = 0;
  /// Its position when the run began, (dim) [m]; empty if the probe has no point.
  virtual std::vector<double> position() const { return {}; }
  /// end_phase() is called before a phase ends, begin_phase() once the next has begun, if it has.
  virtual void end_phase(ProbedMoment&) {}
  virtual void begin_phase(ProbedMoment&) {}
  /// end_stage() is called after end_phase(); begin_stage() of the probe that is made for the next stage, once
  /// archive() has restored what this one saved.
  virtual void end_stage() {}
  virtual void begin_stage(ProbedMoment&) {}
  virtual void archive(const StateArchive&) {}
  /// A sentence on the values that the user should know, if any.
  virtual std::optional<std::string> note() const { return std::nullopt; }
};

// Kinds that have a file of their own:
/// waits: until there is material at the place, which a later stage may bring.
std::unique_ptr<Probe> moving_place(const LagrangianPhase& phase, const ProbeSpec& spec, bool waits);
std::unique_ptr<Probe> fixed_place(const LagrangianPhase& phase, const ProbeSpec& spec);
/// Its values are NaN if no point is in the box.
bool has_points_in_box(const PointData& data, const ProbeSpec& spec);
std::unique_ptr<Probe> mean_in_box(const LagrangianPhase& phase, const PointData& data, const ProbeSpec& spec);
std::unique_ptr<Probe> body_sums(const PointData& data, const ProbeSpec& spec);

}  // namespace stillpoint
