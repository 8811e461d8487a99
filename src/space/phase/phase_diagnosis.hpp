// Messages about a phase that fails: which point or node, which quantity, what to try.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/phase_assembly.hpp"
#include "space/phase/place_of_ranks.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class PhaseDiagnosisOf final : public PhaseDiagnosis {
  static constexpr int dim = dimensions(K), per_cell = PointWeights<B, K>::per_cell;
  static constexpr int components = stillpoint::gradient_components(K);
  using Block = PointBlock<K>;

 public:
  /// all: must outlive this object.
  explicit PhaseDiagnosisOf(const PhaseAssembly<B, K>& all) : all_(all), frame_(all.frame) {}

  PlaceInBody of_point(std::size_t number) const override { return frame_.account().place_of(number); }

  std::vector<std::string> notes_of_laws() const override {
    std::vector<std::string> notes = frame_.notes;
    for (const auto& material : frame_.body.materials) std::ranges::move(material->notes(), std::back_inserter(notes));
    return notes;
  }

  // The place of an unknown, beside the point at which the function's |N| is largest.
  PlaceInBody of_unknown(std::size_t unknown) const override {
    const int function = frame_.dofs().free[unknown] / dim;
    PlaceInBody at{.what = "the node"};
    for (int d = 0; d < dim; ++d) at.position.push_back(frame_.functions.centre(function, d));
    double largest = -1;
    PlaceInBody beside;
    CellPlace cell;
    frame_.for_points([&](std::size_t k, std::size_t p, std::size_t) {
      const auto N = frame_.weights.N(k, p);
      for (int a = 0; a < per_cell; ++a) {
        if (frame_.weights.function(k, a) != function || !(std::abs(N[a]) > largest)) continue;
        largest = std::abs(N[a]);
        beside = frame_.account().place(k, p);
        cell = place_of_cell(frame_.body.points, k);
      }
    });
    if (largest < largest_of_all(frame_.ranks, largest)) beside = {};
    beside = place_of_ranks(frame_.ranks, beside, cell);
    at.material_point = beside.what;
    at.cell = beside.cell;
    return at;
  }

  std::string refusal(TrialState& trial) const override {
    const auto& of_phase = dynamic_cast<PhaseTrial&>(trial);
    if (of_phase.phase != frame_.phase) throw std::logic_error("a trial state that was made for another phase");
    return trial.too_far ? refusal_of_motion(frame_.unknowns.free_values(of_phase.arrays->u))
                         : refusal_at_points(of_phase);
  }

 private:
  std::string refusal_of_motion(const std::vector<double>& u) const {
    std::size_t furthest = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      if (!(std::abs(u[k]) <= std::abs(u[furthest]))) furthest = k;
    }
    return fmt::format(
        "{} would move by {:.3g} m within one step, further than a phase may go; expected a smaller "
        "integrator.step_fraction, loads that grow more slowly, or a larger phase.max_motion",
        to_string(of_unknown(furthest)), u[furthest]);
  }

  // The name of a component of P: "P.xy".
  static std::string name_of_stress(int component) {
    constexpr const char* axes = K == Kinematics::axisymmetric ? "rz" : "xyz";
    if (component == dim * dim) return "P.tt";
    return std::string("P.") + axes[component / dim] + axes[component % dim];
  }

  // The message about the point with the smallest det f among those without a finite stress; of several the first by
  // number.
  std::string refusal_at_points(const PhaseTrial& trial) const {
    struct Bad {
      double det_f = 0, stress = 0;
      int component = 0;
      std::size_t material = 0;
      int number = 0;
    };
    std::vector<Bad> all;
    std::mutex all_is_written;
    const MaterialPoints<dim>& points = frame_.body.points;
    const InternalForce<B, K>& force = all_.force;
    const double dt = frame_.remembers ? trial.t - force.committed().t : 0;
    const auto work = force.borrow();
    const auto look = [&](std::size_t m, Block& block) {
      double* history = frame_.remembers ? trial.arrays->history[m].data() : nullptr;
      std::array<double, Block::size> det;  // det f of the displacement itself, not of a mean
      for (std::size_t q = 0; q < block.count; ++q) det[q] = determinant<K>(plus_identity<K>(block.H_at(q)));
      force.laws().template stress<true>(m, block, dt, history, nullptr, *work);
      for (std::size_t q = 0; q < block.count; ++q) {
        for (int c = 0; c < components; ++c) {
          if (std::isfinite(block.VP[c][q])) continue;
          const std::size_t p = block.first + q;
          const std::scoped_lock lock(all_is_written);
          all.push_back({det[q], block.VP[c][q], c, m, points.number[p]});
          break;
        }
      }
    };
    force.laws().take_means(trial.arrays->u.data(), *work);
    force.points().template visit<true>(trial.arrays->u.data(), std::cref(look), force.committed().u.data());
    all = joined_lists(frame_.ranks, std::move(all));
    if (all.empty()) return "a stress that is not finite";
    const Bad worst = *std::ranges::min_element(
        all, [](const Bad& a, const Bad& b) { return std::pair(a.det_f, a.number) < std::pair(b.det_f, b.number); });
    const std::string at = to_string(frame_.account().place_of(static_cast<std::size_t>(worst.number)));
    const std::string others = all.size() > 1 ? fmt::format(" (and at {} other points)", all.size() - 1) : "";
    if (!std::isfinite(worst.det_f)) return "the displacement is not finite at " + at + others;
    if (worst.det_f <= 0) {
      return fmt::format(
          "det f = {:.3g} <= 0 at {}{}: the material is turned inside out; expected loads that are smaller or grow "
          "more slowly, a smaller integrator.step_fraction{}",
          worst.det_f, at, others, frame_.moves_on() ? "" : ", or phases that end (phase.max_motion = 0.1)");
    }
    return fmt::format(
        "the stress {} of the law is not finite ({}) at {}{}, where det f = {:.3g}; expected smaller loads, a smaller "
        "integrator.step_fraction, or other parameters of material.{}",
        name_of_stress(worst.component), worst.stress, at, others, worst.det_f,
        frame_.body.material_names[worst.material]);
  }

  const PhaseAssembly<B, K>& all_;
  const PhaseFrame<B, K>& frame_;
};

}  // namespace stillpoint
