// The material laws on offer, their stress states and their parameters: what scenes may say and `stillpoint list
// materials` shows.
#pragma once

#include <stillpoint/catalogue.hpp>

#include <vector>

namespace stillpoint {

const std::vector<LawInfo>& material_laws();

}  // namespace stillpoint
