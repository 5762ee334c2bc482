// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <atomic>
#include <cstdlib>
#include <new>
#include <support/counting_new.hpp>

namespace {

std::atomic<long long> count = 0;
std::atomic<std::size_t> bytes = 0;

[[maybe_unused]] void* counted(std::size_t size, std::size_t alignment) {
    ++count;
    bytes += size;
    // aligned_alloc wants a multiple of the alignment, and something to return.
    const std::size_t rounded = (size + alignment) / alignment * alignment;
    if (void* p = std::aligned_alloc(alignment, rounded)) return p;
    throw std::bad_alloc();
}

}  // namespace

namespace winnow::test {
allocations allocations_so_far() { return {count, bytes}; }
}  // namespace winnow::test

#if !WINNOW_TEST_SANITIZED
void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t a) { return counted(size, static_cast<std::size_t>(a)); }
void* operator new[](std::size_t size, std::align_val_t a) { return counted(size, static_cast<std::size_t>(a)); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
#endif
