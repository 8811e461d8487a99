// Stillpoint: quasi-static equilibrium by dynamic relaxation in the material point method.
//
//   const auto scene = stillpoint::load_scene("bar.toml");
//   const auto summary = stillpoint::run(scene);       // or step by step: stillpoint::Simulation
#pragma once

#include <stillpoint/compare.hpp>
#include <stillpoint/converge.hpp>
#include <stillpoint/exact_solution.hpp>
#include <stillpoint/own_damping.hpp>
#include <stillpoint/own_history_law.hpp>
#include <stillpoint/own_law.hpp>
#include <stillpoint/own_load.hpp>
#include <stillpoint/own_relaxation.hpp>
#include <stillpoint/run.hpp>
#include <stillpoint/scene.hpp>
#include <stillpoint/spectrum.hpp>
#include <stillpoint/static_solution.hpp>
