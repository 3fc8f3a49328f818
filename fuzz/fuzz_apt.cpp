// SPDX-License-Identifier: MIT
// Any bytes give moves with finite ends and unit axes, or an error with a remedy.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "readers/apt/reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 20;
    if (size > largest) return 0;
    readers::AptOptions options;
    options.source_name = "fuzz.cl";
    options.default_feed_mm_per_min = 100;
    options.max_moves = 20'000;
    options.max_statements = 20'000;  // loops are no place to spend a fuzzer's time
    const auto program = readers::read_apt({reinterpret_cast<const char*>(data), size}, options);
    if (!program) {
        if (program.error().cause.empty() || program.error().remedy.empty()) std::abort();
        return 0;
    }
    for (const motion::Move& move : program->moves) {
        if (!is_finite(move.start.tip_mm) || !is_finite(move.end.tip_mm)) std::abort();
        if (std::abs(length(move.end.axis) - 1) > 1e-12) std::abort();
        if (move.kind == motion::MoveKind::feed && !(move.feed_mm_per_min > 0)) std::abort();
    }
    return 0;
}
