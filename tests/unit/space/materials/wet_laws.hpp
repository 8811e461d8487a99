// Elastic laws whose pores are full of water that cannot flow.
#pragma once

#include <stillpoint/hencky.hpp>
#include <stillpoint/linear_elastic.hpp>
#include <stillpoint/neo_hookean.hpp>
#include <stillpoint/undrained_elastic.hpp>

#include "law_checks.hpp"

namespace stillpoint::checks {

/// A law whose pores are full of water that cannot flow.
template <class Law>
struct Wet : UndrainedElastic<Law> {
  static constexpr double stiffness = 5 * young;
  explicit Wet(const LameParameters& m) : UndrainedElastic<Law>(Law(m), stiffness) {}
};
template <StressState S>
using WetLinear = Wet<LinearElastic<S>>;
template <StressState S>
using WetNeoHookean = Wet<NeoHookean<S>>;
template <StressState S>
using WetHencky = Wet<Hencky<S>>;
#define WET_STATES_OF(Law) Law<uniaxial_strain>, Law<plane_strain>, Law<axisymmetric>, Law<space>

}  // namespace stillpoint::checks
