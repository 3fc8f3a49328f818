// SPDX-License-Identifier: MIT
// For x86-64-v3 (AVX2). Only this file is compiled for it; none of its code may run before the processor was
// checked.
#include "base/processor.hpp"
#include "elastic/sheet_kernels.inl"

namespace tribo::elastic {

const SheetKernels* sheet_kernels_v3() {
    return has_x86_64_v3() ? &kKernels : nullptr;
}

}  // namespace tribo::elastic
