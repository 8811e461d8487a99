#include "base/disk_room.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace stillpoint {

void require_room(const std::filesystem::path& file, std::uint64_t bytes) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  int number = descriptor < 0 ? errno : 0;
  if (descriptor >= 0) {
    number = posix_fallocate(descriptor, 0, static_cast<off_t>(bytes));
    close(descriptor);
    unlink(file.c_str());
  }
  if (number == 0) return;
  throw std::filesystem::filesystem_error("cannot write", file, std::error_code(number, std::generic_category()));
}

}  // namespace stillpoint
