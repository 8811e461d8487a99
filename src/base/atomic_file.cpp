#include "base/atomic_file.hpp"

#include <stillpoint/state_archive.hpp>

#include <cerrno>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "base/checksum.hpp"

namespace stillpoint {
namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& file) {
  throw std::filesystem::filesystem_error(what, file, std::error_code(errno, std::generic_category()));
}

}  // namespace

std::filesystem::path partial_name(std::filesystem::path file) { return file += ".partial"; }

AtomicFile::AtomicFile(std::filesystem::path file) : file_(std::move(file)), partial_(partial_name(file_)) {
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path());
  stream_.open(partial_, std::ios::trunc | std::ios::binary);
  if (!stream_) fail("cannot write", partial_);
}

AtomicFile::AtomicFile(std::filesystem::path file, const FileContents& contents)
    : file_(std::move(file)), partial_(partial_name(file_)) {
  if (!std::filesystem::exists(partial_) && std::filesystem::exists(file_)) std::filesystem::copy_file(file_, partial_);
  std::ifstream earlier(partial_, std::ios::binary);
  std::string text(contents.size, '\0');
  earlier.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!earlier) throw StateError(fmt::format("{}: is not what was written so far", partial_.string()));
  count(text);
  if (contents_.crc != contents.crc)
    throw StateError(fmt::format("{}: was altered since it was written", partial_.string()));
  std::filesystem::resize_file(partial_, contents.size);
  stream_.open(partial_, std::ios::app | std::ios::binary);
  if (!stream_) fail("cannot write", partial_);
}

void AtomicFile::count(std::string_view text) {
  contents_.size += text.size();
  contents_.crc = checksum(contents_.crc, text.data(), text.size());
}

void AtomicFile::write(std::string_view text) {
  stream_ << text << std::flush;
  if (!stream_) fail("cannot write", partial_);
  count(text);
}

void AtomicFile::finish() {
  stream_.close();
  if (!stream_) fail("cannot write", partial_);
  std::filesystem::rename(partial_, file_);
}

}  // namespace stillpoint
