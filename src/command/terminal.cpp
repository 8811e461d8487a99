#include "command/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <optional>

#include <fmt/format.h>
#include <unistd.h>

namespace stillpoint::command {
namespace {

volatile std::sig_atomic_t interrupt_count = 0;

extern "C" void on_interrupt(int signal_number) {
  interrupt_count = interrupt_count + 1;
  std::signal(signal_number, SIG_DFL);
}

// Share of the way done: of the time to the end, or of the fall of the residual on a logarithmic scale.
std::optional<double> share_done(const Progress& p, double start_residual) {
  if (p.end_time > 0 && p.residual_goal <= 0) return p.t / p.end_time;
  if (p.residual_goal > 0 && p.residual > 0 && start_residual > p.residual_goal) {
    const double fallen = std::log(start_residual / p.residual), whole = std::log(start_residual / p.residual_goal);
    return std::clamp(fallen / whole, 0.0, 0.99);
  }
  return std::nullopt;
}

}  // namespace

bool interrupted() { return interrupt_count > 0; }
void watch_for_interrupt() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, on_interrupt);
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const Progress& p) {
  start_residual_ = std::max(start_residual_, p.residual);
  if (!terminal_ && p.wall_s < next_plain_line_) return;
  next_plain_line_ = p.wall_s + 10;
  std::string left;
  if (const auto share = share_done(p, start_residual_); share && *share > 0.02) {
    left = fmt::format("  {:3.0f} %  about {:.0f} s left", 100 * *share, p.wall_s * (1 - *share) / *share);
  }
  const std::string line = fmt::format("t = {:.4g}  steps {}  residual {:.2e}{}", p.t, p.steps, p.residual, left);
  if (terminal_) {
    fmt::print(stderr, "\r\033[K{}", line);
  } else {
    fmt::print(stderr, "{}\n", line);
  }
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::finish() {
  if (terminal_ && shown_) fmt::print(stderr, "\r\033[K");
}

}  // namespace stillpoint::command
