// A file for writing: every system call is checked, and a call that fails is reported with the file's name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace stillpoint {

/// Throws std::filesystem::filesystem_error with an error number of the system, EIO for 0.
[[noreturn]] void fail_to_write(const std::filesystem::path& file, int number);

class OutputFile {
 public:
  enum class Contents { none, kept };
  /// Creates or empties the file, or opens one that is there. It and all other functions throw
  /// std::filesystem::filesystem_error.
  OutputFile(std::filesystem::path path, Contents contents);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Writes all bytes, `at` bytes from the beginning.
  void write(std::string_view bytes, std::uint64_t at);
  /// Fills `bytes` from `at` bytes after the beginning of the file, with 0 beyond its end.
  void read(char* bytes, std::size_t count, std::uint64_t at) const;
  void resize(std::uint64_t size);
  /// Returns once everything written is on the disk.
  void bring_to_disk();
  void close();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_;  // negative when closed
};

}  // namespace stillpoint
