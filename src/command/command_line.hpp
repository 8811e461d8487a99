// The command's arguments.
#pragma once

namespace stillpoint::command {

/// Exit status for input that is refused.
inline constexpr int bad_input = 2;

/// Reads the arguments of main() and does what they ask for. Returns the exit status; what a command throws goes
/// through.
int dispatch(int argc, char** argv);

}  // namespace stillpoint::command
