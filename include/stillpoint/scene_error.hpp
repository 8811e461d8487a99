// The faults of a scene, each with its line and column.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace stillpoint {

/// A location: a file with line and column (1-based), or an override, "--set key=value", with line 0.
struct Location {
  std::string file;
  int line = 0, column = 0;
};
/// "file:line:column", or the file alone if there is no line.
std::string to_string(const Location& where);

/// One fault of a scene.
struct Mistake {
  Location where;
  std::string message;  // the fault, and what was expected
  std::string key{};    // the key that is wrong, as long as nobody has said where it stands (Scene::located)
};

/// All faults of a scene, found at once. what() has a line for each.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Mistake> problems);
  const std::vector<Mistake>& problems() const { return problems_; }

 private:
  std::vector<Mistake> problems_;
};

}  // namespace stillpoint
