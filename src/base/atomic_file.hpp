// Files that are whole or not there: written as NAME.partial, renamed when complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace stillpoint {

/// Where a file is written until it is whole: NAME.partial.
std::filesystem::path partial_name(std::filesystem::path file);

/// What has been written to a file.
struct FileContents {
  std::uint64_t size = 0;
  std::uint64_t crc = 0;  // CRC-32
};

class AtomicFile {
 public:
  /// Creates the folder if need be. Throws std::filesystem::filesystem_error if the file cannot be written.
  explicit AtomicFile(std::filesystem::path file);
  /// Goes on with NAME.partial, or NAME if there is none, after its first bytes; the rest is taken away. Throws
  /// StateError if these are not `contents`.
  AtomicFile(std::filesystem::path file, const FileContents& contents);
  const FileContents& contents() const { return contents_; }
  /// Appends and flushes, so that NAME.partial keeps what there was even if the process is killed.
  void write(std::string_view text);
  /// Renames to the final name.
  void finish();

 private:
  void count(std::string_view text);

  std::filesystem::path file_, partial_;
  std::ofstream stream_;
  FileContents contents_;
};

}  // namespace stillpoint
