#include "output/run_folder.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <span>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/atomic_file.hpp"
#include "base/output_file.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

constexpr const char* of_the_end[] = {"summary.json", "report.html", "unstable_mode.csv"};
constexpr const char* gone_on_from[] = {"history.csv", "fields.h5",     "fields.xdmf",           "fields.pvd",
                                        "grid.pvd",    "checkpoint.h5", "checkpoint-previous.h5"};
constexpr const char* frames_folders[] = {"fields.partial", "fields_vtu"};

void require_file(const fs::path& path) {
  if (!fs::is_directory(path)) return;
  throw fs::filesystem_error("cannot write", path, std::make_error_code(std::errc::is_a_directory));
}

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

void throw_unless_of_disk(const fs::path& folder, const fs::filesystem_error& error) {
  for (const std::errc of_disk : {std::errc::no_space_on_device, std::errc::io_error, std::errc::file_too_large}) {
    if (error.code() == of_disk) throw fs::filesystem_error(error);
  }
  throw_folder_error(folder, error);
}

std::shared_ptr<FolderLock> prepare_folder(const fs::path& folder, bool resumes) {
  try {
    fs::create_directories(folder);
    std::shared_ptr<FolderLock> lock = lock_folder(folder);
    for (const auto names : {std::span<const char* const>(of_the_end), std::span<const char* const>(gone_on_from)}) {
      for (const char* name : names) {
        require_file(folder / name);
        require_file(partial_name(folder / name));
      }
    }
    for (const char* name : of_the_end) fs::remove(folder / name);
    if (resumes) return lock;
    for (const char* name : gone_on_from) fs::remove(folder / name);
    for (const char* name : frames_folders) fs::remove_all(folder / name);
    return lock;
  } catch (const fs::filesystem_error& error) {
    throw_unless_of_disk(folder, error);
  }
}

}  // namespace stillpoint
