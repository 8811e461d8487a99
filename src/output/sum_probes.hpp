// Probes that sum over material points: the mean of fields in a part of the body, and sums over the whole body.
#pragma once

#include "output/point_fields.hpp"
#include "output/probe.hpp"

namespace stillpoint {

/// Σ_p v_p f_p/Σ_p v_p over the points that were in a box when the run began, with their present volumes v_p.
class MeanInBox final : public Probe {
 public:
  /// Throws std::invalid_argument if no point is in the box.
  MeanInBox(const LagrangianPhase& phase, const PointData& data, const ProbeSpec& spec);
  void read(ProbedMoment& moment, std::vector<double>& values) override;

 private:
  std::vector<PointFieldComponent> fields_;
  std::vector<std::size_t> points_;
};

/// Sums over all points: the volume Σ v_p, the momentum Σ m_p v(x_p), the angular momentum about the origin
/// Σ m_p x_p × v(x_p), per unit of the thickness that the scene gives.
class BodySums final : public Probe {
 public:
  BodySums(const PointData& data, const ProbeSpec& spec) : names_(spec.fields), mass_(data.masses) {}
  void read(ProbedMoment& moment, std::vector<double>& values) override;

 private:
  double value(const std::string& name, ProbedMoment& moment) const;

  std::vector<std::string> names_;
  std::vector<double> mass_;  // constant masses of the points [kg]
};

}  // namespace stillpoint
