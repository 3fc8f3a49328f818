// SPDX-License-Identifier: MIT
// For x86-64-v3 (AVX2): this file alone is compiled for it, so nothing of it may run before the processor was
// asked.
#include "field/brick_kernels.inl"

namespace tribo::field {

const BrickKernels* brick_kernels_v3() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")
               ? &kKernels
               : nullptr;
#else
    return nullptr;
#endif
}

}  // namespace tribo::field
