// SPDX-License-Identifier: MIT
// For every processor: SSE2 on x86, the baseline of the target elsewhere.
#include "field/carved/brick_kernels.inl"

namespace tribo::field {

const BrickKernels* brick_kernels_sse2() {
    return &kKernels;
}

const BrickKernels& brick_kernels() {
    static const BrickKernels& chosen = brick_kernels_v3() ? *brick_kernels_v3() : kKernels;
    return chosen;
}

}  // namespace tribo::field
