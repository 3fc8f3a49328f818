// SPDX-License-Identifier: MIT
// Any bytes from the child that reads SOFA files give head responses of which a head can be made, or an error
// with a remedy.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "files/sound/hrir_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 16;
    if (size > largest) return 0;
    const auto set = files::unpacked_hrirs({reinterpret_cast<const char*>(data), size});
    if (!set) {
        if (set.error().remedy.empty()) std::abort();
        return 0;
    }
    if (files::packed_hrirs(*set) != std::string_view(reinterpret_cast<const char*>(data), size))
        std::abort();
    const auto head = sound::Head::measured(*set, 48000);
    if (!head) std::abort();
    sound::EarResponses heard;
    (*head)->hear({0.3, 2, -1}, heard);
    for (std::size_t ear = 0; ear < 2; ++ear) {
        if (!std::isfinite(heard.delay_s[ear])) std::abort();
        for (const float v : heard.taps[ear]) {
            if (!std::isfinite(v)) std::abort();
        }
    }
    return 0;
}
