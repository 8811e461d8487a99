// Files that are whole or not there: written as NAME.partial, renamed when complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

namespace stillpoint {

/// Where a file is written until it is whole: NAME.partial.
std::filesystem::path partial_name(std::filesystem::path file);

class AtomicFile {
 public:
  /// Creates the folder if need be. Throws std::filesystem::filesystem_error if the file cannot be written.
  explicit AtomicFile(std::filesystem::path file);
  /// Appends and flushes, so that NAME.partial keeps what there was even if the process is killed.
  void write(std::string_view text);
  /// Renames to the final name.
  void finish();

 private:
  std::filesystem::path file_, partial_;
  std::ofstream stream_;
};

}  // namespace stillpoint
