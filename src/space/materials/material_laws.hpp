// The material laws on offer, their stress states and their parameters: what scenes may say and `stillpoint list
// materials` shows.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/own_law.hpp>
#include <stillpoint/problem.hpp>

#include <memory>
#include <string>
#include <vector>

namespace stillpoint {

/// With those that the program has added.
const std::vector<LawInfo>& material_laws();

/// A further row, or another one in the place of that of the same name.
void put_law(const LawInfo& about);

/// Whether what is stressed beyond its strength flows at a rate, so that the answer depends on time.
bool is_viscous(const MaterialSpec& material);
/// The same material given all the time that it takes: what it bears in the long run.
MaterialSpec rate_independent(MaterialSpec material);

/// The answers of a law that the program has added; null if that is none of those.
std::shared_ptr<const LawAnswers> own_law_answers(const std::string& law, StressState state,
                                                  const LawParameters& parameters);

}  // namespace stillpoint
