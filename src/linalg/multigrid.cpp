#include "linalg/multigrid.hpp"

#include <stdexcept>
#include <string>

#include "base/gpl.hpp"
#include "base/own_module.hpp"

namespace stillpoint {
namespace {

using MakeGamg = Multigrid* (*)(const SparseMatrix&, const NodalLayout&);

const OwnModule& module() {
  static const OwnModule loaded = [] {
    const std::string file = STILLPOINT_MULTIGRID_MODULE;
    if (file.empty()) return OwnModule{nullptr, std::string(why_no_petsc())};
    return load_own_module(file, "stillpoint_make_gamg", "Debian's package libpetsc-real3.18");
  }();
  return loaded;
}

}  // namespace

std::string multigrid_is_missing() { return module().missing; }

std::unique_ptr<Multigrid> make_multigrid(const SparseMatrix& K, const NodalLayout& layout) {
  if (const std::string& missing = module().missing; !missing.empty()) throw std::runtime_error(missing);
  return std::unique_ptr<Multigrid>(reinterpret_cast<MakeGamg>(module().function)(K, layout));
}

}  // namespace stillpoint
