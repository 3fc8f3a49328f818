// SPDX-License-Identifier: MIT
#include "base/processor.hpp"

namespace tribo {

#ifdef __x86_64__
bool has_x86_64_v3() {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}
#endif

}  // namespace tribo
