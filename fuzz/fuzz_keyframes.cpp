// SPDX-License-Identifier: MIT
// Any bytes give keyframes with unit axes, which survive being written and read, or an error with a remedy.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "readers/tables/keyframes_csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 20;
    if (size > largest) return 0;
    const auto read = readers::read_keyframes({reinterpret_cast<const char*>(data), size});
    if (!read) {
        if (read.error().cause.empty() || read.error().remedy.empty()) std::abort();
        return 0;
    }
    for (const motion::Keyframe& keyframe : *read) {
        if (!is_finite(keyframe.pose.tip_mm) || std::abs(length(keyframe.pose.axis) - 1) > 1e-12)
            std::abort();
    }
    auto again = readers::read_keyframes(readers::write_keyframes(*read));
    if (!again || again->size() != read->size()) std::abort();
    for (std::size_t i = 0; i < read->size(); ++i) {
        (*again)[i].line = (*read)[i].line;
        if (!((*again)[i] == (*read)[i])) std::abort();
    }
    return 0;
}
