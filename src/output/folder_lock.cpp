#include "output/folder_lock.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/output_file.hpp"
#include "output/run_folder.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

constexpr const char* lock_name = "run.lock";

int open_lock(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_to_write(file, errno);
  return descriptor;
}

// The number of the process that holds the lock, which it has written to the file.
std::string holder(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size() - 1, 0);
  return size > 0 ? fmt::format("process {}", std::atol(text.data())) : "another process";
}

// Whether the opened file is still there: its former holder may have removed it since it was opened.
bool is_the_file(int descriptor, const fs::path& file) {
  struct stat opened {
  }, there{};
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &there) == 0 && opened.st_ino == there.st_ino &&
         opened.st_dev == there.st_dev;
}

}  // namespace

// On a file system without locks every process gets the lock.
FolderLock::FolderLock(const fs::path& folder) : file_(folder / lock_name), descriptor_(open_lock(file_)) {
  for (;;) {
    int wrong = 0;
    while (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && (wrong = errno) == EINTR) wrong = 0;
    if (wrong == EWOULDBLOCK) {
      const std::string other = holder(descriptor_);
      close(descriptor_);
      throw_option_error("--out", folder.string(),
                         fmt::format("{} is running into this folder; expected another one, or its end", other));
    }
    if (wrong != 0 || is_the_file(descriptor_, file_)) break;
    close(descriptor_);
    descriptor_ = open_lock(file_);
  }
  const std::string number = fmt::format("{}\n", getpid());
  if (ftruncate(descriptor_, 0) == 0) static_cast<void>(!pwrite(descriptor_, number.data(), number.size(), 0));
}

FolderLock::~FolderLock() {
  std::error_code ignored;
  fs::remove(file_, ignored);
  close(descriptor_);
}

std::shared_ptr<FolderLock> lock_folder(const fs::path& folder) {
  thread_local std::map<fs::path, std::weak_ptr<FolderLock>> held;
  std::erase_if(held, [](const auto& one) { return one.second.expired(); });
  const fs::path name = fs::canonical(folder);
  if (auto mine = held[name].lock()) return mine;
  try {
    auto lock = std::make_shared<FolderLock>(name);
    held[name] = lock;
    return lock;
  } catch (const fs::filesystem_error& error) {
    throw_unless_of_disk(folder, error);
  }
}

}  // namespace stillpoint
