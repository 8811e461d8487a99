// The folder that a run writes into.
#pragma once

#include <filesystem>

namespace stillpoint {

/// Creates it. What an earlier run has left there is not beside the new run's files: it goes, but for `resumes`, which
/// needs it. Throws SceneError if it cannot be written, or if something else is in the place of a file that a run may
/// write; nothing is removed then.
void prepare_folder(const std::filesystem::path& folder, bool resumes);

}  // namespace stillpoint
