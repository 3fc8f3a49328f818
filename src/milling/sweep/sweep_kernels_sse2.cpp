// SPDX-License-Identifier: MIT
// For every processor: SSE2 on x86, the baseline of the target elsewhere.
#include "milling/sweep/sweep_kernels.inl"

namespace tribo::milling {

const SweepKernels* sweep_kernels_sse2() {
    return &kKernels;
}

const SweepKernels& sweep_kernels() {
    static const SweepKernels& chosen = sweep_kernels_v3() ? *sweep_kernels_v3() : kKernels;
    return chosen;
}

}  // namespace tribo::milling
