#include "base/atomic_file.hpp"

#include <cerrno>
#include <system_error>

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

void AtomicFile::write(std::string_view text) {
  stream_ << text << std::flush;
  if (!stream_) fail("cannot write", partial_);
}

void AtomicFile::finish() {
  stream_.close();
  if (!stream_) fail("cannot write", partial_);
  std::filesystem::rename(partial_, file_);
}

}  // namespace stillpoint
