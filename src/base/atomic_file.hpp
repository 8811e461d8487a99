// Files that are whole or not there: written as NAME.partial, renamed when complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "base/output_file.hpp"
#include "base/stopwatch.hpp"

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
  explicit AtomicFile(const std::filesystem::path& file);
  /// Goes on with NAME.partial, or NAME if there is none, after its first bytes; the rest is taken away. Throws
  /// StateError if these are not `contents`.
  AtomicFile(const std::filesystem::path& file, const FileContents& contents);
  const FileContents& contents() const { return contents_; }
  /// Appends the whole text or nothing, so that NAME.partial keeps what there was if the process is killed, or the disk
  /// is full; what was appended a few seconds ago is on the disk, and stays if the machine breaks down.
  void write(std::string_view text);
  /// Brings it to the disk and renames it to the final name.
  void finish();

 private:
  void count(std::string_view text);

  std::filesystem::path file_;
  OutputFile partial_;
  FileContents contents_;
  Stopwatch since_made_;
  double on_disk_at_ = 0;  // [s]
};

/// A file that is whole, or not there. Throws std::filesystem::filesystem_error.
void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace stillpoint
