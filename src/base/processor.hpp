// SPDX-License-Identifier: MIT
// Abilities of the processor that runs the program. Any thread.
#pragma once

namespace tribo {

// True if the processor has AVX2 and the rest of x86-64-v3. Constant false on other kinds of processor, so
// that the program does not contain the kernels built for it.
#ifdef __x86_64__
bool has_x86_64_v3();
#else
constexpr bool has_x86_64_v3() {
    return false;
}
#endif

}  // namespace tribo
