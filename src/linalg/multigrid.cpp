#include "linalg/multigrid.hpp"

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/gpl.hpp"

namespace stillpoint {
namespace {

using MakeGamg = Multigrid* (*)(const SparseMatrix&, const NodalLayout&);

struct Module {
  MakeGamg make = nullptr;
  std::string missing;  // why there is no module
};

// The folder of the program, or of the shared library, that contains this code.
std::filesystem::path own_folder() {
  Dl_info info{};
  static const char anchor = 0;
  if (dladdr(&anchor, &info) == 0 || !info.dli_fname) return {};
  std::error_code ignored;
  const auto file = std::filesystem::canonical(info.dli_fname, ignored);
  return ignored ? std::filesystem::path() : file.parent_path();
}

// The module lies beside the program where that was built; if installed, it is in the folder of libraries, wherever the
// two were put. The Python module, installed in python3/dist-packages in the folder of libraries, and the library for a
// wider processor, in glibc-hwcaps/NAME, lie two folders below it.
Module load_module() {
  const std::string file = STILLPOINT_MULTIGRID_MODULE;
  if (file.empty()) return {nullptr, std::string(why_no_petsc())};
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
    if (const auto make = reinterpret_cast<MakeGamg>(dlsym(module, "stillpoint_make_gamg"))) return {make, ""};
    tried = fmt::format("{} is of another version", candidate.string());
  }
  return {nullptr, fmt::format("the module {} cannot be loaded: {}; expected Debian's package libpetsc-real3.18, and "
                               "the module beside the program or in {}/stillpoint",
                               file, tried.empty() ? "there is no such file" : tried, STILLPOINT_FULL_LIBDIR)};
}

const Module& module() {
  static const Module loaded = load_module();
  return loaded;
}

}  // namespace

std::string multigrid_is_missing() { return module().missing; }

std::unique_ptr<Multigrid> make_multigrid(const SparseMatrix& K, const NodalLayout& layout) {
  if (const std::string& missing = module().missing; !missing.empty()) throw std::runtime_error(missing);
  return std::unique_ptr<Multigrid>(module().make(K, layout));
}

}  // namespace stillpoint
