// The laws of a stress state, made by their names. Each kinematics has a file of its own that includes this one, so
// that they are compiled side by side.
#pragma once

#include <stillpoint/cam_clay.hpp>
#include <stillpoint/drucker_prager.hpp>
#include <stillpoint/hencky.hpp>
#include <stillpoint/linear_elastic.hpp>
#include <stillpoint/mohr_coulomb.hpp>
#include <stillpoint/neo_hookean.hpp>
#include <stillpoint/undrained.hpp>
#include <stillpoint/undrained_elastic.hpp>

#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "scene/pore_water.hpp"
#include "space/materials/elastic_material.hpp"
#include "space/materials/history_material.hpp"
#include "space/materials/own_history_material.hpp"
#include "space/materials/own_material.hpp"
#include "space/materials/point_material.hpp"
#include "space/materials/umat.hpp"
#include "space/materials/undrained_answers.hpp"

namespace stillpoint {

/// What make_point_material() makes.
template <Kinematics K>
using Made = std::unique_ptr<PointMaterial<K>>;

/// The answers of a law whose history is known as it runs; null if the material has another law.
template <StressState S>
std::shared_ptr<const HistoryAnswers> history_answers(const MaterialSpec& material) {
  auto answers = own_history_answers(material.law, S, material.parameters);
  if constexpr (S == StressState::plane_strain || S == StressState::axisymmetric || S == StressState::space) {
    if (material.law == "umat") answers = make_umat<S>(material);
    if (answers && material.undrained)
      answers = std::make_shared<UndrainedAnswers<S>>(std::move(answers), water_stiffness(material));
  }
  return answers;
}

/// Makes a material of this stress state; the arguments are those of make_point_material().
template <StressState S>
Made<kinematics(S)> make_material_of(const MaterialSpec& material, std::size_t begin, std::size_t count,
                                     bool updated_lagrangian) {
  const auto made = [&]<class Law>(const Law& law) -> Made<kinematics(S)> {
    return std::make_unique<ElasticMaterial<Law>>(law, begin, count, updated_lagrangian,
                                                  material.by_place.contains("E"));
  };
  const auto elastic = [&]<class Law>(const Law& law) -> Made<kinematics(S)> {
    if constexpr (knows_volume(S))
      if (material.undrained) return made(UndrainedElastic<Law>(law, water_stiffness(material)));
    return made(law);
  };
  if (auto answers = own_law_answers(material.law, S, material.parameters)) {
    const OwnLawAtPoint<S> law(std::move(answers));
    if (material.undrained) return elastic(law);
    return std::make_unique<OwnMaterial<S>>(law, begin, count, updated_lagrangian);
  }
  if (auto answers = history_answers<S>(material))
    return std::make_unique<OwnHistoryMaterial<S>>(
        std::move(answers), fmt::format("material.{}.{}", material.name, material.library.empty() ? "law" : "library"),
        begin, count);
  const auto lame = [&] { return LameParameters::from(material.parameters.at("E"), material.parameters.at("nu")); };
  if (material.law == "linear-elastic") return elastic(LinearElastic<S>(lame()));
  if (material.law == "neo-hookean") return elastic(NeoHookean<S>(lame()));
  if (material.law == "hencky") return elastic(Hencky<S>(lame()));
  if constexpr (S == StressState::plane_strain || S == StressState::axisymmetric || S == StressState::space) {
    const auto with_history = [&]<class Law>(const Law& law) -> Made<kinematics(S)> {
      if (material.undrained)
        return std::make_unique<HistoryMaterial<Undrained<Law>>>(Undrained<Law>(law, water_stiffness(material)), begin,
                                                                 count);
      return std::make_unique<HistoryMaterial<Law>>(law, begin, count);
    };
    if (material.law == "drucker-prager") {
      const auto parameters = DruckerPragerParameters::from(material);
      if (parameters.softening_strain == 0 && material.by_place.empty())
        return with_history(DruckerPrager<S>(parameters));
      return with_history(DruckerPrager<S, true>(parameters));
    }
    if (material.law == "cam-clay") return with_history(CamClay<S>(CamClayParameters::from(material)));
    if (material.law == "mohr-coulomb") {
      const auto parameters = MohrCoulombParameters::from(material);
      if (parameters.softening.empty() && material.by_place.empty()) return with_history(MohrCoulomb<S>(parameters));
      return with_history(MohrCoulomb<S, true>(parameters));
    }
  }
  throw std::logic_error("a material law without an instantiation for this stress state");
}

}  // namespace stillpoint
