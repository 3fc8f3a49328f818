// SPDX-License-Identifier: MIT
// The common C ABI of tribo.wasm. Pointers are 32-bit offsets into the memory of the module. JavaScript must
// renew its views after any call that may allocate.
#include <cstdint>
#include <cstdlib>

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

// Returns the version as a C string: major.minor.patch.
TRIBO_EXPORT(tribo_version) const char* tribo_version() {
    return TRIBO_VERSION;
}

// Allocates memory for inputs of the caller, aligned to 16 bytes. Traps if no memory is left.
TRIBO_EXPORT(tribo_allocate) void* tribo_allocate(std::uint32_t bytes) {
    void* memory = std::malloc(bytes == 0 ? 1 : bytes);
    if (memory == nullptr) __builtin_trap();
    return memory;
}

TRIBO_EXPORT(tribo_release) void tribo_release(void* memory) {
    std::free(memory);
}
