// In a file of its own, so that the compiler cannot inline a new without its delete.
#include "tests/solid/allocation_count.hpp"

#include <SuiteSparse_config.h>
#include <dlfcn.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <stdexcept>

namespace {

std::atomic<long> count{0};

void* counted_malloc(std::size_t size) {
    ++count;
    return std::malloc(size);
}
void* counted_calloc(std::size_t number, std::size_t size) {
    ++count;
    return std::calloc(number, size);
}
void* counted_realloc(void* memory, std::size_t size) {
    ++count;
    return std::realloc(memory, size);
}

}  // namespace

void* operator new(std::size_t size) {
    if (void* memory = counted_malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
// std::stable_sort asks for its buffer so. Under a sanitizer it would come from elsewhere than the delete below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return counted_malloc(size > 0 ? size : 1);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace aquagraph::solid::test {

long allocations() {
    return count;
}

namespace {
// The table of functions that CHOLMOD allocates with. It lives in a library that only CHOLMOD is linked to: found by
// name.
struct SuiteSparse_config_struct* table() {
    return static_cast<struct SuiteSparse_config_struct*>(dlsym(RTLD_DEFAULT, "SuiteSparse_config"));
}
}  // namespace

CountCholmodToo::CountCholmodToo() {
    if (table() == nullptr) throw std::runtime_error("SuiteSparse_config is not found: CHOLMOD cannot be counted");
    table()->malloc_func = counted_malloc;
    table()->calloc_func = counted_calloc;
    table()->realloc_func = counted_realloc;
}

CountCholmodToo::~CountCholmodToo() {
    table()->malloc_func = std::malloc;
    table()->calloc_func = std::calloc;
    table()->realloc_func = std::realloc;
}

}  // namespace aquagraph::solid::test
