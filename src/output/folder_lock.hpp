// Nobody else runs into a folder while one run does.
#pragma once

#include <filesystem>
#include <memory>

namespace stillpoint {

/// Held as long as it lives; when a process ends, however it does, its locks end with it.
class FolderLock {
 public:
  /// Throws SceneError, with the number of the process that holds it, or std::filesystem::filesystem_error.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

/// That of the folder, which is there; a SceneError as well if it cannot be written. Who has it already in this thread
/// shares it, as a run does with its simulation.
std::shared_ptr<FolderLock> lock_folder(const std::filesystem::path& folder);

}  // namespace stillpoint
