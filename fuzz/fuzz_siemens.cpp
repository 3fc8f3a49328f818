// SPDX-License-Identifier: MIT
// Any bytes give moves with finite ends or an error with a remedy.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "readers/siemens/reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 16;
    if (size > largest) return 0;
    readers::GcodeOptions options;
    options.source_name = "fuzz.mpf";
    options.max_steps = 20'000;
    options.max_moves = 20'000;
    const auto program = readers::read_siemens({reinterpret_cast<const char*>(data), size}, options);
    if (!program) {
        if (program.error().cause.empty() || program.error().remedy.empty()) std::abort();
        return 0;
    }
    for (const motion::Move& move : program->moves) {
        if (!is_finite(move.start.tip_mm) || !is_finite(move.end.tip_mm) || !is_finite(move.end.axis))
            std::abort();
    }
    return 0;
}
