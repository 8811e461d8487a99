#include "command/launcher.hpp"

#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

#include <fmt/format.h>

namespace stillpoint::command {
namespace {

// By which variables a launcher tells each copy how many there are, and which one it is.
struct Launcher {
  const char *name, *size, *rank;
};
constexpr std::array launchers = {
    Launcher{"Open MPI's mpirun", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
    Launcher{"mpirun", "PMI_SIZE", "PMI_RANK"},  // of MPICH, Intel and others
    Launcher{"srun", "SLURM_STEP_NUM_TASKS", "SLURM_PROCID"},
};

int number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  int number = 0;
  if (text) std::from_chars(text, text + std::strlen(text), number);
  return number;
}

}  // namespace

Copies launched_copies() {
  for (const Launcher& launcher : launchers)
    if (const int count = number_in(launcher.size); count > 1)
      return {launcher.name, launcher.size, count, number_in(launcher.rank)};
  return {};
}

bool refuses(const Copies& copies, const char* instead) {
  if (copies.count <= 1) return false;
  if (copies.rank != 0) {
    // A launcher ends all copies with the first that fails: this one waits until the message is out.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    return true;
  }
  fmt::print(stderr,
             "{} has started {} copies of this command, which would write into one folder; expected {}. For runs of "
             "different scenes side by side, take {} from their environment\n",
             copies.launcher, copies.count, instead, copies.size);
  return true;
}

}  // namespace stillpoint::command
