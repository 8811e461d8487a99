// Who leaves the files of a run: of several ranks the first one. What is in the files all of them gather.
#pragma once

#include <stillpoint/simulation.hpp>

#include <filesystem>

#include "parallel/ranks.hpp"

namespace stillpoint {

inline bool leaves_files(const SimulationOptions& options) { return !options.ranks || options.ranks->rank() == 0; }

/// The folder of the run that this process writes into; empty: it leaves no files, or there is no folder.
inline std::filesystem::path own_folder(const SimulationOptions& options) {
  return leaves_files(options) ? options.out : std::filesystem::path();
}

}  // namespace stillpoint
