#include "parallel/start_ranks.hpp"

#include <stdexcept>
#include <string>

#include "base/own_module.hpp"

namespace stillpoint {

std::shared_ptr<const Ranks> start_ranks() {
  const std::string file = STILLPOINT_RANKS_MODULE;
  if (file.empty()) throw std::runtime_error("this build has no module for ranks, as there was no MPI: libopenmpi-dev");
  const OwnModule module = load_own_module(file, "stillpoint_make_ranks", "Debian's package libopenmpi3");
  if (!module.function) throw std::runtime_error(module.missing);
  return std::shared_ptr<const Ranks>(reinterpret_cast<Ranks* (*)()>(module.function)());
}

}  // namespace stillpoint
