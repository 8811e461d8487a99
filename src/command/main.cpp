// stillpoint: the command. Exit status: 0 success, 2 bad input, 3 not in equilibrium within the limits, 4 failed.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>
#include <malloc.h>

#include "base/work_apart.hpp"
#include "command/command_line.hpp"
#include "command/failure.hpp"

namespace {

using stillpoint::command::failed;

int exit_status(int argc, char** argv) {
  try {
    return stillpoint::command::dispatch(argc, argv);
  } catch (...) {
    const auto [status, message] = stillpoint::command::failure_of_exception();
    fmt::print(stderr, "{}\n", message);
    return status;
  }
}

// Flushes the standard output: a failure to write it may show only now.
int status_after_output(int status) {
  errno = 0;
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (written || status == failed) return status;
  fmt::print(stderr, "stillpoint: cannot write to the standard output{}{}\n", errno != 0 ? ": " : "",
             errno != 0 ? std::strerror(errno) : "");
  return failed;
}

// The next phase reuses the memory that a phase frees: returned to the system in between, each page would have to be
// zeroed anew, which took 7 % of the time of the slope scene.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int of_one_array = 4 << 20, unused_at_the_end = 64 << 20;  // [bytes]
  mallopt(M_MMAP_THRESHOLD, of_one_array);
  mallopt(M_TRIM_THRESHOLD, unused_at_the_end);
#endif
}

}  // namespace

// A thread with abandoned work must find everything it uses until the process ends: nothing is destroyed then.
int main(int argc, char** argv) {
  keep_freed_memory();
  const int status = status_after_output(exit_status(argc, argv));
  if (!stillpoint::work_was_left()) return status;
  std::fflush(nullptr);
  std::_Exit(status);
}
