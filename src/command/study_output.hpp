// The output folder of a study.
#pragma once

#include <filesystem>
#include <memory>

#include "output/run_folder.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint::command {

/// The output folder, made before anything runs, since a folder that cannot be made is bad input. It is removed again
/// if it stays empty, and locked against other runs meanwhile.
class OutputFolder {
 public:
  explicit OutputFolder(const std::filesystem::path& path) : path_(path) {
    try {
      std::filesystem::create_directories(path_);
      lock_ = lock_folder(path_);
    } catch (const std::filesystem::filesystem_error& error) {
      throw_folder_error(path_, error);
    }
  }
  ~OutputFolder() {
    lock_.reset();
    std::error_code not_empty;
    std::filesystem::remove(path_, not_empty);
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  const std::filesystem::path& path_;
  std::shared_ptr<FolderLock> lock_;
};

}  // namespace stillpoint::command
