// SPDX-License-Identifier: MIT
// Any bytes give a stroke of finite points in rising time, which survives being written and read, or an error
// with a remedy.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "readers/tables/stroke_csv.hpp"

namespace {

template <class Read, class Write>
void check(std::string_view bytes, Read read, Write write) {
    const auto points = read(bytes, {});
    if (!points) {
        if (points.error().cause.empty() || points.error().remedy.empty()) std::abort();
        return;
    }
    if (points->size() < 2) std::abort();
    for (std::size_t n = 1; n < points->size(); ++n) {
        if (!((*points)[n].t_s > (*points)[n - 1].t_s)) std::abort();
    }
    const auto again = read(write(*points), {});
    if (!again || *again != *points) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo::readers;
    constexpr std::size_t largest = 1 << 20;
    if (size > largest) return 0;
    const std::string_view bytes{reinterpret_cast<const char*>(data), size};
    check(bytes, read_probe_stroke, write_probe_stroke);
    check(bytes, read_finger_stroke, write_finger_stroke);
    return 0;
}
