// SPDX-License-Identifier: MIT
// For every processor: SSE2 on x86, the baseline of the target elsewhere.
#include "elastic/sheet_kernels.inl"

namespace tribo::elastic {

const SheetKernels* sheet_kernels_sse2() {
    return &kKernels;
}

const SheetKernels& sheet_kernels() {
    static const SheetKernels& chosen = sheet_kernels_v3() ? *sheet_kernels_v3() : kKernels;
    return chosen;
}

}  // namespace tribo::elastic
