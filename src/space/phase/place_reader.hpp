// Fields at places of the body, of which few coincide with a material point.
#pragma once

#include <stillpoint/types.hpp>

#include <string>

namespace stillpoint {

/// At one moment of a phase. A place x is a position when the phase began, (dim) [m].
///
/// Displacement, velocity and strain are those of the grid's functions, Σ_a N_a(x) u_a. Stress, and what the laws
/// remember, live at the material points: they are fitted to those around x of the material of the nearest one, by
/// polynomials whose degree is that of the basis less one, and no less than one, as far as the points determine them.
class PlaceReader {
 public:
  virtual ~PlaceReader() = default;
  /// Whether there are material points in the cell of x, or in one that x is on the border of, but for rounding.
  virtual bool holds(ConstVec x) const = 0;
  /// Whether x can be read: or is no further than a cell's width from the cell of the nearest material point, whose
  /// functions are continued to there, as behind a surface that has come into a cell before any point did.
  virtual bool reaches(ConstVec x) const = 0;
  /// Brings a place that a step has taken past a face of the grid, by less than a tenth of a cell, back onto it, as
  /// material points are.
  virtual void put_back(Vec x) const = 0;

  /// Since the phase began, (dim) [m]. Here as below: NaN where x cannot be read.
  virtual void displacement(ConstVec x, Vec out) const = 0;
  /// (dim) [m/s]
  virtual void velocity(ConstVec x, Vec out) const = 0;
  /// ∂u/∂x since the phase began, (gradient components).
  virtual void strain(ConstVec x, Vec out) const = 0;
  /// Cauchy's, (stress components) [Pa].
  virtual void stress(ConstVec x, Vec out) const = 0;
  /// One of PhaseInfo::history_names. Nowhere negative if it is so at no point.
  virtual double history(const std::string& name, ConstVec x) const = 0;
};

}  // namespace stillpoint
