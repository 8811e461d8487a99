#include "base/atomic_file.hpp"

#include <stillpoint/state_archive.hpp>

#include <fstream>
#include <string>

#include <fmt/format.h>

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

fs::path partial_in_new_folder(const fs::path& file) {
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  return partial_name(file);
}

// A copy that was cut short must not be taken for the whole file: it has a name of its own until it is complete.
fs::path partial_of_earlier(const fs::path& file) {
  fs::path partial = partial_name(file);
  const fs::path copy = partial_name(partial);
  if (fs::exists(partial)) return partial;
  if (!fs::exists(file)) throw StateError(fmt::format("{}: is not there", file.string()));
  fs::copy_file(file, copy, fs::copy_options::overwrite_existing);
  fs::rename(copy, partial);
  return partial;
}

// The first `size` bytes of a file. Throws StateError if it is shorter.
std::string beginning_of(const fs::path& file, std::uint64_t size) {
  std::ifstream earlier(file, std::ios::binary);
  std::string text(size, '\0');
  earlier.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!earlier) throw StateError(fmt::format("{}: is not what was written so far", file.string()));
  return text;
}

}  // namespace

fs::path partial_name(fs::path file) { return file += ".partial"; }

AtomicFile::AtomicFile(const fs::path& file)
    : file_(file), partial_(partial_in_new_folder(file), OutputFile::Contents::none) {}

AtomicFile::AtomicFile(const fs::path& file, const FileContents& contents)
    : file_(file), partial_(partial_of_earlier(file), OutputFile::Contents::kept) {
  count(beginning_of(partial_.path(), contents.size));
  if (contents_.crc != contents.crc)
    throw StateError(fmt::format("{}: was altered since it was written", partial_.path().string()));
  partial_.resize(contents.size);
}

void AtomicFile::count(std::string_view text) {
  contents_.size += text.size();
  contents_.crc = checksum(contents_.crc, text.data(), text.size());
}

void AtomicFile::write(std::string_view text) {
  constexpr double longest_off_disk = 2;  // [s]
  try {
    partial_.write(text, contents_.size);
  } catch (const fs::filesystem_error&) {
    std::error_code ignored;
    fs::resize_file(partial_.path(), contents_.size, ignored);
    throw;
  }
  count(text);
  if (since_made_.seconds() < on_disk_at_ + longest_off_disk) return;
  partial_.bring_to_disk();
  on_disk_at_ = since_made_.seconds();
}

void AtomicFile::finish() {
  partial_.bring_to_disk();
  partial_.close();
  fs::rename(partial_.path(), file_);
}

void write_file(const fs::path& file, std::string_view text) {
  AtomicFile whole(file);
  whole.write(text);
  whole.finish();
}

}  // namespace stillpoint
