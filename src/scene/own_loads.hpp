// The loads that a program has added, by name.
#pragma once

#include <stillpoint/own_load.hpp>
#include <stillpoint/problem.hpp>

#include <memory>
#include <string>
#include <vector>

namespace stillpoint {

struct OwnLoadRow {
  OwnLoad about;
  OwnBodyForce b;
};

/// That of this name, or null.
std::shared_ptr<const OwnLoadRow> own_load(const std::string& name);
/// What is wrong with a name under which there is none.
std::string unknown_own_load(const std::string& name);

/// Whether the own load of a scene, if it has one, is another one at another t.
bool own_load_varies(const Problem& problem);

}  // namespace stillpoint
