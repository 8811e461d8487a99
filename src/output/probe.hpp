// A probe, of whatever kind, and the moment at which it is read.
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

/// What probes look at, each field made once and only if one asks for it. The state is that of the last commit.
class ProbedMoment {
 public:
  /// All outlive this.
  ProbedMoment(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u, ConstVec v)
      : problem_(problem), phase_(phase), t_(t), u_(u), v_(v) {}

  double t() const { return t_; }
  const LagrangianPhase& phase() const { return phase_; }
  /// At the material points, as point_field() gives it; "position" too.
  const std::vector<double>& field(const std::string& name);
  const PlaceReader& places();
  /// Of the free surface [degrees].
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
  /// Where it was when the run began, (dim) [m]; empty if it is not of a point.
  virtual std::vector<double> position() const { return {}; }
  /// Before a phase ends, and once the next has begun, if it has.
  virtual void end_phase(ProbedMoment&) {}
  virtual void begin_phase(ProbedMoment&) {}
  virtual void archive(const StateArchive&) {}
  /// What a user should know of its values.
  virtual std::optional<std::string> note() const { return std::nullopt; }
};

}  // namespace stillpoint
