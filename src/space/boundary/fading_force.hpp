// The force by which a stage of construction comes on: what it puts out of balance at its begin, F − R, is borne at
// first by its opposite, which fades,
//
//   F(t) = F_loads(t) − (1 − s) (F − R)_begin,   s = (t − begin)/(over − begin), at most 1.
//
// So weight that is placed comes on, and what dug material or released supports bore goes, in proportion. The forces
// act at the nodes of the first phase of the stage and are carried by the material from there, like point forces.
#pragma once

#include <stillpoint/state_archive.hpp>
#include <stillpoint/types.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "space/boundary/boundary_condition.hpp"
#include "space/boundary/carried_point.hpp"

namespace stillpoint {

template <int Dim>
class FadingForce {
  using Parts = PhaseParts<Dim>;

 public:
  /// Begins at t, in the first phase of a stage; out_of_balance: F − R there, (n) [N].
  void begin(const Parts& phase, double t, double over, ConstVec out_of_balance) {
    begin_ = t;
    over_ = over;
    in_first_phase_ = true;
    places_.clear();
    force_.assign(phase.dofs.size(), 0);
    for (std::size_t k = 0; k < force_.size(); ++k) force_[k] = -out_of_balance[k];
    for (std::size_t k = 0; k < force_.size(); ++k) {
      const int function = phase.dofs.free[k] / Dim, component = phase.dofs.free[k] % Dim;
      if (places_.empty() || places_.back().function != function) places_.push_back(place_of(phase, function));
      places_.back().force[static_cast<std::size_t>(component)] = force_[k];
    }
  }
  bool acts() const { return over_ > begin_; }
  bool is_over(double t) const { return !acts() || t >= over_; }

  /// In a later phase the functions around each place share its force.
  void begin_phase(const Parts& phase) {
    if (!acts()) return;
    in_first_phase_ = false;
    force_.assign(phase.dofs.size(), 0);
    for (Place& place : places_) {
      CarriedPoint<Dim> at;
      at.x = place.x;
      at.field = place.field;
      const double reached = at.freeze(cell_with_functions_at<Dim>(phase.functions, at.x), phase);
      place.entries = std::move(at.entries);
      if (!(reached > 0)) continue;  // no material is left around it
      for (auto& entry : place.entries) entry.w /= reached;
      for (const auto& entry : place.entries) {
        for (int i = 0; i < Dim && entry.function >= 0; ++i) {
          phase.dofs.for_sources(Dim * entry.function + i, [&](int, int dof, double share) {
            if (phase.dofs.is_free(dof))
              force_[static_cast<std::size_t>(dof)] += entry.w * share * place.force[static_cast<std::size_t>(i)];
          });
        }
      }
    }
  }
  void add_load(double t, Vec F) const {
    if (is_over(t)) return;
    const double left = std::min(1.0, (over_ - t) / (over_ - begin_));
    for (std::size_t k = 0; k < F.size(); ++k) F[k] += left * force_[k];
  }
  void end_phase(const double* u) {
    for (Place& place : places_) {
      if (in_first_phase_) {
        for (int i = 0; i < Dim; ++i) place.x[i] += u[Dim * place.function + i];
        continue;
      }
      for (const auto& entry : place.entries) {
        for (int i = 0; i < Dim && entry.function >= 0; ++i) place.x[i] += entry.w * u[Dim * entry.function + i];
      }
    }
  }

  void archive(const StateArchive& state) {
    std::vector<double> x, force;
    std::vector<int> field, function;
    for (const Place& place : places_) {
      x.insert(x.end(), place.x.begin(), place.x.end());
      force.insert(force.end(), place.force.begin(), place.force.end());
      field.push_back(place.field);
      function.push_back(place.function);
    }
    state("begin", begin_, "over", over_, "in_first_phase", in_first_phase_);
    state("x", x, "force", force, "field", field, "function", function, "nodal", force_);
    if (!state.restores()) return;
    if (x.size() != Dim * field.size() || force.size() != x.size() || function.size() != field.size())
      throw StateError("the places of a fading force and their forces differ in number");
    places_.resize(field.size());  // the entries are those of the phase that has begun anew
    for (std::size_t k = 0; k < places_.size(); ++k) {
      std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(Dim * k), Dim, places_[k].x.begin());
      std::copy_n(force.begin() + static_cast<std::ptrdiff_t>(Dim * k), Dim, places_[k].force.begin());
      places_[k].field = field[k];
      places_[k].function = function[k];
    }
  }

 private:
  struct Place {
    Point<Dim> x{};
    Point<Dim> force{};                                        // [N]
    int field = 0;                                             // the field of motion that carries it
    int function = 0;                                          // of the first phase, at which it begins
    std::vector<typename CarriedPoint<Dim>::Entry> entries{};  // of a later phase, with their weights
  };

  static Place place_of(const Parts& phase, int function) {
    Place place;
    place.function = function;
    place.field = function / phase.functions.count_of_field();
    for (int d = 0; d < Dim; ++d) place.x[d] = phase.functions.centre(function, d);
    return place;
  }

  double begin_ = 0, over_ = 0;  // [s]; the same: nothing fades
  bool in_first_phase_ = true;   // at whose functions the forces act
  std::vector<Place> places_;
  std::vector<double> force_;  // −(F − R) of the begin, in the present phase, (n) [N]
};

}  // namespace stillpoint
