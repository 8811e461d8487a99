#include "child.hpp"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stillpoint::test {

std::vector<std::string> run_of(const std::string& scene, const std::vector<std::string>& settings,
                                const std::filesystem::path& out) {
  std::vector<std::string> words = {
      "run", STILLPOINT_PROBLEMS + ("/" + scene + ".toml"), "--quiet", "--threads", "1", "--out", out.string()};
  for (const std::string& one : settings) words.insert(words.end(), {"--set", one});
  return words;
}

Child::Child(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
             const std::string& messages, const std::function<void()>& limits)
    : process_(fork()) {
  if (process_ < 0) throw std::runtime_error("no process");
  if (process_ > 0) return;
  std::string program = "stillpoint";
  std::vector<std::string> words = arguments, variables = environment;
  std::vector<char*> all = {program.data()};
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  for (std::string& variable : variables) putenv(variable.data());
  if (!messages.empty()) dup2(open(messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
  if (limits) limits();
  execv(STILLPOINT_BINARY, all.data());
  _exit(127);
}

Child::~Child() {
  if (status_) return;
  send(SIGKILL);
  wait();
}

// Whether it has ended.
bool Child::look(int options) {
  int status = 0;
  if (!status_ && wait4(process_, &status, options, &usage_) == process_) status_ = status;
  return status_.has_value();
}

bool Child::wait_until(const std::function<bool()>& condition) {
  for (int wait = 0; wait < 30'000 && !look(WNOHANG); ++wait) {
    if (condition()) return true;
    usleep(2'000);
  }
  return false;
}

// Signals that a run watches for are closed to its first thread, and another waits for them.
bool Child::heeds(int signal) const {
  std::ifstream words("/proc/" + std::to_string(process_) + "/status");
  std::string word;
  while (words >> word && word != "SigBlk:") continue;
  unsigned long long blocked = 0;
  words >> std::hex >> blocked;
  return ((blocked >> (signal - 1)) & 1U) != 0;
}

void Child::send(int signal) const {
  if (!status_) kill(process_, signal);
}

std::optional<int> Child::wait() {
  look(0);
  return WIFEXITED(*status_) ? std::optional(WEXITSTATUS(*status_)) : std::nullopt;
}

double Child::seconds() const {
  const auto in_seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  if (status_) return in_seconds(usage_.ru_utime) + in_seconds(usage_.ru_stime);
  std::ifstream words("/proc/" + std::to_string(process_) + "/stat");
  std::string word;
  constexpr int before_user_time = 13;
  for (int k = 0; k < before_user_time; ++k) words >> word;
  double user = 0, system = 0;
  words >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double Child::peak_memory() const { return 1024.0 * static_cast<double>(usage_.ru_maxrss); }

}  // namespace stillpoint::test
