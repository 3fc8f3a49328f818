// SPDX-License-Identifier: MIT
// The complete run-time system of a module. Out of memory and failed library checks stop the module by a
// trap, without printing. Otherwise libc++ and wasi-libc would include standard output, and the module would
// import system functions that a browser does not have. Linked into every module; overrides the functions of
// the libraries.
#include <__verbose_abort>
#include <cstddef>
#include <cstdlib>
#include <new>

_LIBCPP_BEGIN_NAMESPACE_STD
[[noreturn]] void __libcpp_verbose_abort(const char*, ...) {
    __builtin_trap();
}
_LIBCPP_END_NAMESPACE_STD

extern "C" _Noreturn void abort() {
    __builtin_trap();
}

extern "C" _Noreturn void __cxa_pure_virtual() {
    __builtin_trap();
}

namespace {

void* allocate(std::size_t bytes, std::size_t alignment) {
    if (bytes == 0) bytes = 1;
    void* memory = alignment <= alignof(std::max_align_t)
                       ? std::malloc(bytes)
                       : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (memory == nullptr) __builtin_trap();
    return memory;
}

}  // namespace

void* operator new(std::size_t bytes) {
    return allocate(bytes, 1);
}
void* operator new[](std::size_t bytes) {
    return allocate(bytes, 1);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
    return allocate(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
