#include <stillpoint/scene_error.hpp>

#include <utility>

#include <fmt/format.h>

namespace stillpoint {
namespace {

std::string all_of(const std::vector<Mistake>& problems) {
  std::string text;
  for (const Mistake& problem : problems) {
    const std::string place = to_string(problem.where);
    text += fmt::format("{}{}{}{}", text.empty() ? "" : "\n", place, place.empty() ? "" : ": ", problem.message);
  }
  return text;
}

}  // namespace

std::string to_string(const Location& where) {
  return where.line > 0 ? fmt::format("{}:{}:{}", where.file, where.line, where.column) : where.file;
}

SceneError::SceneError(std::vector<Mistake> problems)
    : std::runtime_error(all_of(problems)), problems_(std::move(problems)) {}

}  // namespace stillpoint
