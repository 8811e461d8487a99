#include "space/materials/umat_library.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include "base/text.hpp"
#include "space/materials/umat_utilities.hpp"

namespace stillpoint {
namespace {

struct Parts {
  const void* address;
  std::vector<std::span<const char>> found{};
};

bool lies_in(const void* address, const dl_phdr_info& object) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  return std::ranges::any_of(std::span(object.dlpi_phdr, object.dlpi_phnum), [&](const ElfW(Phdr) & segment) {
    const std::uintptr_t begin = object.dlpi_addr + segment.p_vaddr;
    return segment.p_type == PT_LOAD && at >= begin && at < begin + segment.p_memsz;
  });
}

// A part that is read-only once the library is loaded is one of a writable segment, at its beginning.
int collect(dl_phdr_info* object, std::size_t, void* data) {
  Parts& parts = *static_cast<Parts*>(data);
  if (!lies_in(parts.address, *object)) return 0;
  std::uintptr_t read_only_until = 0;
  const std::span segments(object->dlpi_phdr, object->dlpi_phnum);
  for (const ElfW(Phdr) & segment : segments)
    if (segment.p_type == PT_GNU_RELRO) read_only_until = object->dlpi_addr + segment.p_vaddr + segment.p_memsz;
  for (const ElfW(Phdr) & segment : segments) {
    if (segment.p_type != PT_LOAD || (segment.p_flags & PF_W) == 0) continue;
    const std::uintptr_t begin = object->dlpi_addr + segment.p_vaddr, end = begin + segment.p_memsz;
    const std::uintptr_t from = std::clamp(read_only_until, begin, end);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader tells addresses as numbers
    if (from < end) parts.found.emplace_back(reinterpret_cast<const char*>(from), end - from);
  }
  return 1;
}

// What the loader says, without the path that it begins with.
std::string fault_of_loading(const std::filesystem::path& file) {
  const char* const error = dlerror();
  std::string said = error ? error : "the loader does not say why";
  const std::string begin = file.string() + ": ";
  return one_line(said.starts_with(begin) ? said.substr(begin.size()) : said);
}

}  // namespace

WritableMemory::WritableMemory(const void* address) {
  Parts parts{address};
  dl_iterate_phdr(&collect, &parts);
  parts_ = std::move(parts.found);
  has_changed();
}

bool WritableMemory::has_changed() {
  std::size_t size = 0;
  for (const auto& part : parts_) size += part.size();
  const bool is_first = seen_.size() != size;
  seen_.resize(size);
  bool changed = false;
  char* seen = seen_.data();
  for (const auto& part : parts_) {
    if (is_first || std::memcmp(seen, part.data(), part.size()) != 0) {
      changed = true;
      std::memcpy(seen, part.data(), part.size());
    }
    seen += part.size();
  }
  return changed && !is_first;
}

UmatLibrary::UmatLibrary(UmatRoutine* routine) : routine_(routine), memory_(reinterpret_cast<const void*>(routine)) {}

std::shared_ptr<UmatLibrary> UmatLibrary::open(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw std::domain_error(fmt::format("there is no file {}", in_quotes(file.string())));
  offer_umat_utilities();
  const std::filesystem::path whole = std::filesystem::absolute(file);  // a name alone is looked for elsewhere
  void* const handle = dlopen(whole.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle)
    throw std::domain_error(fmt::format("{} cannot be loaded: {}; expected a shared library with the subroutine UMAT",
                                        in_quotes(file.string()), fault_of_loading(whole)));
  void* routine = dlsym(handle, "umat_");
  if (!routine) routine = dlsym(handle, "umat");
  if (!routine)
    throw std::domain_error(fmt::format(
        "{} has no subroutine UMAT: neither 'umat_', as of Fortran, nor 'umat', as of C", in_quotes(file.string())));
  static std::mutex mutex;
  static std::map<void*, std::shared_ptr<UmatLibrary>> opened;
  const std::scoped_lock lock(mutex);
  auto& library = opened[routine];
  if (!library) library = std::make_shared<UmatLibrary>(reinterpret_cast<UmatRoutine*>(routine));
  return library;
}

std::unique_lock<std::mutex> UmatLibrary::turn() const {
  return keeps_state_ || is_watched() ? std::unique_lock(one_at_a_time_) : std::unique_lock<std::mutex>();
}

void UmatLibrary::look_for_state() {
  const std::scoped_lock lock(looking_);
  if (!keeps_state_ && memory_.has_changed()) keeps_state_ = true;
}

}  // namespace stillpoint
