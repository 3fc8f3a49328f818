// SPDX-License-Identifier: MIT
// What the processor that this runs on can do. Any thread.
#pragma once

namespace tribo {

// AVX2 and what else x86-64-v3 stands for; false on every other kind of processor.
bool has_x86_64_v3();

}  // namespace tribo
