#include "base/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace stillpoint {

void fail_to_write(const std::filesystem::path& file, int number) {
  throw std::filesystem::filesystem_error("cannot write", file,
                                          std::error_code(number != 0 ? number : EIO, std::generic_category()));
}

OutputFile::OutputFile(std::filesystem::path path, Contents contents)
    : path_(std::move(path)),
      descriptor_(
          open(path_.c_str(), O_RDWR | O_CLOEXEC | (contents == Contents::none ? O_CREAT | O_TRUNC : 0), 0666)) {
  if (descriptor_ < 0) fail_to_write(path_, errno);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

// A write may be cut short by a disk that has room for a part: writing the rest then gives the error.
void OutputFile::write(std::string_view bytes, std::uint64_t at) {
  while (!bytes.empty()) {
    const ssize_t count = pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail_to_write(path_, count < 0 ? errno : ENOSPC);
    bytes.remove_prefix(static_cast<std::size_t>(count));
    at += static_cast<std::uint64_t>(count);
  }
}

void OutputFile::read(char* bytes, std::size_t count, std::uint64_t at) const {
  while (count > 0) {
    const ssize_t got = pread(descriptor_, bytes, count, static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::filesystem::filesystem_error("cannot read", path_, {errno, std::generic_category()});
    if (got == 0) return static_cast<void>(std::fill_n(bytes, count, '\0'));
    bytes += got;
    count -= static_cast<std::size_t>(got);
    at += static_cast<std::uint64_t>(got);
  }
}

void OutputFile::resize(std::uint64_t size) {
  if (ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail_to_write(path_, errno);
}

void OutputFile::bring_to_disk() {
  if (fdatasync(descriptor_) != 0) fail_to_write(path_, errno);
}

void OutputFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) fail_to_write(path_, errno);
}

}  // namespace stillpoint
