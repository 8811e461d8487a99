// How the command tells what went wrong, and the exit status that goes with it.
#pragma once

#include <string>

namespace stillpoint::command {

constexpr int failed = 4;

struct Failure {
  int status = failed;
  std::string message;
};

/// Of the exception that is being handled.
Failure failure_of_exception();

}  // namespace stillpoint::command
