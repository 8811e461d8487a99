// What is wrong with a scene, and at which line and column.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace stillpoint {

/// Where something stands: a file with line and column (1-based), or an override, "--set key=value", with line 0.
struct Location {
  std::string file;
  int line = 0, column = 0;
};
/// "file:line:column", or the file alone if there is no line.
std::string to_string(const Location& where);

/// One thing that is wrong with a scene.
struct Mistake {
  Location where;
  std::string message;  // what, and what was expected
  std::string key{};    // that it is said of, if nobody knows yet where that stands; the message is without it
};

/// All that is wrong with a scene, found at once. what() has a line for each problem.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Mistake> problems);
  const std::vector<Mistake>& problems() const { return problems_; }

 private:
  std::vector<Mistake> problems_;
};

}  // namespace stillpoint
