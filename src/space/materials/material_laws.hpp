// The available material laws, their stress states and their parameters: the choices of scenes, which `stillpoint list
// materials` shows.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/own_law.hpp>
#include <stillpoint/problem.hpp>

#include <memory>
#include <string>
#include <vector>

namespace stillpoint {

class HistoryAnswers;

/// All laws, including those that the program has added.
const std::vector<LawInfo>& material_laws();

/// Whether a material stressed beyond its strength flows at a finite rate, so that the answer depends on time.
bool is_viscous(const MaterialSpec& material);
/// The same material without viscosity, which gives its long-term strength.
MaterialSpec rate_independent(MaterialSpec material);
/// The material with softening by the plastic strain of bands that are as wide as a cell of this side [m].
MaterialSpec with_bands_of(MaterialSpec material, double cell);

/// Makes a law that the program has added; null if there is none of this name, or if it is one with a history.
std::shared_ptr<const LawAnswers> own_law_answers(const std::string& law, StressState state,
                                                  const LawParameters& parameters);
/// The same for a law with a history.
std::shared_ptr<const HistoryAnswers> own_history_answers(const std::string& law, StressState state,
                                                          const LawParameters& parameters);

}  // namespace stillpoint
