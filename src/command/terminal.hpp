// Progress with the time left: one line that rewrites itself on a terminal, occasional plain lines elsewhere. Lines as
// wide as the terminal.
#pragma once

#include <stillpoint/simulation.hpp>
#include <stillpoint/study_progress.hpp>

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>

namespace stillpoint::command {

class StatusLine {
 public:
  /// Clears the line on a terminal.
  void finish() const;

 protected:
  StatusLine();
  /// Whether a line is to be printed after so much wall time [s], since the last one elsewhere was 10 s ago.
  bool is_due(double wall_s);
  void print(const std::string& text);

 private:
  bool terminal_;
  bool shown_ = false;
  double next_plain_line_ = 10;  // [s]
};

/// Of a run.
class ProgressLine : public StatusLine {
 public:
  void show(const Progress& progress);

 private:
  std::string outlook(const Progress& progress) const;
  std::optional<double> rate() const;

  double start_residual_ = 0;
  std::deque<std::pair<double, double>> lately_;  // wall time [s] and residual, over the last half of the run
};

/// Of a study: "[3/40] what is done  about 12 s left".
class CountLine : public StatusLine {
 public:
  void show(const StudyProgress& progress);
};

/// The columns of the terminal that the standard output is; 0 if it is none.
std::size_t width_of_terminal();

/// head + text + "\n", broken at spaces into lines of this width, those after the first as far in as the text is; width
/// 0: in one line.
std::string wrapped(const std::string& head, const std::string& text, std::size_t width);

/// Whether Ctrl-C was pressed since watch_for_interrupt(), or SIGTERM or SIGHUP was received; a second signal ends the
/// process at once.
bool interrupted();
/// Has to be called while there is only one thread.
void watch_for_interrupt();

}  // namespace stillpoint::command
