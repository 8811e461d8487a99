// What the points of a stage begin with: the states of those that were there before, and the stress of those that are
// placed.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "space/points/body.hpp"
#include "space/points/carried_body.hpp"
#include "space/points/value_by_place.hpp"
#include "space/points/weight_above.hpp"

namespace stillpoint {

/// What bears on the bodies that are placed in the present stage, if it has a K0.
template <Kinematics K>
std::optional<WeightAbove> weight_on_new_bodies(const Problem& problem, const Body<K>& body) {
  if (!problem.present_stage || !problem.present_stage->K0) return std::nullopt;
  std::vector<const BodySpec*> placed;
  for (std::size_t b = 0; b < problem.bodies.size(); ++b)
    if (!body.carried_on[b]) placed.push_back(&problem.bodies[b]);
  return WeightAbove(problem, placed, std::nullopt);
}

/// Gives the points of all materials that have a source among those that were carried on the states of these, and those
/// that are new the stress of the stage's K0; source: of each point, −1 if it is new.
template <Kinematics K>
void take_states(const Problem& problem, const CarriedBodyOf<K>& carried, const std::vector<int>& source,
                 Body<K>& body) {
  const std::optional<WeightAbove> weight = weight_on_new_bodies(problem, body);
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    PointMaterial<K>& material = *body.materials[m];
    const MaterialSpec& spec = problem.materials.at(body.material_names[m]);
    const auto begin = static_cast<std::size_t>(body.points.material_begin[m]);
    const std::size_t count = static_cast<std::size_t>(body.points.material_begin[m + 1]) - begin;
    const auto for_carried = [&](const auto& visit) {
      for (std::size_t k = 0; k < count; ++k) {
        if (source[begin + k] < 0) continue;
        const auto p = static_cast<std::size_t>(source[begin + k]);
        const CarriedMaterial<K>& before = carried.material_of(p);
        visit(k, before, p - before.begin);
      }
    };
    if (material.info().history_dependent) {
      std::vector<typename PointMaterial<K>::Stresses> stress(count);
      for_carried([&](std::size_t k, const auto& before, std::size_t j) { stress[k] = before.stress_at(j); });
      std::vector<std::vector<double>> places;
      for (std::size_t k = 0; k < count; ++k) {
        const auto x = body.points.position(begin + k);
        places.emplace_back(x.begin(), x.end());
        if (const int from = source[begin + k]; from >= 0) {
          places.back() = carried.initial_position(static_cast<std::size_t>(from));
        } else if (weight) {
          const auto at_rest =
              stress_at_rest(*problem.present_stage->K0, (*weight)(places.back(), spec), places.back(), "stage.K0");
          std::copy_n(at_rest.begin(), std::min(at_rest.size(), stress[k].size()), stress[k].begin());
        }
      }
      InitialGround ground = initial_ground(spec, places);
      ground.at_rest = weight.has_value();
      material.set_stress(stress, ground);
    }
    const Vec memory = material.memory();
    const std::vector<std::size_t> rows = remembered_rows(material, spec, count);
    const auto shown = material.shown_history();
    for_carried([&](std::size_t k, const auto& before, std::size_t j) {
      if (before.is_like(spec, rows.size())) {
        for (std::size_t r = 0; r < rows.size(); ++r) memory[count * rows[r] + k] = before.memory[before.count * r + j];
        return;
      }
      for (std::size_t h = 0; h < before.names.size(); ++h) {
        const auto same = std::ranges::find(shown, before.names[h], [](const auto& one) { return one.first; });
        if (same == shown.end()) continue;
        const auto row = static_cast<std::size_t>(same->second.data() - memory.data()) / count;
        memory[count * row + k] = before.shown[before.count * h + j];
      }
    });
  }
}

}  // namespace stillpoint
