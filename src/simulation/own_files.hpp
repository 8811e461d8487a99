// Who leaves the files of a run: of several ranks the first one. What is in the files all of them gather.
#pragma once

#include <stillpoint/simulation.hpp>

#include <filesystem>

#include "parallel/ranks.hpp"

namespace stillpoint {

/// The folder that this process writes into; empty: it leaves no files.
inline std::filesystem::path own_folder(const SimulationOptions& options) {
  const bool is_first = !options.ranks || options.ranks->rank() == 0;
  return is_first ? options.out : std::filesystem::path();
}

}  // namespace stillpoint
