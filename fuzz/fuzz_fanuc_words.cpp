// SPDX-License-Identifier: MIT
// Any bytes in the words of a Fanuc control have as many lines as before, and give moves with finite ends or
// an error with a remedy. The first byte says the control.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "readers/control/fanuc_words.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/text/text_lines.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 16;
    if (size == 0 || size > largest) return 0;
    const auto control = static_cast<readers::OtherControl>(data[0] % readers::kOtherControls);
    const std::string_view text{reinterpret_cast<const char*>(data) + 1, size - 1};
    const std::string words = readers::in_fanuc_words(text, control);
    readers::TextLines lines(text);
    std::ptrdiff_t count = 0;
    while (lines.next()) ++count;
    if (std::count(words.begin(), words.end(), '\n') != count) std::abort();
    readers::GcodeOptions options;
    options.source_name = "fuzz.nc";
    options.dialect = readers::GcodeDialect::fanuc;
    options.default_feed_mm_per_min = 100;
    options.max_steps = 2'000;  // loops are no place to spend a fuzzer's time
    options.max_moves = 100'000;
    const auto program = readers::read_gcode(words, options);
    if (!program) {
        if (program.error().cause.empty() || program.error().remedy.empty()) std::abort();
        return 0;
    }
    for (const motion::Move& move : program->moves) {
        if (!is_finite(move.start.tip_mm) || !is_finite(move.end.tip_mm)) std::abort();
    }
    return 0;
}
