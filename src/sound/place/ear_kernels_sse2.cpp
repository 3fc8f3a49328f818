// SPDX-License-Identifier: MIT
// For every processor: SSE2 on x86, whatever the target's baseline is elsewhere.
#include "sound/place/ear_kernels.inl"

namespace tribo::sound {

const EarKernels* ear_kernels_sse2() {
    return &kKernels;
}

const EarKernels& ear_kernels() {
    static const EarKernels& chosen = ear_kernels_v3() ? *ear_kernels_v3() : kKernels;
    return chosen;
}

}  // namespace tribo::sound
