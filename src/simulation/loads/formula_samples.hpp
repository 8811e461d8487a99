// The moments and positions at which a formula has to be looked at, so that no pulse of it is missed.
#pragma once

#include <stillpoint/expression.hpp>
#include <stillpoint/problem.hpp>
#include <stillpoint/types.hpp>

#include <optional>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// Moments from 0 to end [s], in order, at which the formula at x is to be looked at: `moments` evenly spaced ones, as
/// many off that raster, since a formula may have its period, and those at which one of its comparisons switches or one
/// of its functions may bend, with what lies between any two of these. 0 and end are among them.
std::vector<double> moments_of_change(const Expression& formula, ConstVec x, int moments, double end);

/// The first moment from which on the formula does not depend on a comparison that switches more often than `times`,
/// those of moments_of_change(), can tell; 0 if it has none, end if it depends on it to the end.
double unresolved_until(const Expression& formula, ConstVec x, ConstVec times, double same);

/// A time [s] after which the formula at x stays what it is, if nothing says how long a run lasts: twice the last
/// moment at which it changes. It is looked at from 1e-9 to 1e12 s, at moments each 6 % after the last, and at those at
/// which its comparisons switch or its functions bend. Empty if it goes on to change, or is not a finite number.
std::optional<double> open_end(const Expression& formula, ConstVec x);

/// Positions, (n × dim) [m], that stand for all at which the formula of a key such as "traction[0].value" is needed.
/// For a traction or a support these are a thousand along its line or face, or eight to a cell, none at the ends;
/// otherwise they are the material points.
std::vector<double> formula_positions(const Problem& problem, const LagrangianPhase& phase, const std::string& key);

}  // namespace stillpoint
