// SPDX-License-Identifier: MIT
// What the processor that this runs on can do. Any thread.
#pragma once

namespace tribo {

// AVX2 and what else x86-64-v3 stands for; false on every other kind of processor, so that kernels built for
// it are left out of the program there.
#ifdef __x86_64__
bool has_x86_64_v3();
#else
constexpr bool has_x86_64_v3() {
    return false;
}
#endif

}  // namespace tribo
