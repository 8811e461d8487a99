#include "command/terminal.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <optional>
#include <string_view>
#include <thread>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace stillpoint::command {
namespace {

std::atomic<bool> was_interrupted = false;

// Those of the three signals that the parent process has not set to be ignored, as nohup does.
sigset_t heeded_signals() {
  sigset_t heeded;
  sigemptyset(&heeded);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction given {};
    sigaction(number, nullptr, &given);
    if (given.sa_handler != SIG_IGN) sigaddset(&heeded, number);
  }
  return heeded;
}

// The second signal ends the process, as it would have without this thread.
void wait_for_signals(const sigset_t& heeded) {
  int number = 0;
  sigwait(&heeded, &number);
  was_interrupted = true;
  sigwait(&heeded, &number);
  std::signal(number, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &heeded, nullptr);
  raise(number);
}

// The share of the run that is done: of the time to its end, or of the fall of the residual on a logarithmic scale.
// Empty once the residual has met its goal, as the rest cannot be predicted.
std::optional<double> share_done(const Progress& p, double start_residual) {
  if (p.end_time > 0 && p.residual_goal <= 0) return p.t / p.end_time;
  if (p.residual_goal > 0 && p.residual > p.residual_goal && start_residual > p.residual_goal) {
    const double fallen = std::log(start_residual / p.residual), whole = std::log(start_residual / p.residual_goal);
    return std::clamp(fallen / whole, 0.0, 0.99);
  }
  return std::nullopt;
}

}  // namespace

bool interrupted() { return was_interrupted; }

// One thread waits for the signals, and they are blocked in all others: METIS, which orders the unknowns for a factor,
// replaces any handler of SIGTERM by its own, and jumps away from the interrupted work.
void watch_for_interrupt() {
  const sigset_t heeded = heeded_signals();
  pthread_sigmask(SIG_BLOCK, &heeded, nullptr);
  std::thread(wait_for_signals, heeded).detach();
}

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

bool StatusLine::is_due(double wall_s) {
  if (!terminal_ && wall_s < next_plain_line_) return false;
  next_plain_line_ = wall_s + 10;
  return true;
}

void StatusLine::print(const std::string& text) {
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r\033[K" : "", text, terminal_ ? "" : "\n");
  std::fflush(stderr);
  shown_ = true;
}

void StatusLine::finish() const {
  if (terminal_ && shown_) fmt::print(stderr, "\r\033[K");
}

void ProgressLine::show(const Progress& p) {
  start_residual_ = std::max(start_residual_, p.residual);
  lately_.emplace_back(p.wall_s, p.residual);
  while (lately_.front().first < p.wall_s / 2) lately_.pop_front();
  if (!is_due(p.wall_s)) return;
  print(fmt::format("t = {:.4g}  steps {}  residual {:.2e}{}", p.t, p.steps, p.residual, outlook(p)));
}

// For a residual that does not fall no remaining time can be given.
std::string ProgressLine::outlook(const Progress& p) const {
  const bool by_residual = p.residual_goal > 0;
  if (by_residual && p.residual <= p.residual_goal) return p.waits_for.empty() ? "" : "  waits for: " + p.waits_for;
  const auto share = share_done(p, start_residual_);
  if (!share || !(*share > 0.02)) return "";
  const std::string done = fmt::format("  {:3.0f} %", 100 * *share);
  if (!by_residual) return done + fmt::format("  about {:.0f} s left", p.wall_s * (1 - *share) / *share);
  const std::optional<double> falls = rate();
  if (!falls) return "  the residual does not fall steadily";
  return done + fmt::format("  about {:.0f} s left", std::log(p.residual / p.residual_goal) / *falls);
}

// −d(ln residual)/dt over the last half of the run [1/s]; none if it is not nearly the same in both parts of that: a
// body that slides on for ever slows down, too.
std::optional<double> ProgressLine::rate() const {
  const double begin = lately_.front().first, end = lately_.back().first, half = (begin + end) / 2;
  const auto fall = [](const auto& from, const auto& to) {
    return std::log(from.second / to.second) / (to.first - from.first);
  };
  const auto middle = std::ranges::find_if(lately_, [half](const auto& one) { return one.first >= half; });
  if (!(begin < middle->first && middle->first < end)) return std::nullopt;
  const double before = fall(lately_.front(), *middle), after = fall(*middle, lately_.back());
  constexpr double alike = 3;
  if (!(before > 0 && after > 0 && before < alike * after && after < alike * before)) return std::nullopt;
  return fall(lately_.front(), lately_.back());
}

std::size_t width_of_terminal() {
  winsize size{};
  const bool is_terminal = isatty(STDOUT_FILENO) != 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0;
  return is_terminal ? size.ws_col : 0;
}

std::string wrapped(const std::string& head, const std::string& text, std::size_t width) {
  const auto letters = [](std::string_view word) {  // of UTF-8
    return static_cast<std::size_t>(std::ranges::count_if(word, [](char c) { return (c & 0xC0) != 0x80; }));
  };
  const std::size_t margin = letters(head);
  constexpr std::size_t narrowest = 20;
  if (width < margin + narrowest) return head + text + "\n";
  std::string lines = head;
  std::size_t column = margin;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    const std::string_view word = std::string_view(text).substr(from, to - from);
    if (column > margin && column + 1 + letters(word) > width) {
      lines += "\n" + std::string(margin, ' ');
      column = margin;
    } else if (from > 0) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += letters(word);
    from = to + 1;
  }
  return lines + "\n";
}

void CountLine::show(const StudyProgress& p) {
  if (!is_due(p.wall_s)) return;
  std::string left;
  if (p.done > 0 && p.done < p.total)
    left = fmt::format("  about {:.0f} s left", p.wall_s * (p.total - p.done) / p.done);
  print(fmt::format("[{}/{}] {}{}", p.done, p.total, p.doing, left));
}

}  // namespace stillpoint::command
