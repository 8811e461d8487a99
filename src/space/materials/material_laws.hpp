// The material laws on offer, their stress states and their parameters: what scenes may say and `stillpoint list
// materials` shows.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/own_law.hpp>

#include <memory>
#include <string>
#include <vector>

namespace stillpoint {

/// With those that the program has added.
const std::vector<LawInfo>& material_laws();

/// A further row, or another one in the place of that of the same name.
void put_law(const LawInfo& about);

/// The answers of a law that the program has added; null if that is none of those.
std::shared_ptr<const LawAnswers> own_law_answers(const std::string& law, StressState state,
                                                  const LawParameters& parameters);

}  // namespace stillpoint
