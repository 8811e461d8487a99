// Files that are complete or absent: written as NAME.partial, renamed when complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include <zlib.h>

#include "base/output_file.hpp"
#include "base/stopwatch.hpp"

namespace stillpoint {

/// The checksum after `size` more bytes; before: the checksum of the bytes that precede them, 0 if there are none.
inline std::uint64_t checksum(std::uint64_t before, const void* bytes, std::size_t size) {
  return crc32_z(before, static_cast<const Bytef*>(bytes), size);
}

/// The name under which a file is written until it is complete: NAME.partial.
std::filesystem::path partial_name(std::filesystem::path file);

/// The size and checksum of what has been written to a file.
struct FileContents {
  std::uint64_t size = 0;
  std::uint64_t crc = 0;  // CRC-32
};

class AtomicFile {
 public:
  /// Creates the folder if need be. Throws std::filesystem::filesystem_error if the file cannot be written.
  explicit AtomicFile(const std::filesystem::path& file);
  /// Continues NAME.partial, or NAME if there is none, after the bytes that `contents` describes; the rest is cut off.
  /// Throws StateError if the first bytes differ from `contents`.
  AtomicFile(const std::filesystem::path& file, const FileContents& contents);
  const FileContents& contents() const { return contents_; }
  /// Appends the whole text or nothing, so that NAME.partial keeps its earlier text if the process is killed or the
  /// disk is full; text that is older than a few seconds is on the disk, and survives a crash of the machine.
  void write(std::string_view text);
  /// Brings the file to the disk and renames it to the final name.
  void finish();

 private:
  void count(std::string_view text);

  std::filesystem::path file_;
  OutputFile partial_;
  FileContents contents_;
  Stopwatch since_made_;
  double on_disk_at_ = 0;  // time of the last transfer to the disk [s]
};

/// Writes a file that is complete, or absent if the process is killed. Throws std::filesystem::filesystem_error.
void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace stillpoint
