// The folder that a run writes into, and the lock that keeps other runs out of it.
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

/// A folder that cannot be written is bad input unless the disk is full or broken: throws a SceneError, or `error` in
/// those two cases.
[[noreturn]] void throw_unless_of_disk(const std::filesystem::path& folder,
                                       const std::filesystem::filesystem_error& error);

/// Creates the folder. Files of an earlier run must not lie beside those of the new one: they are removed, unless the
/// run `resumes` and needs them. Throws SceneError if the folder cannot be written, if another run writes into it, or
/// if something else is in the place of a file that a run may write; nothing is removed then.
[[nodiscard]] std::shared_ptr<FolderLock> prepare_folder(const std::filesystem::path& folder, bool resumes);

}  // namespace stillpoint
