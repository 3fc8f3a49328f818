// SPDX-License-Identifier: MIT
// Counts what a test program allocates. Defines operator new: one source of a program includes it. Under the
// thread sanitizer, which has its own operator new, nothing is counted.
#pragma once

#include <cstdlib>
#include <new>

#include "base/allocation_count.hpp"

namespace tribo::test {

inline void* counted(std::size_t size) {
    ++allocations;
    if (void* p = std::malloc(size > 0 ? size : 1)) return p;
    std::abort();
}

}  // namespace tribo::test

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define TRIBO_NOT_COUNTED
#endif
#endif

#ifndef TRIBO_NOT_COUNTED
// Not inlined: g++ 12 would see free() beside operator new and take them for a mismatch.
void* operator new(std::size_t size) {
    return tribo::test::counted(size);
}
void* operator new[](std::size_t size) {
    return tribo::test::counted(size);
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
    std::free(p);
}
[[gnu::noinline]] void operator delete[](void* p) noexcept {
    std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}
[[gnu::noinline]] void operator delete[](void* p, std::size_t) noexcept {
    std::free(p);
}
#endif
