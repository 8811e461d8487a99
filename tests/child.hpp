// The command as a process of its own, which a test waits for, sends signals to, and judges by what it leaves.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/types.h>

namespace stillpoint::test {

/// `run` of a scene of problems/ with these settings, by one thread, into a folder.
std::vector<std::string> run_of(const std::string& scene, const std::vector<std::string>& settings,
                                const std::filesystem::path& out);

class Child {
 public:
  /// Starts `stillpoint arguments…`; environment: "NAME=value" beside what there is. Messages go to `messages`, if it
  /// is not empty. limits are set before it runs.
  explicit Child(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {},
                 const std::string& messages = "", const std::function<void()>& limits = {});
  /// Kills it if it still runs.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Until the condition holds; false if the process has ended before, or after a minute.
  bool wait_until(const std::function<bool()>& condition);
  /// Whether it watches for signals by now, as a run does from its first moment on: until then one would kill it.
  bool heeds(int signal) const;
  void send(int signal) const;
  /// Its exit status, once it has ended by itself; empty if a signal ended it.
  std::optional<int> wait();
  /// Of the processor's, which other programs that run do not lengthen [s].
  double seconds() const;
  /// The most memory that it had at once, once it has ended [bytes].
  double peak_memory() const;

 private:
  bool look(int options);

  pid_t process_;
  std::optional<int> status_;  // of wait4()
  rusage usage_{};
};

}  // namespace stillpoint::test
