// SPDX-License-Identifier: MIT
// The C ABI of tribo.wasm: what every caller needs before any other call. Pointers are 32-bit offsets into
// the module's memory, whose views JavaScript must take anew after any call that may allocate.
#include <cstdint>
#include <cstdlib>

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

// The version as a C string: major.minor.patch.
TRIBO_EXPORT(tribo_version) const char* tribo_version() {
    return TRIBO_VERSION;
}

// Memory for the caller to write inputs into, aligned to 16 bytes; traps when there is none left.
TRIBO_EXPORT(tribo_allocate) void* tribo_allocate(std::uint32_t bytes) {
    void* memory = std::malloc(bytes == 0 ? 1 : bytes);
    if (memory == nullptr) __builtin_trap();
    return memory;
}

TRIBO_EXPORT(tribo_release) void tribo_release(void* memory) {
    std::free(memory);
}
