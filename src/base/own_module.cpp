#include "base/own_module.hpp"

#include <array>
#include <filesystem>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>

namespace stillpoint {
namespace {

// The folder of the program, or of the shared library, that contains this code.
std::filesystem::path own_folder() {
  Dl_info info{};
  static const char anchor = 0;
  if (dladdr(&anchor, &info) == 0 || !info.dli_fname) return {};
  std::error_code ignored;
  const auto file = std::filesystem::canonical(info.dli_fname, ignored);
  return ignored ? std::filesystem::path() : file.parent_path();
}

}  // namespace

// A module lies beside the program where that was built; if installed, it is in the folder of libraries, wherever the
// two were put. The Python module, installed in python3/dist-packages in the folder of libraries, and the library for a
// wider processor, in glibc-hwcaps/NAME, lie two folders below it.
OwnModule load_own_module(const std::string& file, const char* function, const std::string& brings) {
  const std::filesystem::path own = own_folder();
  const std::filesystem::path up = "..";
  const std::array candidates{own / file,
                              own / up / STILLPOINT_LIBDIR / "stillpoint" / file,
                              own / "stillpoint" / file,
                              own / up / up / file,
                              own / up / up / "stillpoint" / file,
                              own / up / up / up / "stillpoint" / file,
                              std::filesystem::path(STILLPOINT_FULL_LIBDIR) / "stillpoint" / file};
  std::string tried;
  for (const std::filesystem::path& candidate : candidates) {
    std::error_code ignored;
    if (!std::filesystem::exists(candidate, ignored)) continue;
    void* const module = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) {
      tried = dlerror();
      continue;
    }
    if (void* const found = dlsym(module, function)) return {found, ""};
    tried = fmt::format("{} is of another version", candidate.string());
  }
  return {nullptr,
          fmt::format("the module {} cannot be loaded: {}; expected {}, and the module beside the program or in "
                      "{}/stillpoint",
                      file, tried.empty() ? "there is no such file" : tried, brings, STILLPOINT_FULL_LIBDIR)};
}

}  // namespace stillpoint
