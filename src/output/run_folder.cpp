#include "output/run_folder.hpp"

#include <span>
#include <system_error>

#include "base/atomic_file.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

constexpr const char* of_the_end[] = {"summary.json", "report.html", "unstable_mode.csv"};
constexpr const char* gone_on_from[] = {"history.csv", "fields.h5", "fields.xdmf", "checkpoint.h5",
                                        "checkpoint-previous.h5"};
constexpr const char* frames_folder = "fields.partial";

void require_file(const fs::path& path) {
  if (!fs::is_directory(path)) return;
  throw fs::filesystem_error("cannot write", path, std::make_error_code(std::errc::is_a_directory));
}

}  // namespace

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
    fs::remove_all(folder / frames_folder);
    return lock;
  } catch (const fs::filesystem_error& error) {
    throw_unless_of_disk(folder, error);
  }
}

}  // namespace stillpoint
