// The folder that a run writes into.
#pragma once

#include <filesystem>
#include <memory>

#include "output/folder_lock.hpp"

namespace stillpoint {

/// That a folder cannot be written is bad input, but for a disk that is full or broken: throws a SceneError, or the
/// error.
[[noreturn]] void throw_unless_of_disk(const std::filesystem::path& folder,
                                       const std::filesystem::filesystem_error& error);

/// Creates it. What an earlier run has left there is not beside the new run's files: it goes, but for `resumes`, which
/// needs it. Throws SceneError if it cannot be written, if another run writes into it, or if something else is in the
/// place of a file that a run may write; nothing is removed then.
[[nodiscard]] std::shared_ptr<FolderLock> prepare_folder(const std::filesystem::path& folder, bool resumes);

}  // namespace stillpoint
