// A lock that keeps other runs out of the folder of a run.
#pragma once

#include <filesystem>
#include <memory>

namespace stillpoint {

/// The lock is held during the object's lifetime; when a process ends in any way, its locks end with it.
class FolderLock {
 public:
  /// Throws SceneError, with the number of the process that holds the lock, or std::filesystem::filesystem_error.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

/// The lock of an existing folder. Throws SceneError also if the folder cannot be written. Holders in the same thread
/// share the lock, as a run does with its simulation.
std::shared_ptr<FolderLock> lock_folder(const std::filesystem::path& folder);

}  // namespace stillpoint
