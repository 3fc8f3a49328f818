// SPDX-License-Identifier: MIT
// Conversational and DIN/ISO programs. Any bytes give moves with finite ends or an error with a remedy, with
// and without a machine.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "readers/heidenhain/din_iso.hpp"
#include "readers/heidenhain/reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 16;
    if (size > largest) return 0;
    std::string_view text(reinterpret_cast<const char*>(data), size);
    std::string conversational;
    if (readers::looks_like_din_iso(text)) {
        conversational = readers::in_conversational_words(text);
        text = conversational;
    }
    static const motion::Machine machine = *motion::named_machine("xyzac-trt");
    for (const bool on_machine : {false, true}) {
        readers::GcodeOptions options;
        options.source_name = "fuzz.h";
        options.machine = on_machine ? &machine : nullptr;
        options.max_steps = 20'000;
        options.max_moves = 20'000;
        const auto program = readers::read_heidenhain(text, options);
        if (!program) {
            if (program.error().cause.empty() || program.error().remedy.empty()) std::abort();
            continue;
        }
        for (const motion::Move& move : program->moves) {
            if (!is_finite(move.start.tip_mm) || !is_finite(move.end.tip_mm)) std::abort();
            if (!is_finite(move.start.axis) || !is_finite(move.end.axis)) std::abort();
        }
    }
    return 0;
}
