// CHOLMOD and UMFPACK allocate through SuiteSparse's table of functions. The library is loaded with CHOLMOD, but is not
// among what the tests name to the linker, hence dlsym.
#include <cstdlib>

#include <catch2/catch.hpp>
#include <dlfcn.h>
#include <suitesparse/SuiteSparse_config.h>

#include "factor_allocations.hpp"

namespace stillpoint::test {
namespace {

long allocations = 0;
SuiteSparse_config_struct *table = nullptr, saved{};

}  // namespace

FactorAllocations::FactorAllocations() {
  table = static_cast<SuiteSparse_config_struct*>(dlsym(RTLD_DEFAULT, "SuiteSparse_config"));
  REQUIRE(table != nullptr);
  saved = *table;
  allocations = 0;
  table->malloc_func = [](std::size_t size) { return ++allocations, std::malloc(size); };
  table->calloc_func = [](std::size_t count, std::size_t size) { return ++allocations, std::calloc(count, size); };
  table->realloc_func = [](void* old, std::size_t size) { return ++allocations, std::realloc(old, size); };
}
FactorAllocations::~FactorAllocations() { *table = saved; }
long FactorAllocations::count() const { return allocations; }

}  // namespace stillpoint::test
