#include "command/study_output.hpp"

#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "scene/throw_scene_error.hpp"

namespace stillpoint::command {

CountLine::CountLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

void CountLine::show(const StudyProgress& p) {
  if (!terminal_ && p.wall_s < next_plain_line_) return;
  next_plain_line_ = p.wall_s + 10;
  std::string left;
  if (p.done > 0 && p.done < p.total)
    left = fmt::format("  about {:.0f} s left", p.wall_s * (p.total - p.done) / p.done);
  fmt::print(stderr, "{}[{}/{}] {}{}{}", terminal_ ? "\r\033[K" : "", p.done, p.total, p.doing, left,
             terminal_ ? "" : "\n");
  std::fflush(stderr);
}

void CountLine::finish() const {
  if (terminal_) fmt::print(stderr, "\r\033[K");
}

OutputFolder::OutputFolder(const std::filesystem::path& path) : path_(path) {
  try {
    std::filesystem::create_directories(path_);
    lock_ = lock_folder(path_);
  } catch (const std::filesystem::filesystem_error& error) {
    throw_folder_error(path_, error);
  }
}

OutputFolder::~OutputFolder() {
  lock_.reset();
  std::error_code not_empty;
  std::filesystem::remove(path_, not_empty);
}

}  // namespace stillpoint::command
