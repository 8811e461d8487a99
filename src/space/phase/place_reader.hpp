// Fields at places of the body, few of which coincide with a material point.
#pragma once

#include <stillpoint/types.hpp>

#include <string>

namespace stillpoint {

/// Reads fields at one moment of a phase. A place x is a position when the phase began, (dim) [m].
///
/// Displacement, velocity and strain are those of the grid's functions, Σ_a N_a(x) u_a. Stress and history are known at
/// the material points: they are fitted to those points around x that have the material of the nearest one, by
/// polynomials whose degree is that of the basis, 4 for cubic ones, as far as the points determine them. The error of
/// the points' own stress, of the order of the basis's degree, changes its sign within a cell: a fit over the cells
/// around evens it out [Zienkiewicz and Zhu 1992, for finite elements]. Amid points on all sides the fit is an order
/// better with a linear or quadratic basis; with a cubic one, and at borders, it has the order of the points.
class PlaceReader {
 public:
  virtual ~PlaceReader() = default;
  /// Whether there are material points in the cell of x, or in a cell on whose border x lies, to rounding.
  virtual bool holds(ConstVec x) const = 0;
  /// Whether x can be read, inside the material or no further than a cell's width from the cell of the nearest material
  /// point, whose functions are extrapolated to x, as behind a surface that has come into a cell before any point did.
  virtual bool reaches(ConstVec x) const = 0;
  /// Puts a place that a step has taken past a face of the grid, by less than a tenth of a cell, back onto the face, as
  /// is done with material points.
  virtual void put_back(Vec x) const = 0;

  /// The displacement since the phase began, (dim) [m]. Here and below: NaN where x cannot be read.
  virtual void displacement(ConstVec x, Vec out) const = 0;
  /// The velocity, (dim) [m/s].
  virtual void velocity(ConstVec x, Vec out) const = 0;
  /// The strain ∂u/∂x since the phase began, (gradient components).
  virtual void strain(ConstVec x, Vec out) const = 0;
  /// The Cauchy stress, (stress components) [Pa].
  virtual void stress(ConstVec x, Vec out) const = 0;
  /// That of the water in the pores; 0 in drained ground [Pa]. As history() in its sign.
  virtual double pore_pressure(ConstVec x) const = 0;
  /// The value of one of PhaseInfo::law_fields, but for pore_pressure. It is negative only if it is so at some point.
  virtual double history(const std::string& name, ConstVec x) const = 0;
};

}  // namespace stillpoint
