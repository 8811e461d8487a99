#include "output/run_folder.hpp"

#include <system_error>

#include "base/atomic_file.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

constexpr const char* summary = "summary.json";
constexpr const char* gone_on_from[] = {"fields.h5", "fields.xdmf", "checkpoint.h5", "checkpoint-previous.h5"};
constexpr const char* written[] = {summary,       "history.csv",   "fields.h5",
                                   "fields.xdmf", "checkpoint.h5", "checkpoint-previous.h5"};

void require_file(const fs::path& path) {
  if (!fs::is_directory(path)) return;
  throw fs::filesystem_error("cannot write", path, std::make_error_code(std::errc::is_a_directory));
}

}  // namespace

void prepare_folder(const fs::path& folder, bool resumes) {
  try {
    fs::create_directories(folder);
    for (const char* name : written) {
      require_file(folder / name);
      require_file(partial_name(folder / name));
    }
    fs::remove(folder / summary);
    for (const char* name : gone_on_from) {
      if (!resumes) fs::remove(folder / name);
    }
  } catch (const fs::filesystem_error& error) {
    throw_folder_error(folder, error);
  }
}

}  // namespace stillpoint
