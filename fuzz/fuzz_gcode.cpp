// SPDX-License-Identifier: MIT
// Any bytes give moves with finite ends or an error with a remedy; both readings of '/', both dialects, the
// words of Okuma and Fagor, and the reading that goes on after a refusal are tried.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "readers/control/fanuc_words.hpp"
#include "readers/gcode/reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 20;
    if (size > largest) return 0;
    for (const bool skip : {true, false}) {
        std::vector<Error> refusals;
        readers::GcodeOptions options;
        options.source_name = "fuzz.nc";
        options.skip_deletable_blocks = skip;
        options.dialect = skip ? readers::GcodeDialect::linuxcnc : readers::GcodeDialect::fanuc;
        options.tools = {{1, 6}};
        options.max_steps = 2'000;  // loops are no place to spend a fuzzer's time
        options.max_moves = 100'000;
        options.default_feed_mm_per_min = skip ? 100 : 0;
        if (!skip) options.refusals = &refusals;
        std::string_view text(reinterpret_cast<const char*>(data), size);
        std::string translated;
        if (!skip && size > 0) {  // as an Okuma or Fagor program, if it looks like one
            if (const auto control = readers::detect_other_control(text)) {
                translated = readers::in_fanuc_words(text, *control);
                text = translated;
            }
        }
        const auto program = readers::read_gcode(text, options);
        if (refusals.size() > readers::kMostRefusals) std::abort();
        for (const Error& refusal : refusals) {
            if (refusal.cause.empty() || refusal.remedy.empty()) std::abort();
        }
        if (!program) {
            if (program.error().cause.empty() || program.error().remedy.empty()) std::abort();
            continue;
        }
        for (const motion::Move& move : program->moves) {
            if (!is_finite(move.start.tip_mm) || !is_finite(move.end.tip_mm)) std::abort();
            if (move.kind == motion::MoveKind::feed && !(move.feed_mm_per_min >= 0)) std::abort();
        }
    }
    return 0;
}
