// SPDX-License-Identifier: MIT
// For x86-64-v3 (AVX2). Only this file is compiled for it; none of its code may run before the processor was
// checked.
#include "base/processor.hpp"
#include "field/carved/brick_kernels.inl"

namespace tribo::field {

const BrickKernels* brick_kernels_v3() {
    return has_x86_64_v3() ? &kKernels : nullptr;
}

}  // namespace tribo::field
