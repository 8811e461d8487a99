// Memory that comes to its end, for a program that is started with LD_PRELOAD=libno_memory.so: of the objects of
// NO_MEMORY_BYTES and more that it asks for, the one with the number NO_MEMORY_FROM is refused, and all that follow.
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

bool is_refused(std::size_t bytes) {
  static const auto large = static_cast<std::size_t>(std::atol(std::getenv("NO_MEMORY_BYTES")));
  static const long from = std::atol(std::getenv("NO_MEMORY_FROM"));
  static std::atomic<long> asked = 0;
  return bytes >= large && ++asked >= from;
}

void* memory_or_throw(void* memory) { return memory ? memory : throw std::bad_alloc(); }

}  // namespace

void* operator new(std::size_t bytes) { return memory_or_throw(is_refused(bytes) ? nullptr : std::malloc(bytes)); }
void* operator new[](std::size_t bytes) { return operator new(bytes); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return memory_or_throw(is_refused(bytes) ? nullptr : std::aligned_alloc(step, (bytes + step - 1) / step * step));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) { return operator new(bytes, alignment); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
