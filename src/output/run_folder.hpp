// The folder that a run writes into.
#pragma once

#include <filesystem>
#include <memory>

#include "output/folder_lock.hpp"

namespace stillpoint {

/// A folder that cannot be written is bad input unless the disk is full or broken: throws a SceneError, or `error` in
/// those two cases.
[[noreturn]] void throw_unless_of_disk(const std::filesystem::path& folder,
                                       const std::filesystem::filesystem_error& error);

/// Creates the folder. Files of an earlier run must not lie beside those of the new one: they are removed, unless the
/// run `resumes` and needs them. Throws SceneError if the folder cannot be written, if another run writes into it, or
/// if something else is in the place of a file that a run may write; nothing is removed then.
[[nodiscard]] std::shared_ptr<FolderLock> prepare_folder(const std::filesystem::path& folder, bool resumes);

}  // namespace stillpoint
