// Probes that sum over material points: the mean of fields in a part of the body, and sums over the whole body.
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "output/point_fields.hpp"
#include "output/probe.hpp"
#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

// The points that were in the box of a probe when the run began, or when a stage placed them.
std::vector<std::size_t> points_in_box(const PointData& data, const ProbeSpec& spec) {
  std::vector<std::size_t> points;
  const std::size_t dim = data.initial_positions.size() / std::max<std::size_t>(1, data.masses.size());
  for (std::size_t p = 0; p < data.masses.size(); ++p) {
    const double* const x = data.initial_positions.data() + dim * p;
    bool inside = true;
    for (std::size_t d = 0; d < dim; ++d) inside = inside && x[d] >= spec.min[d] && x[d] <= spec.max[d];
    if (inside) points.push_back(p);
  }
  return points;
}

/// Σ_p v_p f_p/Σ_p v_p over the points that were in a box when the run began, with their present volumes v_p.
class MeanInBox final : public Probe {
 public:
  MeanInBox(const LagrangianPhase& phase, const PointData& data, const ProbeSpec& spec) {
    for (const std::string& name : spec.fields) fields_.push_back(find_point_field(phase, name));
    points_ = points_in_box(data, spec);
  }
  void read(ProbedMoment& moment, std::vector<double>& values) override {
    const std::vector<double>& volume = moment.field("volume");
    for (const PointFieldComponent& field : fields_) {
      if (!is_field(moment.phase(), field.name)) {  // in a stage whose laws have none
        values.push_back(std::numeric_limits<double>::quiet_NaN());
        continue;
      }
      const std::vector<double>& of_points = moment.field(field.name);
      double sum = 0, all = 0;
      for (const std::size_t p : points_) {
        sum += volume[p] * of_points[field.components * p + field.component];
        all += volume[p];
      }
      values.push_back(sum / all);
    }
  }

 private:
  std::vector<PointFieldComponent> fields_;
  std::vector<std::size_t> points_;
};

/// Sums over all points: the volume Σ v_p, the momentum Σ m_p v(x_p), the angular momentum about the origin
/// Σ m_p x_p × v(x_p), per unit of the thickness that the scene gives.
class BodySums final : public Probe {
 public:
  BodySums(const PointData& data, const ProbeSpec& spec) : names_(spec.fields), mass_(data.masses) {}
  void read(ProbedMoment& moment, std::vector<double>& values) override {
    for (const std::string& name : names_) values.push_back(value(name, moment));
  }

 private:
  double value(const std::string& name, ProbedMoment& moment) const {
    double sum = 0;
    if (name == "volume") {
      for (const double v : moment.field("volume")) sum += v;
      return sum;
    }
    const std::vector<double>& v = moment.field("v");
    const std::size_t dim = v.size() / mass_.size();
    const auto number_among = [&](const std::vector<std::string>& names) {
      return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    const std::span<const Turn> turns = dimension_info(static_cast<int>(dim)).turns;
    const auto turn = number_among(component_names("angular_momentum", turn_names(static_cast<int>(dim))));
    if (turn < turns.size()) {
      const std::size_t i = turns[turn].from, j = turns[turn].to;
      const std::vector<double>& x = moment.field("position");
      for (std::size_t p = 0; p < mass_.size(); ++p)
        sum += mass_[p] * (x[dim * p + i] * v[dim * p + j] - x[dim * p + j] * v[dim * p + i]);
      return sum;
    }
    const std::size_t axis = number_among(component_names("momentum", axis_names(static_cast<int>(dim))));
    if (axis == dim) throw std::invalid_argument("there is no field " + name);
    for (std::size_t p = 0; p < mass_.size(); ++p) sum += mass_[p] * v[dim * p + axis];
    return sum;
  }

  std::vector<std::string> names_;
  std::vector<double> mass_;  // constant masses of the points [kg]
};

}  // namespace

bool has_points_in_box(const PointData& data, const ProbeSpec& spec) { return !points_in_box(data, spec).empty(); }
std::unique_ptr<Probe> mean_in_box(const LagrangianPhase& phase, const PointData& data, const ProbeSpec& spec) {
  return std::make_unique<MeanInBox>(phase, data, spec);
}
std::unique_ptr<Probe> body_sums(const PointData& data, const ProbeSpec& spec) {
  return std::make_unique<BodySums>(data, spec);
}

}  // namespace stillpoint
