// SPDX-License-Identifier: MIT
// Any bytes give a response of finite numbers at rising frequencies, or an error with a remedy.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/limits.hpp"
#include "readers/response/frequency_response.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 18;
    if (size > largest) return 0;
    const std::string_view bytes{reinterpret_cast<const char*>(data), size};
    readers::looks_like_response(bytes);
    for (const readers::ResponseUnit* unit :
         {static_cast<const readers::ResponseUnit*>(nullptr), &readers::kResponseUnits[7]}) {
        const auto read = readers::read_frequency_response(
            bytes, {.source_name = "fuzz.uff", .direction = Vec3{0, 1, 0}, .unit = unit});
        if (!read) {
            if (read.error().cause.empty() || read.error().remedy.empty()) std::abort();
            continue;
        }
        const std::size_t count = read->frequency_hz.size();
        if (count < 2 || count != read->receptance_mm_per_n.size()) std::abort();
        if (read->derivatives < 0 || read->derivatives > 2 || read->description.empty()) std::abort();
        for (std::size_t n = 0; n < count; ++n) {
            if (!kLimits.response_frequency.range.contains(read->frequency_hz[n])) std::abort();
            if (n > 0 && !(read->frequency_hz[n] > read->frequency_hz[n - 1])) std::abort();
            const auto h = read->receptance_mm_per_n[n];
            if (!kLimits.receptance.range.contains(h.real()) || !kLimits.receptance.range.contains(h.imag()))
                std::abort();
        }
    }
    return 0;
}
