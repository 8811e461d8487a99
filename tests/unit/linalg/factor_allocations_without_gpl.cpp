// Eigen calls malloc itself: this program has one of its own, which counts, and hands on to that of the C library
// (glibc).
#include <atomic>
#include <cstddef>

#include "factor_allocations.hpp"

extern "C" {
void* __libc_malloc(std::size_t size);              // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* old, std::size_t size);  // NOLINT(bugprone-reserved-identifier)
}

namespace {
std::atomic<long> allocations = 0;
}

extern "C" void* malloc(std::size_t size) { return ++allocations, __libc_malloc(size); }
extern "C" void* realloc(void* old, std::size_t size) { return ++allocations, __libc_realloc(old, size); }

namespace stillpoint::test {

FactorAllocations::FactorAllocations() { allocations = 0; }
FactorAllocations::~FactorAllocations() = default;
long FactorAllocations::count() const { return allocations; }

}  // namespace stillpoint::test
