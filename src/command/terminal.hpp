// Progress with the time left: one line that rewrites itself on a terminal, occasional plain lines elsewhere.
#pragma once

#include <stillpoint/simulation.hpp>

#include <deque>
#include <string>
#include <utility>

namespace stillpoint::command {

class ProgressLine {
 public:
  ProgressLine();
  void show(const Progress& progress);
  /// Clears the line on a terminal.
  void finish();

 private:
  std::string outlook(const Progress& progress) const;

  bool terminal_;
  bool shown_ = false;
  double next_plain_line_ = 10;  // [s]
  double start_residual_ = 0;
  std::deque<std::pair<double, double>> lately_;  // wall time [s] and residual, over the last half of the run
};

/// Whether Ctrl-C was pressed since watch_for_interrupt(), or SIGTERM or SIGHUP was received; a second signal ends the
/// process at once.
bool interrupted();
/// Has to be called while there is only one thread.
void watch_for_interrupt();

}  // namespace stillpoint::command
