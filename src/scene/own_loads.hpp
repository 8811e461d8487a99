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

/// The load of this name; null if there is none.
std::shared_ptr<const OwnLoadRow> own_load(const std::string& name);
/// The message about a name that no load has.
std::string unknown_own_load(const std::string& name);

/// True if the scene has an own load that depends on t.
bool own_load_varies(const Problem& problem);

}  // namespace stillpoint
