// SPDX-License-Identifier: MIT
// The build for every processor: SSE2 on x86, whatever the baseline of the target is elsewhere.
#include "noise/play/noise_kernels.inl"

namespace tribo::noise {

const NoiseKernels* noise_kernels_sse2() {
    return &kKernels;
}

const NoiseKernels& noise_kernels() {
    static const NoiseKernels& chosen = noise_kernels_v3() ? *noise_kernels_v3() : kKernels;
    return chosen;
}

}  // namespace tribo::noise
