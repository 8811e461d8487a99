// Modules of the library: parts that are loaded only where a run needs them, as they bring libraries that take long to
// start.
#pragma once

#include <string>

namespace stillpoint {

struct OwnModule {
  void* function = nullptr;  // the one that was asked for; null: there is none
  std::string missing;       // why
};

/// Loads a module and finds its function. brings: what its libraries come with, "Debian's package NAME".
OwnModule load_own_module(const std::string& file, const char* function, const std::string& brings);

}  // namespace stillpoint
