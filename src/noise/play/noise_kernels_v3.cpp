// SPDX-License-Identifier: MIT
// The build for x86-64-v3 (AVX2). Only this file is compiled for it, so none of its code may run before the
// check of the processor.
#include "base/processor.hpp"
#include "noise/play/noise_kernels.inl"

namespace tribo::noise {

const NoiseKernels* noise_kernels_v3() {
    return has_x86_64_v3() ? &kKernels : nullptr;
}

}  // namespace tribo::noise
